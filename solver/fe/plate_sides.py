"""What discrete Kirchhoff-Mindlin plates have in common: rotations that bend along their sides.

Along a side from corner i to corner j the deflection is cubic, the rotation in the side's direction
quadratic and the transverse shear strain constant.  The rotation in the middle exceeds the mean of
the corners by

    d = -3 / (2 l (1 + phi)) (w_j - w_i + l (beta_i + beta_j) / 2),

the shear strain is -2/3 phi d, and phi = 12 D_b / (D_s l^2) is the ratio of bending to shear
stiffness.  A thin plate has no shear strain there and bends; a thick one shears and keeps straight.
Rotations are u = z beta_x, v = z beta_y, so that beta_x = ry and beta_y = -rx.

Source: I. Katili, A new discrete Kirchhoff-Mindlin element based on Mindlin-Reissner plate theory
and assumed shear strain fields, parts I and II, Int. J. Num. Meth. Eng. 36, 1993, 1859-1908.
"""

import numpy as np

from solver.arrays import Array
from solver.fe.sections import ShellSections

SHEAR_CORRECTION = 5.0 / 6.0
#: Pairs of corners, from and to.
Sides = tuple[tuple[int, int], ...]


def shear_ratios(corners: Array, sides: Sides, sections: ShellSections) -> Array:
    """Ratio phi (m, k) of bending to shear stiffness along k sides of flat corners (m, n, 2)."""
    plate = sections.young_modulus * sections.thickness**2 / (1.0 - sections.poisson_ratio**2)
    squares = np.stack([np.sum((corners[:, j] - corners[:, i]) ** 2, axis=1) for i, j in sides], 1)
    ratios: Array = (plate / (SHEAR_CORRECTION * sections.shear_modulus))[:, None] / squares
    return ratios


def side_excess(corners: Array, sides: Sides, ratios: Array) -> tuple[Array, Array]:
    """Excess rotation (m, k, 6 n) in the middle of k sides, and their unit vectors (m, k, 2).

    The operators act on the corners' freedoms ux uy uz rx ry rz in the element's axes.
    """
    along = np.stack([corners[:, j] - corners[:, i] for i, j in sides], axis=1)
    lengths = np.linalg.norm(along, axis=2)
    directions = along / lengths[..., None]
    excess = np.zeros((len(corners), len(sides), 6 * corners.shape[1]))
    for side, (i, j) in enumerate(sides):
        excess[:, side, 6 * i + 2] = 1.5 / lengths[:, side]
        excess[:, side, 6 * j + 2] = -1.5 / lengths[:, side]
        for corner in (i, j):
            excess[:, side, 6 * corner + 4] = -0.75 * directions[:, side, 0]
            excess[:, side, 6 * corner + 3] = 0.75 * directions[:, side, 1]
    return excess / (1.0 + ratios)[..., None], directions


def side_shear(excess: Array, ratios: Array) -> Array:
    """Transverse shear strain (m, k, 6 n) along the sides, in their directions."""
    shear: Array = -2.0 / 3.0 * ratios[..., None] * excess
    return shear
