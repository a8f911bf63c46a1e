"""Assembly: from the model as data to stiffness, inertia and the map to all node freedoms."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array, csc_array, csr_array
from scipy.sparse.csgraph import connected_components

from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.fe.beam import beam_geometry, beam_stiffness
from solver.fe.constraints import constraint_transformation
from solver.fe.inertia import Inertia
from solver.fe.mass import structural_inertia
from solver.fe.model import FiniteElementModel
from solver.fe.sections import beam_sections, shell_sections
from solver.fe.shell_quad import check_quads, quad_stiffness
from solver.fe.shell_triangle import check_triangles, side_lumping, triangle_stiffness
from solver.frames import skew
from solver.progress import Progress, silent

COMPONENTS = ("ux", "uy", "uz", "rx", "ry", "rz")


@dataclass(frozen=True, slots=True)
class Structure:
    """An unsupported structure, ready for static and dynamic analysis."""

    model: FiniteElementModel
    transformation: csr_array  #: T (6 n, n_free), ``u_all = T u``, node by node ux uy uz rx ry rz
    stiffness: csc_array  #: K (n_free, n_free), symmetric, singular by six rigid modes
    inertia: Inertia  #: of elements, nonstructural mass and lumped masses
    free: IntArray  #: (n_free,) rows of ``u_all`` that are the free freedoms, ascending

    @property
    def n_free(self) -> int:
        """Number of free freedoms."""
        return len(self.free)

    def rigid_modes(self, origin: Array) -> Array:
        """Give unit translations and rotations about ``origin`` (3,); (n_free, 6)."""
        modes: Array = rigid_motion(self.model.coordinates, origin)[self.free]
        return modes

    def nodal_loads(self, node_rows: IntArray) -> csr_array:
        """Give unit forces x, y, z and moments x, y, z at each of k nodes; (n_free, 6 k)."""
        freedoms = (6 * np.asarray(node_rows)[:, None] + np.arange(6)).ravel()
        return csr_array(self.transformation[freedoms].T)

    def nodal_displacements(self, displacement: Array) -> Array:
        """Freedoms of all nodes (n, 6) or (n, 6, nt) from free ones (n_free,) or (n_free, nt)."""
        everywhere: Array = self.transformation @ displacement
        return everywhere.reshape(self.model.node_count, 6, *displacement.shape[1:])


def rigid_motion(coordinates: Array, origin: Array) -> Array:
    """Six rigid modes (6 n, 6) of nodes at ``coordinates`` (n, 3), rotations about ``origin``."""
    modes = np.zeros((len(coordinates), 6, 6))
    modes[:, :3, :3] = modes[:, 3:, 3:] = np.eye(3)
    modes[:, :3, 3:] = -skew(coordinates - origin)
    return modes.reshape(-1, 6)


def build_structure(model: FiniteElementModel, progress: Progress = silent) -> Structure:
    """Check and assemble a model.

    Raises
    ------
    ModelError
        The model cannot be used: bad element shapes, missing properties or materials, beams
        without orientation, contradictory constraints, loose nodes or parts.  The message names
        the element, constraint or node.
    """
    progress("checking the airframe model", 0.0)
    check_nodes(model)
    quads = shell_sections(model, model.quads)
    triangles = shell_sections(model, model.triangles)
    beams = beam_sections(model, model.beams)
    quad_corners = model.coordinates[model.quads.nodes]
    triangle_corners = model.coordinates[model.triangles.nodes]
    check_quads(quad_corners, model.quads.identifiers)
    check_triangles(triangle_corners, model.triangles.identifiers)
    geometry = beam_geometry(model.coordinates, model.beams)
    transformation, free = constraint_transformation(model)

    progress("assembling the airframe", 0.2)
    lumping = side_lumping(model.triangles.nodes, model.quads.nodes, model.node_count)
    everywhere = _assembled(
        6 * model.node_count,
        [
            (model.quads.nodes, quad_stiffness(quad_corners, quads)),
            (model.triangles.nodes, triangle_stiffness(triangle_corners, triangles, lumping)),
            (model.beams.nodes, beam_stiffness(geometry, beams)),
        ],
    )
    stiffness = csc_array(transformation.T @ everywhere @ transformation)
    check_connected(model, stiffness, free)

    progress("assembling the airframe's mass", 0.7)
    inertia = structural_inertia(model, transformation, quads, triangles, beams, geometry)
    progress("assembling the airframe's mass", 1.0)
    return Structure(model, transformation, stiffness, inertia, free)


def check_nodes(model: FiniteElementModel) -> None:
    """Refuse models whose arrays do not fit together.

    Raises
    ------
    ModelError
        Positions are not finite, or an element or lumped mass names a node row that is not there.
    """
    bad = ~np.isfinite(model.coordinates).all(axis=1)
    if np.any(bad):
        node = model.node_identifiers[np.argmax(bad)]
        raise ModelError(f"node {node} has position {model.coordinates[bad][0].tolist()}")
    for kind, identifiers, nodes in (
        ("quadrilateral", model.quads.identifiers, model.quads.nodes),
        ("triangle", model.triangles.identifiers, model.triangles.nodes),
        ("beam", model.beams.identifiers, model.beams.nodes),
        ("lumped mass", model.point_masses.identifiers, model.point_masses.nodes[:, None]),
    ):
        outside = np.any((nodes < 0) | (nodes >= model.node_count), axis=1)
        if np.any(outside):
            worst = int(np.argmax(outside))
            raise ModelError(
                f"{kind} {identifiers[worst]} uses node rows {nodes[worst].tolist()}; "
                f"the model has {model.node_count} nodes"
            )


def check_connected(model: FiniteElementModel, stiffness: csc_array, free: IntArray) -> None:
    """Refuse loose freedoms and models in several unconnected parts.

    Raises
    ------
    ModelError
        Names a loose node and component, or nodes of the two largest separate parts.
    """
    loose = ~(stiffness.diagonal() > 0.0)
    if np.any(loose):
        freedom = int(free[np.argmax(loose)])
        raise ModelError(
            f"node {model.node_identifiers[freedom // 6]} has no stiffness in "
            f"{COMPONENTS[freedom % 6]} ({int(loose.sum())} such freedoms in the model)"
        )
    nodes, rows = np.unique(free // 6, return_inverse=True)
    entries = stiffness.tocoo()
    graph = coo_array(
        (np.ones(entries.nnz), (rows[entries.coords[0]], rows[entries.coords[1]])),
        shape=(len(nodes), len(nodes)),
    )
    parts, labels = connected_components(graph, directed=False)
    if parts > 1:
        sizes = np.bincount(labels)
        order = np.argsort(sizes)[::-1]
        first, second = (model.node_identifiers[nodes[np.argmax(labels == k)]] for k in order[:2])
        raise ModelError(
            f"the structure falls into {parts} parts: node {first} ({sizes[order[0]]} nodes) and "
            f"node {second} ({sizes[order[1]]} nodes) are not connected"
        )


def _assembled(size: int, elements: list[tuple[IntArray, Array]]) -> csr_array:
    """Sum of element matrices (m, 6 k, 6 k) on nodes (m, k)."""
    rows, columns, values = [], [], []
    for nodes, matrices in elements:
        width = 6 * nodes.shape[1]
        freedoms = (6 * nodes[:, :, None] + np.arange(6)).reshape(len(nodes), width)
        rows.append(np.repeat(freedoms, width, axis=1).ravel())
        columns.append(np.tile(freedoms, (1, width)).ravel())
        values.append(matrices.ravel())
    at = (np.concatenate(rows), np.concatenate(columns))
    matrix = csr_array(coo_array((np.concatenate(values), at), shape=(size, size)))
    matrix.eliminate_zeros()
    return matrix
