"""Bilinear interpolation on quadrilaterals: shape functions, Jacobian, integration points."""

import numpy as np

from solver.arrays import Array

#: Corners in the parent square.
CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
GAUSS_POINTS = CORNERS / np.sqrt(3.0)


def shape_functions(xi: float, eta: float) -> tuple[Array, Array]:
    """Bilinear shape functions (4,) and their parent derivatives (2, 4)."""
    a, b = CORNERS[:, 0], CORNERS[:, 1]
    values = 0.25 * (1.0 + a * xi) * (1.0 + b * eta)
    derivatives = 0.25 * np.stack([a * (1.0 + b * eta), b * (1.0 + a * xi)])
    return values, derivatives


def jacobian(corners: Array, xi: float, eta: float) -> tuple[Array, Array]:
    """Inverse (m, 2, 2) and determinant (m,) of the Jacobian, rows d/dxi, d/deta of (x, y).

    ``corners`` (m, 4, 2) lie in the element's plane [m].
    """
    matrix = shape_functions(xi, eta)[1] @ corners
    adjugate = np.empty_like(matrix)
    adjugate[:, 0, 0], adjugate[:, 1, 1] = matrix[:, 1, 1], matrix[:, 0, 0]
    adjugate[:, 0, 1], adjugate[:, 1, 0] = -matrix[:, 0, 1], -matrix[:, 1, 0]
    determinant: Array = np.linalg.det(matrix)
    inverse: Array = adjugate / determinant[:, None, None]
    return inverse, determinant


def quadratic(operator: Array, weight: Array) -> Array:
    """B^T D B of operators B (m, k, n) and weights D (m, k, k)."""
    product: Array = np.swapaxes(operator, 1, 2) @ (weight @ operator)
    return product
