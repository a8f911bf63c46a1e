"""Large-rotation statics of supported structures: full Newton iteration with the true tangent."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import splu

from solver.arrays import Array, BoolArray, IntArray
from solver.errors import ModelError, SimulationDivergedError
from solver.nonlinear.configuration import Configuration, Pose, initial_pose
from solver.nonlinear.rotations import composed, exponential_quaternions
from solver.nonlinear.structure import NonlinearStructure
from solver.nonlinear.tangent import tangent_stiffness

MAXIMUM_ITERATIONS = 30
#: Smallest part of the way to a level that is tried.
_SMALLEST_SHARE = 1 / 64
#: Largest translation [share of the structure's size] and turn [rad] of one iteration.
_LARGEST_TURN = 0.3


@dataclass(frozen=True, slots=True)
class StaticPath:
    """Equilibrium at every load level."""

    levels: Array  #: (k,) share of the loads
    positions: Array  #: (k, n, 3) [m]
    final: Configuration
    iterations: int  #: in all


def equilibrium_path(
    structure: NonlinearStructure,
    fixed: BoolArray,
    loads: Array,
    levels: Array,
    tolerance: float = 1e-7,
) -> StaticPath:
    """Follow the equilibrium of a supported structure as its loads grow.

    Parameters
    ----------
    fixed : (n, 6) bool array
        Freedoms that are held; a held rotation keeps its node from any turn about that axis.
    loads : (n, 6) array
        Forces and moments on the nodes that keep their direction [N, N m].
    levels : (k,) array
        Shares of the loads, one after another; the way to one is halved where it is too far.
    tolerance : float
        Residual forces and moments relative to the largest loads, where iteration stops.

    Raises
    ------
    ModelError
        The structure has constraints, which the tangent does not know.
    SimulationDivergedError
        No equilibrium is found; names the level.
    """
    if len(structure.constraints.nodes):
        raise ModelError("large-rotation statics is for structures without constraints")
    moving = np.flatnonzero(~fixed.ravel())
    scale = float(np.linalg.norm(np.max(np.abs(levels)) * loads.ravel()[moving]))
    newton = _Newton(structure, moving, loads, tolerance * scale)
    pose, reached = initial_pose(structure.model.coordinates), 0.0
    positions = np.empty((len(levels), structure.model.node_count, 3))
    for row, level in enumerate(levels.tolist()):
        share = 1.0
        while reached != level:
            target = level if share == 1.0 else reached + share * (level - reached)
            found = newton.equilibrium(pose, target)
            if found is not None:
                pose, reached, share = found, target, 1.0
            elif share > _SMALLEST_SHARE:
                share /= 2
            else:
                raise SimulationDivergedError(
                    f"no equilibrium at load level {target:g}, the last one was at {reached:g}"
                )
        positions[row] = pose.positions
    final = structure.constraints.placed(pose)
    return StaticPath(np.asarray(levels), positions, final, newton.iterations)


class _Newton:
    """Full Newton iteration at one load level."""

    def __init__(
        self, structure: NonlinearStructure, moving: IntArray, loads: Array, limit: float
    ) -> None:
        self._structure, self._moving, self._loads = structure, moving, loads
        self._limit = limit
        self._size = float(np.ptp(structure.model.coordinates, axis=0).max())
        self.iterations = 0

    def equilibrium(self, pose: Pose, level: float) -> Pose | None:
        """Pose under a level of the loads, sought from another; None if it is not found."""
        structure, moving = self._structure, self._moving
        for _ in range(MAXIMUM_ITERATIONS):
            at = structure.constraints.placed(pose)
            residual = (level * self._loads - structure.elements.static_loads(at)).ravel()[moving]
            size = float(np.linalg.norm(residual))
            if size <= self._limit:
                return pose
            if not np.isfinite(size):
                return None
            tangent = tangent_stiffness(structure.elements, at, two_sided=True)
            change = np.zeros(self._loads.size)
            change[moving] = splu(tangent[moving][:, moving].tocsc()).solve(residual)
            pose = _moved(pose, change.reshape(-1, 6), self._size)
            self.iterations += 1
        return None


def _moved(pose: Pose, change: Array, size: float) -> Pose:
    """Pose after a correction (n, 6), shortened where it would turn or move nodes too far."""
    farthest = max(
        float(np.linalg.norm(change[:, :3], axis=1).max()) / size,
        float(np.linalg.norm(change[:, 3:], axis=1).max()),
    )
    share = min(1.0, _LARGEST_TURN / farthest) if farthest > 0.0 else 1.0
    turns = exponential_quaternions(share * change[:, 3:])
    return Pose(pose.positions + share * change[:, :3], composed(turns, pose.quaternions))
