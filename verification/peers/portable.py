"""A structural model in the terms every finite-element code has: nodes, elements, links, masses.

Most codes know no beam offsets, no lumped masses beside their node and no inertia tensors.  Here
they are put into what every code knows: a beam's offset end, and a mass beside its node, become a
node of their own that follows its leader as a rigid body; a lumped mass with a tensor of inertia
becomes six equal masses on its principal axes, which have that tensor exactly.

Averaging and rigid connections become linear equations between nodes.  They are derived here from
their definition and not taken from `solver.fe.constraints`, so that a comparison covers these too.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.fe.model import FiniteElementModel, Interpolation

#: Offsets below this are none [m].
NO_OFFSET = 1e-9


@dataclass(frozen=True, slots=True)
class Link:
    """Freedoms of one node as a linear function of the freedoms of others."""

    node: int
    leaders: IntArray  #: (k,)
    #: (f, 6 k): displacement and, with f = 6, rotation of the node
    coefficients: Array


@dataclass(frozen=True, slots=True)
class PortableModel:
    """The first nodes are those of the solver's model, in their order; further ones follow."""

    model: FiniteElementModel  #: materials, properties, shells and beam sections
    coordinates: Array  #: (n, 3) [m]
    turning: Array  #: (n,) 1 where the node has rotations, 0 for points that carry mass only
    beam_nodes: IntArray  #: (m, 2) nodes at the ends of the beams' axes
    beam_directions: Array  #: (m, 3) unit vector e2 across the axis, in the plane of inertia_1
    links: tuple[Link, ...]  #: no leader is itself linked
    mass_nodes: IntArray  #: (p,)
    masses: Array  #: (p,) [kg]

    @property
    def node_count(self) -> int:
        """Number of nodes, added ones included."""
        return len(self.coordinates)


def portable_model(model: FiniteElementModel) -> PortableModel:
    """Rewrite a model in portable terms.

    Raises
    ------
    ModelError
        A lumped mass has a tensor of inertia that no distribution of its mass can have.
    """
    coordinates = list(np.asarray(model.coordinates))
    links = _connections(model)
    resolved = _resolved(links)
    added: dict[tuple[int, tuple[float, ...]], int] = {}

    def attached(node: int, offset: Array, freedoms: int) -> int:
        """Node at an offset from another one, made once for each place."""
        if np.linalg.norm(offset) < NO_OFFSET:
            return node
        key = (freedoms * len(model.coordinates) + node, tuple(np.round(offset, 9).tolist()))
        if key not in added:
            added[key] = len(coordinates)
            coordinates.append(model.coordinates[node] + offset)
            rigid = _rigid_coefficients(offset)[:freedoms]
            link = Link(added[key], np.array([node]), rigid)
            resolved[added[key]] = _substituted(link, resolved)
        return added[key]

    beam_nodes = np.array(
        [
            [attached(int(node), offset, 6) for node, offset in zip(nodes, offsets, strict=True)]
            for nodes, offsets in zip(model.beams.nodes, model.beams.offsets, strict=True)
        ],
        dtype=np.int64,
    ).reshape(-1, 2)
    structural = len(coordinates)
    mass_nodes, masses = [], []
    lumps = model.point_masses
    for node, mass, offset, inertia in zip(
        lumps.nodes.tolist(), lumps.masses, lumps.offsets, lumps.inertias, strict=True
    ):
        for share, place in _mass_points(float(mass), offset, inertia):
            mass_nodes.append(attached(node, place, 3))
            masses.append(share)
    turning = np.zeros(len(coordinates))
    turning[:structural] = 1.0
    return PortableModel(
        model=model,
        coordinates=np.array(coordinates),
        turning=turning,
        beam_nodes=beam_nodes,
        beam_directions=_beam_directions(model, np.array(coordinates), beam_nodes),
        links=tuple(resolved.values()),
        mass_nodes=np.array(mass_nodes, dtype=np.int64),
        masses=np.array(masses, dtype=np.float64),
    )


