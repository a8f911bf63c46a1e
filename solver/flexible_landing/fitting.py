"""Motion of a gear's fitting on a deforming airframe, and what the gear gives back to it.

The fitting is a rigid body that follows its pins.  It is displaced by u = Psi_t q and turned by the
rotation vector theta = Psi_r q against the airframe's axes.  With R = exp(theta x) and T(theta) the
left tangent of the rotation, its motion relative to the airframe's axes is u', w_r = T theta' and

    w_r' = T theta'' + T' theta'

(J. Argyris, "An excursion into large rotations", 1982; here for small theta, but without neglect,
so that the work of the gear's moment is that done on the modes).  Seen from the fitting's own axes
the gear is the very gear of `solver.landing`: its kernels get the fitting's velocity, rate and
attitude in place of the airframe's.
"""

import numba
import numpy as np

from solver.arrays import Array
from solver.landing.coupling import put
from solver.landing.records import Record
from solver.landing.vectors import Vector, add, along, cross, dot, scaled, turned, vector

#: Unit vectors along the axes.
UNITS = np.eye(3)
#: Below this angle the coefficients of the rotation come from their series [rad].
_SERIES_LIMIT = 1e-2


@numba.njit(cache=True)
def rotation_coefficients(square: float) -> tuple[float, float, float]:
    """Coefficients sin a / a, (1 - cos a) / a^2 and (a - sin a) / a^3 at a^2 = ``square``."""
    if square < _SERIES_LIMIT**2:
        return (
            1.0 - square / 6.0 * (1.0 - square / 20.0),
            0.5 - square / 24.0 * (1.0 - square / 30.0),
            1.0 / 6.0 - square / 120.0 * (1.0 - square / 42.0),
        )
    angle = np.sqrt(square)
    return (
        np.sin(angle) / angle,
        (1.0 - np.cos(angle)) / square,
        (angle - np.sin(angle)) / (angle * square),
    )


@numba.njit(cache=True)
def put_rotation(theta: Vector, turn: Array, tangent: Array) -> None:
    """Fill the rotation matrix R (3, 3) and its left tangent T (3, 3)."""
    first, second, third = rotation_coefficients(dot(theta, theta))
    for k in range(3):
        unit = vector(UNITS[k])
        once = cross(theta, unit)
        twice = cross(theta, once)
        turn[0, k], turn[1, k], turn[2, k] = along(along(unit, first, once), second, twice)
        tangent[0, k], tangent[1, k], tangent[2, k] = along(along(unit, second, once), third, twice)


@numba.njit(cache=True)
def tangent_rate(theta: Vector, theta_rate: Vector) -> Vector:
    """T' theta', what of the relative angular acceleration no second derivative multiplies."""
    square = dot(theta, theta)
    first, second, third = rotation_coefficients(square)
    # Derivatives of the second and third coefficient by a^2, times the rate of a^2.
    if square < _SERIES_LIMIT**2:
        slope_2 = -1.0 / 24.0 + square / 360.0
        slope_3 = -1.0 / 120.0 + square / 2520.0
    else:
        slope_2 = (first - 2.0 * second) / (2.0 * square)
        slope_3 = (second - 3.0 * third) / (2.0 * square)
    growth = 2.0 * dot(theta, theta_rate)
    once = cross(theta, theta_rate)
    result = scaled(slope_2 * growth, once)
    result = along(result, slope_3 * growth, cross(theta, once))
    return along(result, third, cross(theta_rate, once))


@numba.njit(cache=True)
def turn_rows(turn: Array, block: Array) -> None:
    """Turn the columns of a block (3, k) in place."""
    for k in range(block.shape[1]):
        column = turned(turn, (block[0, k], block[1, k], block[2, k]))
        block[0, k], block[1, k], block[2, k] = column


@numba.njit(cache=True)
def turn_columns(turn: Array, block: Array) -> None:
    """Turn the rows of a block (k, 3) in place."""
    for k in range(block.shape[0]):
        put(block[k], turned(turn, vector(block[k])))


@numba.njit(cache=True)
def turn_gear_equations(turn: Array, bias: Array, matrix: Array, right: Array) -> None:
    """Turn a gear's equations from the fitting's axes into the airframe's, less their bias.

    ``matrix`` (6, 6) and ``right`` (6,) say that the gear gives the fitting, which accelerates by y
    in its own axes, the wrench ``right - matrix y``; with y = R' (y_b + bias) the result is that of
    y_b in the airframe's axes.
    """
    for first in (0, 3):
        turn_rows(turn, matrix[first : first + 3])
        turn_columns(turn, matrix[:, first : first + 3])
        put(right[first : first + 3], turned(turn, vector(right[first : first + 3])))
    for i in range(6):
        for k in range(6):
            right[i] -= matrix[i, k] * bias[k]


@numba.njit(cache=True)
def put_body_axes(answer: Record, turn: Array, pivot: Vector) -> None:
    """Turn a gear's answer from the fitting's axes about the pivot into body axes."""
    put(answer.arm, add(pivot, turned(turn, vector(answer.arm))))
    put(answer.down, turned(turn, vector(answer.down)))
    put(answer.forward, turned(turn, vector(answer.forward)))
    put(answer.lateral, turned(turn, vector(answer.lateral)))
    put(answer.ground_force, turned(turn, vector(answer.ground_force)))
    put(answer.ground_moment, turned(turn, vector(answer.ground_moment)))
    put(answer.axle_velocity, turned(turn, vector(answer.axle_velocity)))
    put(answer.force, turned(turn, vector(answer.force)))
    put(answer.moment, turned(turn, vector(answer.moment)))
