"""Finite rotations of nodes: quaternions in the state, matrices in the kernels.

A step turns a node by the Cayley map of its increment p, an axis vector in inertial components:
``R1 = cay(p) R0``, cay(p) being the unit quaternion (1, p/2) / |(1, p/2)|.  Then
``R1 - R0 = p x (R0 + R1)/2`` holds without error, and p has the same body components before and
after; both are what makes the midpoint rule keep momentum (J. C. Simo, K. K. Wong, Unconditionally
stable algorithms for rigid body dynamics that exactly preserve energy and momentum, Int. J. Num.
Meth. Eng. 31, 1991, 19-52).
"""

import numba
import numpy as np

from solver.arrays import Array


def cayley_quaternions(increments: Array) -> Array:
    """Give unit quaternions (n, 4) of the Cayley turns by ``increments`` (n, 3) [-]."""
    quaternions = np.concatenate([np.ones((len(increments), 1)), 0.5 * increments], axis=1)
    unit: Array = quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)
    return unit


def half_turns(quaternions: Array) -> Array:
    """Give unit quaternions (n, 4) of half the turn of each of ``quaternions`` (n, 4)."""
    halves = quaternions.copy()
    halves[:, 0] += 1.0
    unit: Array = halves / np.linalg.norm(halves, axis=1, keepdims=True)
    return unit


def exponential_quaternions(vectors: Array) -> Array:
    """Give unit quaternions (n, 4) of the turns by rotation vectors (n, 3) [rad]."""
    half = 0.5 * np.linalg.norm(vectors, axis=1, keepdims=True)
    # sin(h) / (2 h), also where h is zero
    return np.concatenate([np.cos(half), 0.5 * np.sinc(half / np.pi) * vectors], axis=1)


def composed(second: Array, first: Array) -> Array:
    """Give unit quaternions (n, 4) of the turn ``first`` followed by ``second``."""
    a, b = second[..., 0], first[..., 0]
    u, v = second[..., 1:], first[..., 1:]
    scalar = a * b - np.sum(u * v, axis=-1)
    vector = a[..., None] * v + b[..., None] * u + np.cross(u, v)
    product = np.concatenate([scalar[..., None], vector], axis=-1)
    unit: Array = product / np.linalg.norm(product, axis=-1, keepdims=True)
    return unit


@numba.njit(cache=True, error_model="numpy")
def rotation_vector(matrix: Array, out: Array) -> None:
    """Rotation vector [rad] of a rotation matrix (3, 3), for turns well below pi."""
    x = 0.5 * (matrix[2, 1] - matrix[1, 2])
    y = 0.5 * (matrix[0, 2] - matrix[2, 0])
    z = 0.5 * (matrix[1, 0] - matrix[0, 1])
    sine = np.sqrt(x * x + y * y + z * z)
    cosine = 0.5 * (matrix[0, 0] + matrix[1, 1] + matrix[2, 2] - 1.0)
    if cosine > 0.0 and sine < 1e-3:
        square = sine * sine
        factor = 1.0 + square / 6.0 + 0.075 * square * square  # arcsine over sine
    else:
        factor = np.arctan2(sine, cosine) / sine
    out[0], out[1], out[2] = factor * x, factor * y, factor * z


@numba.njit(cache=True, error_model="numpy")
def moment_of_rotation_vector(vector: Array, moment: Array, out: Array) -> None:
    """Moment [N m] that does the work of ``moment``, conjugate to a rotation ``vector`` (3,).

    The transposed inverse of the tangent map, ``m + v x m / 2 + c v x (v x m)`` with
    ``c = (1 - h cot h) / (4 h^2)``, h half the angle (B. Nour-Omid, C. C. Rankin, Finite rotation
    analysis and consistent linearization using projectors, Comp. Meth. Appl. Mech. Eng. 93, 1991,
    353-384).
    """
    a0 = vector[1] * moment[2] - vector[2] * moment[1]
    a1 = vector[2] * moment[0] - vector[0] * moment[2]
    a2 = vector[0] * moment[1] - vector[1] * moment[0]
    square = 0.25 * (vector[0] ** 2 + vector[1] ** 2 + vector[2] ** 2)
    if square < 1e-3:
        factor = 1.0 / 12.0 + square / 180.0 + square * square * (2.0 / 3780.0)
    else:
        half = np.sqrt(square)
        factor = (1.0 - half / np.tan(half)) / (4.0 * square)
    out[0] = moment[0] + 0.5 * a0 + factor * (vector[1] * a2 - vector[2] * a1)
    out[1] = moment[1] + 0.5 * a1 + factor * (vector[2] * a0 - vector[0] * a2)
    out[2] = moment[2] + 0.5 * a2 + factor * (vector[0] * a1 - vector[1] * a0)


@numba.njit(cache=True, error_model="numpy")
def solved(matrix: Array, right: Array, out: Array) -> None:
    """Solution of three linear equations (Cramer)."""
    a, b, c = matrix[0, 0], matrix[0, 1], matrix[0, 2]
    d, e, f = matrix[1, 0], matrix[1, 1], matrix[1, 2]
    g, h, i = matrix[2, 0], matrix[2, 1], matrix[2, 2]
    determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    x, y, z = right[0], right[1], right[2]
    out[0] = (x * (e * i - f * h) - b * (y * i - f * z) + c * (y * h - e * z)) / determinant
    out[1] = (a * (y * i - f * z) - x * (d * i - f * g) + c * (d * z - y * g)) / determinant
    out[2] = (a * (e * z - y * h) - b * (d * z - y * g) + x * (d * h - e * g)) / determinant


@numba.njit(cache=True, error_model="numpy")
def turn_further(vector: Array, matrix: Array) -> None:
    """Turn the columns of ``matrix`` (3, 3) by a rotation vector [rad], in place."""
    square = vector[0] ** 2 + vector[1] ** 2 + vector[2] ** 2
    angle = np.sqrt(square)
    if square < 1e-8:
        first, second = 1.0 - square / 6.0, 0.5 - square / 24.0
    else:
        first, second = np.sin(angle) / angle, (1.0 - np.cos(angle)) / square
    for j in range(3):
        x, y, z = matrix[0, j], matrix[1, j], matrix[2, j]
        a0 = vector[1] * z - vector[2] * y
        a1 = vector[2] * x - vector[0] * z
        a2 = vector[0] * y - vector[1] * x
        matrix[0, j] += first * a0 + second * (vector[1] * a2 - vector[2] * a1)
        matrix[1, j] += first * a1 + second * (vector[2] * a0 - vector[0] * a2)
        matrix[2, j] += first * a2 + second * (vector[0] * a1 - vector[1] * a0)
