"""How moving fittings enter the equations of a flexible airframe, and leave them again.

Every gear gives its fitting the wrench F = r - M y, with y the fitting's acceleration.  Modes enter
only through the fittings, so that their accelerations can be put in by hand: with E and N the
fittings' accelerations to the rigid ones [a_O, alpha] and to wrenches on all fittings, and c what
no unknown multiplies,

    y = E [a_O, alpha] + N F + c,   (1 + M N) F + M E [a_O, alpha] = r - M c

which with the airframe's own six equations makes 6 + 6 n_gears, whatever the number of modes.
"""

from typing import NamedTuple

import numba
import numpy as np

from solver.arrays import Array
from solver.flexible_landing.fitting import (
    UNITS,
    put_body_axes,
    put_rotation,
    tangent_rate,
    turn_columns,
    turn_gear_equations,
    turn_rows,
)
from solver.flexible_landing.modal_record import Modes
from solver.landing.coupling import add_leg, finish_leg, put
from solver.landing.equations import AIRFRAME_STATES, GEAR_STATES
from solver.landing.leg import leg_state
from solver.landing.records import Records
from solver.landing.vectors import Vector, add, cross, dot, scaled, turned, vector


class Fittings(NamedTuple):
    """All fittings at one instant, body axes; n gears."""

    pivots: Array  #: (n, 3) displaced, from the centre of gravity [m]
    turns: Array  #: (n, 3, 3) rotation from the fitting's axes
    tangents: Array  #: (n, 3, 3) tangent of the rotation
    rigid: Array  #: (6 n, 6) accelerations to those of the centre of gravity
    bias: Array  #: (6 n,) accelerations that no second derivative multiplies
    mass: Array  #: (6 n, 6 n) M, block by block
    push: Array  #: (6 n,) r less M times the bias
    oil_power: float  #: lost [W]
    tyre_power: float
    other_power: float


@numba.njit(cache=True)
def fittings_and_gears(
    state: Array,
    gears: Records,
    modes: Modes,
    places: Array,
    speeds: Array,
    velocity: Vector,
    rate: Vector,
    below: Vector,
    gravity: Vector,
    gear_answers: Records,
) -> Fittings:
    """Move all fittings, evaluate the gears on them, keep what `finish_gears` needs.

    Parameters
    ----------
    places, speeds : (6 n,) arrays
        Displacement and rotation of the fittings against the airframe's axes, and their rates.
    velocity, rate, below, gravity : Vector
        Of the airframe's axes, in them.
    """
    count = gears.size
    pivots = np.zeros((count, 3))
    turns, tangents = np.zeros((count, 3, 3)), np.zeros((count, 3, 3))
    rigid, bias = np.zeros((6 * count, 6)), np.zeros(6 * count)
    mass, push = np.zeros((6 * count, 6 * count)), np.zeros(6 * count)
    oil_power, tyre_power, other_power = 0.0, 0.0, 0.0
    for index in range(count):
        first, at = 6 * index, AIRFRAME_STATES + GEAR_STATES * index
        middle, last = first + 3, first + 6
        theta, theta_rate = vector(places[middle:last]), vector(speeds[middle:last])
        put_rotation(theta, turns[index], tangents[index])
        back = turns[index].T
        pivot = add(vector(modes.pivots[index]), vector(places[first:middle]))
        put(pivots[index], pivot)
        slip = vector(speeds[first:middle])
        own_rate = turned(tangents[index], theta_rate)
        leg_rate = turned(back, add(rate, own_rate))
        carried = add(cross(rate, cross(rate, pivot)), scaled(2.0, cross(rate, slip)))
        put(bias[first:middle], carried)
        put(bias[middle:last], add(tangent_rate(theta, theta_rate), cross(rate, own_rate)))
        for i in range(3):
            rigid[first + i, i] = rigid[middle + i, 3 + i] = 1.0
            arm = cross(vector(UNITS[i]), pivot)
            for k in range(3):
                rigid[first + k, 3 + i] = arm[k]
        leg = leg_state(
            gears[index],
            state[at],
            state[at + 1],
            state[at + 2],
            state[at + 3],
            state[at + 4],
            turned(back, add(add(velocity, cross(rate, pivot)), slip)),
            leg_rate,
            turned(back, below),
            state[2] + dot(below, pivot),
        )
        matrix, right = mass[first:last, first:last], push[first:last]
        add_leg(
            gears[index],
            leg,
            state[at + 2],
            state[at + 3],
            state[at + 4],
            leg_rate,
            turned(back, gravity),
            matrix,
            right,
            gear_answers[index],
        )
        turn_gear_equations(turns[index], bias[first:last], matrix, right)
        oil_power += leg.hydraulic_power
        tyre_power += leg.tyre_power
        other_power += leg.other_power
    return Fittings(
        pivots, turns, tangents, rigid, bias, mass, push, oil_power, tyre_power, other_power
    )


