"""Vectors of three as tuples: what the compiled equations calculate with, free of allocation."""

from typing import TypeAlias

import numba

from solver.arrays import Array

Vector: TypeAlias = tuple[float, float, float]


@numba.njit(cache=True)
def vector(values: Array) -> Vector:
    """Take the three entries of an array."""
    return values[0], values[1], values[2]


@numba.njit(cache=True)
def dot(a: Vector, b: Vector) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@numba.njit(cache=True)
def cross(a: Vector, b: Vector) -> Vector:
    """Vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@numba.njit(cache=True)
def add(a: Vector, b: Vector) -> Vector:
    """Sum."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@numba.njit(cache=True)
def scaled(factor: float, a: Vector) -> Vector:
    """Multiple."""
    return factor * a[0], factor * a[1], factor * a[2]


@numba.njit(cache=True)
def along(a: Vector, factor: float, b: Vector) -> Vector:
    """Sum ``a + factor b``."""
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


@numba.njit(cache=True)
def across(a: Vector, direction: Vector) -> Vector:
    """Part of ``a`` at right angles to the unit vector ``direction``."""
    return along(a, -dot(a, direction), direction)


@numba.njit(cache=True)
def turned(matrix: Array, a: Vector) -> Vector:
    """Matrix (3, 3) times vector."""
    return (
        matrix[0, 0] * a[0] + matrix[0, 1] * a[1] + matrix[0, 2] * a[2],
        matrix[1, 0] * a[0] + matrix[1, 1] * a[1] + matrix[1, 2] * a[2],
        matrix[2, 0] * a[0] + matrix[2, 1] * a[1] + matrix[2, 2] * a[2],
    )