def six_points(mass: float, inertia: Array) -> Array:
    """Places (6, 3) of six masses of ``mass / 6`` each that have a given tensor of inertia.

    With S = integral(r r') = tr(J)/2 I - J, two masses at +-a_i along each principal axis of S
    give S_i = 2 (mass / 6) a_i^2.

    Raises
    ------
    ModelError
        S has a negative principal value: no body has this tensor.
    """
    second = 0.5 * np.trace(inertia) * np.eye(3) - inertia
    values, axes = np.linalg.eigh(second)
    if values[0] < -1e-9 * np.trace(inertia):
        raise ModelError(f"no body of {mass:g} kg has the tensor of inertia {inertia.tolist()}")
    arms = np.sqrt(3.0 * np.maximum(values, 0.0) / mass)
    places: Array = np.concatenate([(axes * arms).T, -(axes * arms).T])
    return places


def _mass_points(mass: float, offset: Array, inertia: Array) -> list[tuple[float, Array]]:
    if mass == 0.0:
        return []
    if not np.any(inertia):
        return [(mass, offset)]
    return [(mass / 6.0, offset + place) for place in six_points(mass, inertia)]


def _cross_matrix(arm: Array) -> Array:
    x, y, z = arm
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def _rigid_coefficients(arm: Array) -> Array:
    """Motion (6, 6) of a point at ``arm`` from the rigid motion of its leader."""
    coefficients = np.eye(6)
    coefficients[:3, 3:] = -_cross_matrix(arm)
    return coefficients


def mean_motion(points: Array, weights: Array, reference: Array) -> Array:
    """Coefficients (6, 6 k) of the averaging connection (RBE3).

    The rigid motion q about the reference that comes nearest to the nodes' displacements,
    minimum of sum w |u_i - A_i q|^2 with A_i = [I, -(x_i - x) cross]: the normal equations.
    """
    rows = np.stack([np.hstack([np.eye(3), -_cross_matrix(p - reference)]) for p in points])
    root = np.sqrt(np.asarray(weights, dtype=float))
    system = (root[:, None, None] * rows).reshape(-1, 6)
    fitted = np.linalg.lstsq(system, np.diag(np.repeat(root, 3)), rcond=None)[0]
    coefficients = np.zeros((6, 6 * len(points)))
    coefficients[:, (6 * np.arange(len(points))[:, None] + np.arange(3)).ravel()] = fitted
    return coefficients


def _connections(model: FiniteElementModel) -> list[Link]:
    links = []
    for body in model.rigid_bodies:
        leader = np.array([body.independent])
        for node in body.dependents.tolist():
            arm = model.coordinates[node] - model.coordinates[body.independent]
            links.append(Link(node, leader, _rigid_coefficients(arm)))
    links += [_averaging(connection, model.coordinates) for connection in model.interpolations]
    return links


def _averaging(connection: Interpolation, coordinates: Array) -> Link:
    coefficients = mean_motion(
        coordinates[connection.nodes], connection.weights, coordinates[connection.reference]
    )
    return Link(connection.reference, np.asarray(connection.nodes), coefficients)


def _resolved(links: list[Link]) -> dict[int, Link]:
    """Put the leaders' own equations in their place until no leader is linked."""
    known = {link.node: link for link in links}
    done: dict[int, Link] = {}

    def resolve(node: int) -> Link:
        if node not in done:
            for leader in known[node].leaders.tolist():
                if leader in known:
                    resolve(leader)
            done[node] = _substituted(known[node], done)
        return done[node]

    for node in known:
        resolve(node)
    return done


def _substituted(link: Link, linked: dict[int, Link]) -> Link:
    """Link with every linked leader replaced by that one's leaders."""
    blocks: dict[int, Array] = {}
    height = len(link.coefficients)
    for place, leader in enumerate(link.leaders.tolist()):
        own = link.coefficients[:, 6 * place : 6 * place + 6]
        if leader not in linked:
            blocks[leader] = blocks.get(leader, np.zeros((height, 6))) + own
            continue
        other = linked[leader]
        spread = own @ other.coefficients
        for index, far in enumerate(other.leaders.tolist()):
            share = spread[:, 6 * index : 6 * index + 6]
            blocks[far] = blocks.get(far, np.zeros((height, 6))) + share
    return Link(link.node, np.array(list(blocks)), np.hstack(list(blocks.values())))


def _beam_directions(model: FiniteElementModel, coordinates: Array, nodes: IntArray) -> Array:
    """Part of the orientation vectors across the axes, of unit length."""
    axis = coordinates[nodes[:, 1]] - coordinates[nodes[:, 0]]
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    along = np.sum(model.beams.orientations * axis, axis=1, keepdims=True)
    across = model.beams.orientations - along * axis
    unit: Array = across / np.linalg.norm(across, axis=1, keepdims=True)
    return unit
