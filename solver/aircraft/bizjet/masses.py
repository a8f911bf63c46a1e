"""Non-structural masses: equipment, furnishing, fuel and payload as lumped masses.

What the operating empty mass leaves after the structure and the equipment with a place of its own
is spread over the fuselage so that the reference loading has its stated centre of gravity and
pitch inertia; of all spreads that do, the one of greatest entropy is taken (the smoothest).
"""

from dataclasses import dataclass

import numpy as np

from solver.aircraft.bizjet import dimensions as dim
from solver.aircraft.bizjet import loading
from solver.aircraft.bizjet.assembly import Parts
from solver.aircraft.bizjet.wing import Wing
from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.fe.structure import build_structure

#: First CONM2 identifier of each block.
EQUIPMENT, FURNISHING = 10_000_001, 20_000_001
TANK_BLOCKS = {-1: 30_000_001, 1: 40_000_001}
BAY_BLOCKS = (50_000_001, 60_000_001, 70_000_001)
#: Remaining error of the spread's moments, relative to the largest lever.
TIGHT = 1e-11
#: Below this error Newton's full step is taken; the dual changes by less than its rounding.
QUADRATIC = 1e-4
#: Masses below this are not worth a card [kg].
NEGLIGIBLE = 1e-6


@dataclass(frozen=True, slots=True)
class MassGroupRange:
    """CONM2 identifiers of one tank or bay."""

    name: str
    capacity: float
    first: int
    last: int


def add_masses(parts: Parts) -> list[MassGroupRange]:
    """Attach every lumped mass; returns the tanks and bays."""
    _equipment(parts)
    groups = [_tank(parts, side) for side in (-1, 1)]
    groups += [_bay(parts, k) for k in range(len(loading.PAYLOAD_BAYS))]
    _furnishing(parts)
    return groups


def _equipment(parts: Parts) -> None:
    mesh = parts.mesh
    for row in parts.engines.values():
        mesh.mass(row, loading.ENGINE_MASS, EQUIPMENT, inertia=np.diag(loading.ENGINE_INERTIA))
    # The upper strut hangs between its trunnion pins, part of it on the brace.
    for pins in parts.main_pins.values():
        for pin, share in zip(pins, (0.4, 0.4, 0.2), strict=True):
            mesh.mass(pin.row, share * loading.MAIN_UPPER_STRUT, EQUIPMENT)
    for pin, share in zip(parts.nose_pins, (0.3, 0.3, 0.2, 0.2), strict=True):
        mesh.mass(pin.row, share * loading.NOSE_UPPER_STRUT, EQUIPMENT)
    for wing in parts.wings.values():
        _wing_edges(parts, wing)
    sub = parts.divisions.subdivisions
    for box in parts.tailplane.values():
        _tail_edges(parts, box[::sub][:, [0, -1]].reshape(-1, 4), loading.TAIL_EDGES, 0.25)
    fin = parts.fin[:, ::sub][:, :, [0, -1]].transpose(1, 2, 0).reshape(-1, 4)
    _tail_edges(parts, fin, loading.FIN_EDGES, 0.35)


def _wing_edges(parts: Parts, wing: Wing) -> None:
    """Leading edge, trailing edge with flaps, systems and winglet on the ribs' corners."""
    lines = np.flatnonzero(wing.span.structural)
    y = wing.span.positions[lines]
    chord = dim.wing_chord(y)
    share = chord * np.gradient(y)
    share /= share.sum()
    for k, line in enumerate(lines):
        corners = wing.box[line][[0, 0, -1, -1], [0, -1, 0, -1]]
        points = parts.mesh.points(corners)
        front, rear = points[:2].mean(axis=0), points[2:].mean(axis=0)
        items = [
            (loading.WING_LEADING_EDGE * share[k], front - np.array([0.08 * chord[k], 0.0, 0.0])),
            (loading.WING_SYSTEMS * share[k], front),
            (loading.WING_TRAILING_EDGE * share[k], rear + np.array([0.17 * chord[k], 0.0, 0.0])),
        ]
        if line == lines[-1]:
            items.append((loading.WINGLET, rear + np.array([0.0, 0.1 * wing.side, 0.3])))
        _carried(parts, corners, items)


def _tail_edges(parts: Parts, ribs: IntArray, total: float, lever: float) -> None:
    """Hang a third ahead of the front spar and the rest behind the rear spar."""
    each = total / len(ribs)
    for corners in ribs:
        points = parts.mesh.points(corners)
        front, rear = points[:2].mean(axis=0), points[2:].mean(axis=0)
        _carried(
            parts,
            corners,
            [
                (each / 3, front - np.array([lever / 2, 0.0, 0.0])),
                (2 * each / 3, rear + np.array([lever, 0.0, 0.0])),
            ],
        )


