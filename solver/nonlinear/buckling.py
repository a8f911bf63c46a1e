"""Linear buckling: how far the loads are from where thin parts give way.

Stresses stiffen or soften a structure by its geometric stiffness K_G, the rate at which the tangent
changes along the linear displacement, seen from axes that turn with each node.  At the factor f
where ``(K + f K_G) x = 0`` a displacement x costs nothing.  A linear analysis is worth something as
long as all factors lie well above one; where they do not, the nonlinear reference bends aside and
the linear one does not notice.

The loads keep their direction.  A free structure therefore also has factors at which it would
rather stand otherwise under them, as a pendulum does; the shapes of these are nearly rigid.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.sparse import csc_array
from scipy.sparse.linalg import LinearOperator, eigsh

from solver.arrays import Array, IntArray
from solver.fe.constraints import constraint_transformation
from solver.inertia_relief.factor import factorise
from solver.nonlinear.configuration import initial_pose
from solver.nonlinear.rotations import exponential_quaternions
from solver.nonlinear.structure import NonlinearStructure
from solver.nonlinear.tangent import tangent_stiffness

#: Largest rotation [rad], and displacement as a share of the extent, to differentiate along.
_REACH = 1e-4


@dataclass(frozen=True, slots=True)
class BucklingModes:
    """Lowest critical factors of one state of loads, ascending."""

    factors: Array  #: (k,) of the loads
    shapes: Array  #: (n_free, k) of the free freedoms, any size


def geometric_stiffness(structure: NonlinearStructure, displacement: Array) -> csc_array:
    """Change of the tangent (n_free, n_free) with the size of a linear ``displacement`` (n_free,).

    [N/m, N, N m]
    """
    freedoms = displacement.reshape(-1, 6)
    extent = float(np.ptp(structure.model.coordinates, axis=0).max())
    largest = max(np.abs(freedoms[:, :3]).max() / extent, np.abs(freedoms[:, 3:]).max())
    share = _REACH / float(largest)
    transformation = constraint_transformation(structure.model)[0]
    sides = []
    for sign in (share, -share):
        moved = np.zeros((structure.model.node_count, 6))
        moved[structure.free_nodes] = sign * freedoms
        pose = initial_pose(structure.model.coordinates).moved(
            moved[:, :3], exponential_quaternions(moved[:, 3:])
        )
        placed = structure.constraints.placed(pose)
        # In axes that turn with the nodes: where the displacement turns a panel as a whole, its
        # stiffness in fixed axes turns, too, and would pass for a change.
        sides.append(tangent_stiffness(structure.elements, placed, own_axes=True))
    change = (sides[0] - sides[1]) / (2 * share)
    free = transformation.T @ change @ transformation
    return csc_array(0.5 * (free + free.T))


def buckling_modes(
    stiffness: Any, geometric: Any, moving: IntArray, count: int = 6
) -> BucklingModes:
    """Find the lowest critical factors of loads that act in their own direction (f > 0).

    Parameters
    ----------
    stiffness, geometric : (n_free, n_free) sparse arrays
        Linear stiffness, and `geometric_stiffness` of the loads' displacement.
    moving : (m,) array
        Freedoms that no support holds; a free structure is held by any statically determinate
        support, see `solver.inertia_relief.static.determinate_support`.
    """
    stiff = csc_array(stiffness[moving][:, moving])
    softening = csc_array(-geometric[moving][:, moving])
    factor = factorise(stiff)
    inverse = LinearOperator(stiff.shape, matvec=factor.solve, dtype=np.float64)
    start = np.random.default_rng(0).normal(size=len(moving))
    values, vectors = eigsh(softening, count, stiff, Minv=inverse, which="LA", v0=start)
    order = np.argsort(values)[::-1]
    shapes = np.zeros((stiffness.shape[0], count))
    shapes[moving] = vectors[:, order]
    with np.errstate(divide="ignore"):
        factors = np.where(values[order] > 0, 1.0 / values[order], np.inf)
    return BucklingModes(factors, shapes)
