"""Four-node plate in bending: the discrete Kirchhoff-Mindlin quadrilateral DKMQ.

Rotations are bilinear plus a bubble on every side, (1 - s^2) times the excess of `plate_sides`.
Transverse shear is interpolated from the constant strains along the sides.  Thin plates give the
discrete Kirchhoff quadrilateral DKQ, thick ones a Mindlin plate.

Why not Mindlin's plate with shear tied at the sides (MITC4): where walls meet in a fold, the
rotation that is drilling in one wall is bending in the other.  In a box under torsion the walls'
mean spin is half of the slope of their edges, and with one element to a wall both belong to the
same freedom.  MITC4 meets the difference with its shear stiffness, G t, and the box locks (5 % too
stiff, 10 % with ribs); here the sides bend, at E t^3 / h^2.

Source: I. Katili, A new discrete Kirchhoff-Mindlin element, part II: an extended DKQ element for
thick-plate bending analysis, Int. J. Num. Meth. Eng. 36, 1993, 1885-1908.
"""

import numpy as np

from solver.arrays import Array
from solver.fe.bilinear import GAUSS_POINTS, jacobian, quadratic, shape_functions
from solver.fe.plate_sides import SHEAR_CORRECTION, shear_ratios, side_excess, side_shear
from solver.fe.sections import ShellSections

#: Two sides along xi, at eta -1 and +1; two along eta, at xi -1 and +1.
SIDES = ((0, 1), (3, 2), (0, 3), (1, 2))
ACROSS = (-1.0, 1.0, -1.0, 1.0)


def plate_stiffness(corners: Array, sections: ShellSections) -> Array:
    """Stiffness (m, 24, 24) of flat quadrilaterals (m, 4, 2), node-wise ux uy uz rx ry rz.

    [N/m, N, N m], in the element's axes; membrane and drilling freedoms stay free.
    """
    thickness = sections.thickness
    bending = sections.plane_stress * (thickness**3 / 12.0)[:, None, None]
    shear = SHEAR_CORRECTION * sections.shear_modulus * thickness
    ratios = shear_ratios(corners, SIDES, sections)
    excess, directions = side_excess(corners, SIDES, ratios)
    tied = side_shear(excess, ratios)
    stiffness = np.zeros((len(corners), 24, 24))
    for xi, eta in GAUSS_POINTS:
        inverse, determinant = jacobian(corners, xi, eta)
        bent = _curvature(inverse, excess, directions, xi, eta)
        stiffness += quadratic(bent, bending * determinant[:, None, None])
        sheared = inverse @ _covariant_shear(corners, tied, xi, eta)
        stiffness += quadratic(sheared, (shear * determinant)[:, None, None] * np.eye(2))
    return stiffness


def central_curvature(corners: Array, sections: ShellSections) -> Array:
    """Curvatures (m, 3, 24) at the centre: strains at height z are z times these [1/m]."""
    excess, directions = side_excess(corners, SIDES, shear_ratios(corners, SIDES, sections))
    return _curvature(jacobian(corners, 0.0, 0.0)[0], excess, directions, 0.0, 0.0)


def _curvature(inverse: Array, excess: Array, directions: Array, xi: float, eta: float) -> Array:
    """Curvatures (m, 3, 24) x, y and twice xy at a point."""
    gradients = inverse @ shape_functions(xi, eta)[1]
    bubbles = inverse @ _bubble_derivatives(xi, eta)
    # Gradient (m, direction, component of beta, freedom).
    slope = np.zeros((len(inverse), 2, 2, 24))
    slope[:, :, 0, 4::6] = gradients
    slope[:, :, 1, 3::6] = -gradients
    slope += np.einsum("mdk,mkc,mkf->mdcf", bubbles, directions, excess, optimize=True)
    return np.stack([slope[:, 0, 0], slope[:, 1, 1], slope[:, 1, 0] + slope[:, 0, 1]], axis=1)


def _bubble_derivatives(xi: float, eta: float) -> Array:
    """Parent derivatives (2, 4) of the sides' bubbles, (1 - s^2) (1 + a r) / 2."""
    along = [xi, xi, eta, eta]
    to_it = [eta, eta, xi, xi]
    derivatives = np.empty((2, 4))
    for side, (s, r, a) in enumerate(zip(along, to_it, ACROSS, strict=True)):
        lengthwise, crosswise = -s * (1.0 + a * r), 0.5 * a * (1.0 - s * s)
        derivatives[:, side] = (lengthwise, crosswise) if side < 2 else (crosswise, lengthwise)
    return derivatives


def _covariant_shear(corners: Array, tied: Array, xi: float, eta: float) -> Array:
    """Shear strains (m, 2, 24) times the lengths of the parent's tangents, from the sides."""
    shear = np.zeros((len(corners), 2, 24))
    for side, ((i, j), a) in enumerate(zip(SIDES, ACROSS, strict=True)):
        half = 0.5 * np.linalg.norm(corners[:, j] - corners[:, i], axis=1)
        row, r = (0, eta) if side < 2 else (1, xi)
        shear[:, row] += (0.5 * (1.0 + a * r) * half)[:, None] * tied[:, side]
    return shear