def _carried(parts: Parts, corners: IntArray, items: list[tuple[float, Array]]) -> None:
    """One lumped mass for several items at places (3,), held by the corners of a rib.

    Put straight on a skin node with an offset, it would rock on that node's rotation alone.
    """
    masses = np.array([mass for mass, _ in items])
    places = np.array([place for _, place in items])
    centre = masses @ places / masses.sum()
    levers = places - centre
    second = (levers.T * masses) @ levers
    row = parts.mesh.free_node(*centre)
    # The written node is rounded; the offset puts the mass back where it belongs.
    offset = centre - parts.mesh.points(row)
    parts.mesh.interpolated.append((row, [int(corner) for corner in corners]))
    parts.mesh.mass(row, masses.sum(), EQUIPMENT, offset, np.trace(second) * np.eye(3) - second)


def _tank(parts: Parts, side: int) -> MassGroupRange:
    """Fuel in proportion to the box's volume between the tank's ends, on the skins' nodes."""
    wing, sub = parts.wings[side], parts.divisions.subdivisions
    lines = np.flatnonzero(wing.span.structural)
    y = wing.span.positions[lines]
    low = parts.mesh.points(wing.lower[lines][:, ::sub])
    high = parts.mesh.points(wing.upper[lines][:, ::sub])
    inside = np.clip(y, *loading.TANK_SPAN)
    length = np.diff(inside)
    height = high[..., 2] - low[..., 2]
    width = np.diff(low[..., 0], axis=1)
    depth = 0.25 * (height[1:, 1:] + height[:-1, 1:] + height[1:, :-1] + height[:-1, :-1])
    volume = length[:, None] * 0.5 * (width[1:] + width[:-1]) * depth
    # A cell that the tank's end cuts gives its fuel to its ends by the lever rule.
    centre = 0.5 * (inside[1:] + inside[:-1])
    outer = ((centre - y[:-1]) / np.diff(y))[:, None]
    nodal = np.zeros(height.shape)
    for shift, part in ((0, (1 - outer) * volume), (1, outer * volume)):
        nodal[shift : len(nodal) - 1 + shift, :-1] += part / 2
        nodal[shift : len(nodal) - 1 + shift, 1:] += part / 2
    nodal *= loading.FUEL_CAPACITY / nodal.sum()
    identifiers = []
    for surface in (wing.lower, wing.upper):
        for row, mass in zip(surface[lines][:, ::sub].ravel(), 0.5 * nodal.ravel(), strict=True):
            if mass > NEGLIGIBLE:
                identifiers.append(parts.mesh.mass(int(row), mass, TANK_BLOCKS[side]))
    name = "wing-left" if side < 0 else "wing-right"
    return MassGroupRange(name, loading.FUEL_CAPACITY, identifiers[0], identifiers[-1])


def _bay(parts: Parts, number: int) -> MassGroupRange:
    """Payload on the floor: each station carries what lies nearest to it."""
    name, capacity, first, last = loading.PAYLOAD_BAYS[number]
    fuselage, sub = parts.fuselage, parts.divisions.subdivisions
    frames = np.flatnonzero(fuselage.stations.structural)
    x = fuselage.stations.positions[frames]
    borders = np.concatenate([[-np.inf], 0.5 * (x[1:] + x[:-1]), [np.inf]])
    share = np.clip(np.minimum(borders[1:], last) - np.maximum(borders[:-1], first), 0, None)
    share /= share.sum()
    identifiers = []
    for frame, part in zip(frames, share, strict=True):
        rows = fuselage.floor[frame, sub:-sub:sub]
        if part > 0:
            identifiers += [
                parts.mesh.mass(int(row), capacity * part / len(rows), BAY_BLOCKS[number])
                for row in rows
            ]
    return MassGroupRange(name, capacity, identifiers[0], identifiers[-1])


def _furnishing_rows(parts: Parts) -> tuple[IntArray, Array]:
    """Nodes that may carry furnishing, systems and crew, and the length each stands for."""
    fuselage = parts.fuselage
    frames = np.flatnonzero(fuselage.stations.structural)
    x = fuselage.stations.positions[frames]
    spacing = np.gradient(x)
    rows, weights = [], []
    for frame, length in zip(frames, spacing, strict=True):
        for angle in (dim.FLOOR, dim.PYLON_LOWER, dim.FIN_ROOT):
            for side in (-1, 1):
                rows.append(fuselage.nodes[frame, fuselage.column(angle, side)])
                weights.append(length)
        if fuselage.cabin.start < frame < fuselage.cabin.stop - 1:
            track = fuselage.angles.index(dim.KEEL_WEB)
            for column in (fuselage.floor_half - track, fuselage.floor_half + track):
                rows.append(fuselage.floor[frame, column])
                weights.append(2 * length)
    return np.array(rows, dtype=np.int64), np.array(weights)