@numba.njit(cache=True)
def solve(
    body: Array, load: Array, coupling: Array, elastic: Array, modes: Modes, fittings: Fittings
) -> tuple[Array, Array, Array]:
    """Rigid and modal accelerations and those of the fittings.

    Parameters
    ----------
    body : (6, 6) array
        Inertia of the deformed airframe about its centre of gravity.
    load : (6,) array
        On it, gears left out.
    coupling : (3, m) array
        Angular momentum of unit modal velocities.
    elastic : (m,) array
        Modal accelerations that the loads alone would give.

    Returns
    -------
    (6,), (m,), (6 n,) arrays
    """
    count, size = 6 * fittings.turns.shape[0], elastic.size
    own = modes.fittings @ elastic
    rigid, mobility = fittings.rigid.copy(), modes.mobility.copy()
    matrix, right = np.zeros((6 + count, 6 + count)), np.zeros(6 + count)
    for k in range(3):
        for j in range(size):
            right[3 + k] -= coupling[k, j] * elastic[j]
            for i in range(3):
                matrix[3 + i, 3 + k] -= coupling[i, j] * coupling[k, j]
    # What the fittings do by themselves turns them at T theta', not at theta'.
    own_rigid = np.zeros((count, 3))
    for i in range(count):
        for j in range(size):
            for k in range(3):
                own_rigid[i, k] -= modes.fittings[i, j] * coupling[k, j]
    for first in range(3, count, 6):
        tangent = fittings.tangents[first // 6]
        put(own[first : first + 3], turned(tangent, vector(own[first : first + 3])))
        turn_rows(tangent, own_rigid[first : first + 3])
        turn_rows(tangent, mobility[first : first + 3])
        turn_columns(tangent, mobility[:, first : first + 3])
    for i in range(count):
        for k in range(3):
            rigid[i, 3 + k] += own_rigid[i, k]
    for i in range(6):
        right[i] += load[i]
        for k in range(6):
            matrix[i, k] += body[i, k]
        for k in range(count):
            matrix[i, 6 + k] = -rigid[k, i]
    for i in range(count):
        right[6 + i] = fittings.push[i]
        matrix[6 + i, 6 + i] = 1.0
        block = 6 * (i // 6)
        for j in range(block, block + 6):
            share = fittings.mass[i, j]
            right[6 + i] -= share * own[j]
            for k in range(6):
                matrix[6 + i, k] += share * rigid[j, k]
            for k in range(count):
                matrix[6 + i, 6 + k] += share * mobility[j, k]
    eliminate(matrix, right)
    moving = own + fittings.bias
    for i in range(count):
        for k in range(6):
            moving[i] += rigid[i, k] * right[k]
        for k in range(count):
            moving[i] += mobility[i, k] * right[6 + k]
    wrenches = right[6:].copy()
    for first in range(3, count, 6):
        back = fittings.tangents[first // 6].T
        put(wrenches[first : first + 3], turned(back, vector(wrenches[first : first + 3])))
    modal = elastic + wrenches @ modes.fittings
    for k in range(3):
        modal -= right[3 + k] * coupling[k]
    return right[:6].copy(), modal, moving


@numba.njit(cache=True)
def eliminate(matrix: Array, right: Array) -> None:
    """Solve a small system in place by Gaussian elimination with partial pivoting."""
    size = right.size
    for k in range(size):
        pivot = k
        for i in range(k + 1, size):
            if abs(matrix[i, k]) > abs(matrix[pivot, k]):
                pivot = i
        for j in range(k, size):
            matrix[k, j], matrix[pivot, j] = matrix[pivot, j], matrix[k, j]
        right[k], right[pivot] = right[pivot], right[k]
        for i in range(k + 1, size):
            factor = matrix[i, k] / matrix[k, k]
            right[i] -= factor * right[k]
            for j in range(k + 1, size):
                matrix[i, j] -= factor * matrix[k, j]
    for i in range(size - 1, -1, -1):
        for j in range(i + 1, size):
            right[i] -= matrix[i, j] * right[j]
        right[i] /= matrix[i, i]


@numba.njit(cache=True)
def finish_gears(
    state: Array,
    gears: Records,
    fittings: Fittings,
    moving: Array,
    gear_answers: Records,
    derivative: Array,
) -> None:
    """Fill the gears' derivatives and their answers in body axes, about the displaced pivots."""
    for index in range(gears.size):
        at, first = AIRFRAME_STATES + GEAR_STATES * index, 6 * index
        back = fittings.turns[index].T
        finish_leg(
            gears[index],
            turned(back, vector(moving[first : first + 3])),
            turned(back, vector(moving[first + 3 : first + 6])),
            state[at + 1],
            state[at + 3],
            gear_answers[index],
            derivative[at : at + GEAR_STATES],
        )
        put_body_axes(gear_answers[index], fittings.turns[index], vector(fittings.pivots[index]))
