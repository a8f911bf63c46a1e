"""Air loads on the airframe: six distributions whose resultants are exactly the unit wrenches.

Six physical distributions are laid over the skins that the definition names: drag over wing and
fuselage, side force over the fuselage, lift over the wing, rolling lift over the wing, lift over
the tailplane, side force over the fin.  Their resultants about the structural origin are six
independent wrenches, so that exactly one mixture of them has any given resultant; the shapes
returned are the mixtures for unit forces and unit moments.  A landing's air loads thus act as wing
lift, tail lift, roll damping, sideslip and drag of the right size, whatever their point of
reference, and balance to rounding.

Along the span lift follows Schrenk: half the chord, half an ellipse of equal area (O. Schrenk,
NACA TM 948, 1940).  Rolling lift is local chord times distance from the centre line (strip
theory).  Along the chord pressure is linear, such that its centre lies where the definition says;
loads ahead of the front spar therefore come as a heavier front spar, as they do through ribs.
"""

import numpy as np

from solver.aircraft.definition import AirLoadLayout, LiftingSurface, LoadedSkin, Planform
from solver.arrays import Array, BoolArray, IntArray
from solver.errors import ModelError
from solver.fe.model import FiniteElementModel
from solver.fe.structure import Structure

_X, _Y, _Z = 0, 1, 2
#: Worst condition number of the six resultants (moments per metre of span) that is accepted.
_WORST_CONDITION = 1e4


def air_load_shapes(structure: Structure, layout: AirLoadLayout) -> Array:
    """Distribute unit wrenches: loads (n_free, 6), resultants e_1 to e_6 about the origin.

    Raises
    ------
    ModelError
        A named skin holds no element, or the six distributions cannot make up every wrench (for
        instance a tail that coincides with the wing).
    """
    model = structure.model
    wing, pressures = _lift(model, layout.wing, _Y, "wing")
    tail, _ = _lift(model, layout.tail, _Y, "tail")
    fin, _ = _lift(model, layout.fin, _Z, "fin")
    fuselage = _tributary(model, layout.fuselage, "fuselage")
    share = layout.fuselage_drag_share
    wing_area = _tributary(model, layout.wing.skin, "wing")
    drag = share * fuselage / fuselage.sum() + (1 - share) * wing_area / wing_area.sum()
    span = model.coordinates[:, _Y]
    roll = pressures * span
    if not np.any(roll):
        raise ModelError("air_loads.wing: all its skin lies on the centre line")
    distributions = np.zeros((model.node_count, 6, 6))
    for column, (axis, weights) in enumerate(
        [
            (_X, drag),
            (_Y, fuselage / fuselage.sum()),
            (_Z, wing / wing.sum()),
            (_Z, roll / (roll @ span)),
            (_Z, tail / tail.sum()),
            (_Y, fin / fin.sum()),
        ]
    ):
        distributions[:, axis, column] = weights
    shapes = structure.transformation.T @ distributions.reshape(-1, 6)
    modes = structure.rigid_modes(np.zeros(3))
    resultants = modes.T @ shapes
    scale = np.array([1.0] * 3 + [1.0 / max(np.ptp(span), 1.0)] * 3)
    condition = float(np.linalg.cond(scale[:, None] * resultants / np.linalg.norm(
        scale[:, None] * resultants, axis=0)))  # fmt: skip
    if not condition < _WORST_CONDITION:
        raise ModelError(
            "air_loads: wing, tail, fin and fuselage together cannot carry every force and moment "
            f"(condition number {condition:.3g}); are tail and fin well behind the wing?"
        )
    shapes = np.linalg.solve(resultants.T, shapes.T).T
    # one more pass removes the rounding of the first
    return np.asarray(np.linalg.solve((modes.T @ shapes).T, shapes.T).T)


def schrenk_lift(planform: Planform, position: Array) -> Array:
    """Lift per span at ``position`` from the root, up to a constant (Schrenk, NACA TM 948).

    The mean of the chord and of the quarter ellipse of the same area over the semispan.
    """
    root, tip = planform.span_position[0], planform.span_position[-1]
    semispan = tip - root
    area = float(np.trapezoid(planform.chord, planform.span_position))
    chord = np.interp(position, planform.span_position, planform.chord)
    share = np.clip((position - root) / semispan, 0.0, 1.0)
    ellipse = 4 * area / (np.pi * semispan) * np.sqrt(1 - share**2)
    return np.asarray((chord + ellipse) / 2)


def _lift(
    model: FiniteElementModel, surface: LiftingSurface, span_axis: int, name: str
) -> tuple[Array, Array]:
    """Nodal weights (n,) of a surface's lift, and those of a uniform lift per chord and span."""
    area = _tributary(model, surface.skin, name)
    planform = surface.planform
    position = model.coordinates[:, span_axis]
    if span_axis == _Y:
        position = np.abs(position)
    chord = np.interp(position, planform.span_position, planform.chord)
    leading_edge = np.interp(position, planform.span_position, planform.leading_edge)
    aft = (model.coordinates[:, _X] - leading_edge) / chord - surface.centre_of_pressure
    if np.any(np.abs(aft[area > 0]) > 2.0):
        worst = int(np.argmax(np.abs(aft) * (area > 0)))
        raise ModelError(
            f"air_loads.{name}: GRID {model.node_identifiers[worst]} lies more than two chords "
            "from the planform; check stations and span positions"
        )
    pressure = np.ones_like(area)
    if surface.law == "schrenk":
        pressure = schrenk_lift(planform, position) / chord
    return _centred(area * pressure, aft), _centred(area, aft)


def _centred(weights: Array, aft: Array) -> Array:
    """Weights made linear along the chord so that their mean position ``aft`` is zero."""
    second = float(weights @ aft**2)
    if second == 0.0:
        return weights
    return weights * (1 - float(weights @ aft) / second * aft)


def _tributary(model: FiniteElementModel, skin: LoadedSkin, name: str) -> Array:
    """Skin area [m2] of each node (n,); without shells, beam length [m]."""
    shares = np.zeros(model.node_count)
    for shells in (model.quads, model.triangles):
        used = _carriers(model, skin, shells.nodes, shells.properties)
        corners = model.coordinates[shells.nodes[used]]
        area = (
            np.linalg.norm(
                np.cross(corners[:, 2] - corners[:, 0], corners[:, -1] - corners[:, 1]), axis=1
            )
            / 2
        )
        count = shells.nodes.shape[1]
        np.add.at(shares, shells.nodes[used], np.repeat(area[:, None] / count, count, axis=1))
    if not np.any(shares):
        used = _carriers(model, skin, model.beams.nodes, model.beams.properties)
        ends = model.coordinates[model.beams.nodes[used]]
        length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        np.add.at(shares, model.beams.nodes[used], np.repeat(length[:, None] / 2, 2, axis=1))
    if not np.any(shares):
        raise ModelError(f"air_loads.{name}: no element has these properties and nodes")
    return shares


def _carriers(
    model: FiniteElementModel, skin: LoadedSkin, nodes: IntArray, properties: IntArray
) -> BoolArray:
    """Mask (m,) of the elements that belong to a skin."""
    used = np.ones(len(properties), dtype=bool)
    if skin.properties is not None:
        used &= skin.properties.contains(properties)
    if skin.nodes is not None:
        used &= skin.nodes.contains(model.node_identifiers[nodes]).all(axis=1)
    return used