def _furnishing(parts: Parts) -> None:
    """Spread the rest of the operating empty mass."""
    model = parts.mesh.model()
    # Lumped masses on pins and engines hang on constraints; their place counts, not their path.
    properties = build_structure(model).inertia
    lumped = model.point_masses
    sampled = np.asarray(properties.scalar_mass.sum(axis=1)).ravel()
    factors = _reference_factors(lumped.identifiers)
    structure = len(sampled) - len(lumped.masses)
    at = properties.points
    mass = sampled.copy()
    mass[structure:] *= factors
    second = at.T @ (properties.scalar_mass @ at)  # exact for the structure's consistent mass
    second += (at[structure:].T * ((factors - 1) * lumped.masses)) @ at[structure:]
    own = properties.rotary.sum(axis=0)
    for unsprung, place in loading.UNSPRUNG:
        mass = np.append(mass, unsprung)
        at = np.vstack([at, place])
        second += unsprung * np.outer(place, place)
    empty = float(sampled[:structure].sum()) + float(
        lumped.masses[lumped.identifiers < TANK_BLOCKS[-1]].sum()
    )
    rest = loading.OPERATING_EMPTY - loading.UNSPRUNG_MASS - empty
    if rest <= 0:
        raise ModelError(f"structure and equipment of {empty:.0f} kg exceed the empty mass")
    total = loading.MAXIMUM_LANDING
    x_ref, z_ref = loading.REFERENCE_CENTRE
    moments = np.array([x_ref, z_ref]) * total - (mass @ at)[[0, 2]]
    polar = (
        loading.REFERENCE_PITCH_INERTIA + total * (x_ref**2 + z_ref**2)
        - second[0, 0] - second[2, 2] - own[1, 1]
    )  # fmt: skip
    rows, base = _furnishing_rows(parts)
    shares = spread(parts.mesh.points(rows), base, rest, moments, float(polar))
    for row, share in zip(rows, shares, strict=True):
        if share > NEGLIGIBLE:
            parts.mesh.mass(int(row), float(share), FURNISHING)


def _reference_factors(identifiers: IntArray) -> Array:
    """Share of each lumped mass that is on board in the reference loading."""
    tanks = (identifiers >= TANK_BLOCKS[-1]) & (identifiers < BAY_BLOCKS[0])
    return np.where(tanks, loading.REFERENCE_FUEL_SHARE, 1.0)


def spread(points: Array, base: Array, mass: float, moments: Array, polar: float) -> Array:
    """Masses at ``points`` of greatest entropy relative to ``base`` with given moments.

    Parameters
    ----------
    points : (n, 3) array
        Places [m].
    base : (n,) array
        Relative weights before the moments are asked for.
    mass, moments, polar : float, (2,) array, float
        Sum of m [kg], of m x and m z [kg m], of m (x^2 + z^2) [kg m2].

    Raises
    ------
    ModelError
        No positive masses at these points have the moments.

    Notes
    -----
    Jaynes, Information theory and statistical mechanics, Phys. Rev. 106 (1957): the weights are
    base * exp(a x + b z + c (x^2 + z^2)); a, b, c by Newton's method on the convex dual.
    """
    x, z = points[:, 0], points[:, 2]
    centre = np.array([*moments, polar]) / mass
    features = np.stack([x, z, x * x + z * z], axis=1) - centre
    scale = np.abs(features).max(axis=0)
    features = features / scale
    multiplier = np.zeros(3)

    def weights(at: Array) -> tuple[Array, float]:
        exponent = features @ at
        top = float(exponent.max())
        values = base * np.exp(exponent - top)
        return values / values.sum(), top + float(np.log(values.sum()))

    for _ in range(200):
        share, dual = weights(multiplier)
        gradient = share @ features
        if np.abs(gradient).max() < TIGHT:
            return np.asarray(mass * share)
        hessian = (features.T * share) @ features - np.outer(gradient, gradient)
        step = np.linalg.solve(hessian + 1e-14 * np.eye(3), gradient)
        length = 1.0
        if np.abs(gradient).max() > QUADRATIC:
            while length > 1e-6 and (
                weights(multiplier - length * step)[1] > dual - 1e-4 * length * (gradient @ step)
            ):
                length /= 2
        multiplier = multiplier - length * step
        if np.abs(multiplier).max() > 1e4:
            break
    raise ModelError(
        f"no spread of {mass:.0f} kg has its centre at {centre[:2]} m and polar moment {polar:.0f}"
    )
