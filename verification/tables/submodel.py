"""Nonlinear statics of the surroundings of an element, driven by a linear analysis.

What a linear analysis misses by the geometry of one panel: the nodes around an element are set
free, all others stay where the linear analysis puts them, and the loads on the free nodes, inertia
included, are those the linear analysis balances.  Equilibrium at finite rotation is followed from
no load to the whole of it.
"""

from dataclasses import replace
from typing import TypeVar

import numpy as np
from scipy.sparse.linalg import splu

from solver.aircraft.airframe import Airframe
from solver.arrays import Array, BoolArray, IntArray
from solver.fe.model import Beams, FiniteElementModel, Shells
from solver.nonlinear.configuration import Pose, initial_pose
from solver.nonlinear.rotations import exponential_quaternions
from solver.nonlinear.structure import NonlinearStructure, nonlinear_structure
from solver.nonlinear.tangent import free_tangent

#: Nodes farther from the element than this follow the linear analysis [m].
REACH = 1.5
#: Residual relative to the loads and the forces of the elements.
_TOLERANCE = 1e-6
_ITERATIONS = 15
_FIRST_LEVEL, _SMALLEST_LEVEL = 0.25, 1e-3

Elements = TypeVar("Elements", Shells, Beams)


def panel_stress(airframe: Airframe, displacement: Array, element: int) -> float:
    """Von Mises stress of an element in nonlinear equilibrium of its surroundings [Pa].

    Parameters
    ----------
    displacement : (n_free,) array
        Of the linear analysis [m, rad].

    Returns
    -------
    float
        Not a number where the equilibrium ends before the whole load is on.
    """
    model = airframe.structure.model
    is_near = np.linalg.norm(model.coordinates - airframe.centroids[element], axis=1) < REACH
    free = airframe.structure.free
    moving = np.flatnonzero(is_near[free // 6])
    # Constraints carry the motion of near nodes to others.
    follows = np.zeros(model.node_count, dtype=bool)
    follows[np.unique(airframe.structure.transformation[:, moving].tocoo().coords[0] // 6)] = True
    part, at_hand = _surroundings(model, follows)
    structure = nonlinear_structure(part)
    loads = airframe.structure.stiffness @ displacement
    # The turn of the surroundings as a whole would strain them at second order.
    rigid = airframe.structure.rigid_modes(airframe.centroids[element])
    motion = np.linalg.lstsq(rigid[moving], displacement[moving], rcond=None)[0]
    pose = _followed(structure, moving, loads, displacement - rigid @ motion)
    if pose is None:
        return float("nan")
    at = structure.constraints.placed(pose)
    shells, beams = structure.elements.stresses(structure.elements.deformations(at))
    stress = airframe.recovery.von_mises(shells[:, None], beams[:, None])[:, 0]
    return float(stress[np.count_nonzero(at_hand[:element])])


def _surroundings(
    model: FiniteElementModel, follows: BoolArray
) -> tuple[FiniteElementModel, BoolArray]:
    """Model of the elements that a near node belongs to, and which of all these are."""
    kept = [
        np.asarray(np.any(follows[part.nodes], axis=1))
        for part in (model.quads, model.triangles, model.beams)
    ]
    part = replace(
        model,
        quads=_kept(model.quads, kept[0]),
        triangles=_kept(model.triangles, kept[1]),
        beams=_kept(model.beams, kept[2]),
    )
    return part, np.concatenate(kept)


def _kept(elements: Elements, kept: BoolArray) -> Elements:
    """Leave out elements."""
    names = type(elements).__dataclass_fields__
    return replace(elements, **{name: getattr(elements, name)[kept] for name in names})


def _followed(
    structure: NonlinearStructure, moving: IntArray, loads: Array, displacement: Array
) -> Pose | None:
    """Pose under the whole load, in levels that are halved where the next one is not found."""
    pose, level, stride = initial_pose(structure.model.coordinates), 0.0, _FIRST_LEVEL
    whole = _held(structure, _moved(structure, pose, displacement))
    scale = float(np.linalg.norm(loads[moving]) + np.linalg.norm(whole[moving]))
    while level < 1.0:
        target = min(1.0, level + stride)
        guess = _moved(structure, pose, (target - level) * displacement)
        found = _equilibrium(structure, moving, target * loads, guess, _TOLERANCE * scale)
        if found is not None:
            pose, level = found, target
        elif stride > _SMALLEST_LEVEL:
            stride /= 2
        else:
            return None
    return pose


def _equilibrium(
    structure: NonlinearStructure, moving: IntArray, loads: Array, pose: Pose, limit: float
) -> Pose | None:
    """Newton's iteration at one level; None if it does not converge."""
    for _ in range(_ITERATIONS):
        residual = np.zeros_like(loads)
        residual[moving] = (loads - _held(structure, pose))[moving]
        size = float(np.linalg.norm(residual))
        if size <= limit:
            return pose
        if not np.isfinite(size):
            return None
        # The tangent stands in axes that have turned with each node.
        at = structure.constraints.placed(pose)
        turns = at.rotations[structure.free_nodes]
        own = (residual.reshape(-1, 2, 3) @ turns).ravel()
        tangent = free_tangent(structure, at)[moving][:, moving].tocsc()
        change = np.zeros_like(loads)
        change[moving] = splu(tangent).solve(own[moving])
        change = (change.reshape(-1, 2, 3) @ np.swapaxes(turns, 1, 2)).ravel()
        pose = _moved(structure, pose, change)
    return None


def _held(structure: NonlinearStructure, pose: Pose) -> Array:
    """Give the loads (n_free,) that the elements hold in a pose."""
    at, elements = structure.constraints.placed(pose), structure.elements
    deformations = elements.deformations(at)
    loads = np.zeros((structure.model.node_count, 6))
    elements.add_loads(at, deformations, elements.forces(deformations), loads)
    return structure.on_free_nodes(at, loads).ravel()


def _moved(structure: NonlinearStructure, pose: Pose, change: Array) -> Pose:
    everywhere = np.zeros((structure.model.node_count, 6))
    everywhere[structure.free_nodes] = change.reshape(-1, 6)
    return pose.moved(everywhere[:, :3], exponential_quaternions(everywhere[:, 3:]))
