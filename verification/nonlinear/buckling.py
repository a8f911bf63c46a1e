"""Linear buckling of a column and of plates: the geometric stiffness against closed forms.

S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd edition, 1961: Euler's column
(article 2.1), and the simply supported square plate in one direction of compression, 4 pi^2 D / b
for its whole load (article 9.2).
"""

import numpy as np
from scipy.sparse.linalg import splu

from solver.arrays import Array, BoolArray
from solver.fe.model import FiniteElementModel
from solver.fe.structure import build_structure
from solver.nonlinear.buckling import buckling_modes, geometric_stiffness
from solver.nonlinear.structure import nonlinear_structure
from verification.elements import meshes

YOUNG, POISSON = 70e9, 0.3


def column_factor(count: int) -> float:
    """Critical load of a pinned column of ``count`` beams, relative to Euler's."""
    width, height, length = 0.02, 0.01, 1.0
    model = meshes.straight_beam(length, count, meshes.rectangle_section(width, height))
    fixed = np.zeros((count + 1, 6), dtype=bool)
    fixed[0, :4] = fixed[-1, 1:3] = True
    loads = np.zeros((count + 1, 6))
    loads[-1, 0] = -(np.pi**2) * YOUNG * width * height**3 / 12 / length**2
    return _lowest_factor(model, fixed, loads)


def plate_factor(count: int, triangular: bool = False, turn: Array | None = None) -> float:
    """Critical load of a simply supported square plate relative to the closed form.

    ``turn`` (3,) is a rotation of the whole plate that is added to the displacement [rad].
    """
    thickness = 0.01
    model = meshes.plate(1.0, 1.0, count, count, triangular, thickness=thickness)
    nodes = meshes.grid_nodes(count, count)
    fixed = np.zeros((model.node_count, 6), dtype=bool)
    for edge in (nodes[0], nodes[-1], nodes[:, 0], nodes[:, -1]):
        fixed[edge, 2] = True
    fixed[nodes[0, 0], :2] = fixed[nodes[0, -1], 1] = True
    shares = np.full(count + 1, 1.0 / count)
    shares[[0, -1]] /= 2
    rigidity = YOUNG * thickness**3 / 12 / (1 - POISSON**2)
    loads = np.zeros((model.node_count, 6))
    loads[nodes[0], 1] = shares * 4 * np.pi**2 * rigidity
    loads[nodes[-1], 1] = -loads[nodes[0], 1]
    return _lowest_factor(model, fixed, loads, turn)


def _lowest_factor(
    model: FiniteElementModel, fixed: BoolArray, loads: Array, turn: Array | None = None
) -> float:
    linear = build_structure(model)
    moving = np.flatnonzero(~fixed.ravel())
    displacement = np.zeros(fixed.size)
    stiffness = linear.stiffness[moving][:, moving].tocsc()
    displacement[moving] = splu(stiffness).solve(loads.ravel()[moving])
    if turn is not None:
        displacement += linear.rigid_modes(np.zeros(3))[:, 3:] @ turn
    geometric = geometric_stiffness(nonlinear_structure(model), displacement)
    return float(buckling_modes(linear.stiffness, geometric, moving, 2).factors[0])
