"""Large-rotation statics of supported structures: full Newton iteration with the true tangent."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import splu

from solver.arrays import Array, BoolArray
from solver.errors import ModelError, SimulationDivergedError
from solver.nonlinear.configuration import Configuration, Pose, initial_pose
from solver.nonlinear.rotations import composed, exponential_quaternions
from solver.nonlinear.structure import NonlinearStructure
from solver.nonlinear.tangent import tangent_stiffness

MAXIMUM_ITERATIONS = 40
#: Largest translation [share of the structure's size] and turn [rad] of one iteration.
_LARGEST_TURN = 0.5


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
        Shares of the loads, one after another.
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
    count = structure.model.node_count
    pose = initial_pose(structure.model.coordinates)
    moving = np.flatnonzero(~fixed.ravel())
    size = float(np.ptp(structure.model.coordinates, axis=0).max())
    scale = float(np.linalg.norm(np.max(np.abs(levels)) * loads.ravel()[moving]))
    positions, iterations = np.empty((len(levels), count, 3)), 0
    for step, level in enumerate(levels):
        for _ in range(MAXIMUM_ITERATIONS):
            at = structure.constraints.placed(pose)
            residual = (level * loads - structure.elements.static_loads(at)).ravel()[moving]
            if np.linalg.norm(residual) <= tolerance * scale:
                break
            tangent = tangent_stiffness(structure.elements, at)
            change = np.zeros(6 * count)
            change[moving] = splu(tangent[moving][:, moving].tocsc()).solve(residual)
            pose = _moved(pose, change.reshape(-1, 6), size)
            iterations += 1
        else:
            raise SimulationDivergedError(
                f"no equilibrium at load level {level:g}: residual {np.linalg.norm(residual):.3g} "
                f"of loads {scale:.3g} after {MAXIMUM_ITERATIONS} iterations"
            )
        positions[step] = pose.positions
    return StaticPath(np.asarray(levels), positions, structure.constraints.placed(pose), iterations)


def _moved(pose: Pose, change: Array, size: float) -> Pose:
    """Pose after a correction (n, 6), shortened where it would turn or move nodes too far."""
    farthest = max(
        float(np.linalg.norm(change[:, :3], axis=1).max()) / size,
        float(np.linalg.norm(change[:, 3:], axis=1).max()),
    )
    share = min(1.0, _LARGEST_TURN / farthest) if farthest > 0.0 else 1.0
    turns = exponential_quaternions(share * change[:, 3:])
    return Pose(pose.positions + share * change[:, :3], composed(turns, pose.quaternions))
