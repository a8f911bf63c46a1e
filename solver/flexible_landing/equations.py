"""Equations of motion of a flexible airframe on moving gears.

The rigid motion is nonlinear in all six freedoms, as in `solver.landing.equations`; the structure
adds its modal coordinates q in the mean-axis frame (`FlexibleAirframe`).  With P the air loads'
share, p_ij = w_i w_j the products of the rates, and the wrenches F_g that the gears give to their
fittings, Lagrange's equations of

    T = m v^2 / 2 + w . J(q) w / 2 + w . h + q' . q' / 2,   V = q . Omega^2 q / 2

are

    m a_O                       = m g + P_f                           + sum E_f' F_g
    J(q) w' + (B q) . q''       = P_m - J' w - q' . B q' - w x (J w + h) + sum E_m' F_g
    q'' + (B_k q) w_k'          = -Omega^2 q - D q' + L_ij p_ij - w_k (B_k - B_k') q' - p_ij C_ij q
                                  + P_q                               + sum Psi' T' F_g

with L the load of the rate products, B the Euler and C the centrifugal operators, and

    J_ii = J_0,ii + 2 L_ii . q - q . C_ii q,   J_ij = J_0,ij + L_ij . q - q . C_ij q / 2,
    h_k = q' . B_k q

(Lee et al., eq (15), with the inertia of the deformed body, so that momentum and energy are those
of one Lagrangian and are conserved).  `solver.flexible_landing.coupling` brings in the gears, with
the kernels of `solver.landing`.

State vector: that of `solver.landing.equations`, then the energy lost in the structure, the m modal
coordinates and their m velocities.
"""

from typing import NamedTuple

import numba
import numpy as np

from solver.arrays import Array
from solver.flexible_landing.coupling import finish_gears, fittings_and_gears, solve
from solver.flexible_landing.modal_record import Modes
from solver.landing.coupling import put
from solver.landing.equations import AIRFRAME_STATES, GEAR_STATES, WORK_STATES, body_to_earth
from solver.landing.lift import air_loads, lift_fraction
from solver.landing.records import Record, Records
from solver.landing.vectors import Vector, add, cross, dot, scaled, turned, vector


@numba.njit(cache=True)
def rate_products(rate: Vector) -> Array:
    """Products (6,) xx, yy, zz, xy, xz, yz of a vector's components."""
    x, y, z = rate
    return np.array([x * x, y * y, z * z, x * y, x * z, y * z])


class Turning(NamedTuple):
    """How the deformed airframe turns, at one instant; body axes."""

    inertia: Array  #: J(q) (3, 3)
    inertia_rate: Array  #: (3, 3)
    momentum: Array  #: h (3,) angular momentum of the elastic motion alone
    bias: Array  #: (3,) of its rate, what no second derivative multiplies
    coupling: Array  #: B q (3, m)
    gyroscopic: Array  #: (B - B') q' (3, m)
    centrifugal: Array  #: C q (6, m)


@numba.njit(cache=True)
def turning_airframe(airframe: Record, modes: Modes, q: Array, velocity: Array) -> Turning:
    """Inertia and angular momentum at modal coordinates ``q`` and their ``velocity``."""
    size = q.size
    on_q, gyroscopic = np.zeros(9 * size), np.zeros((3, size))
    momentum, bias = np.zeros(3), np.zeros(3)
    if modes.rates.shape[0] > 0:
        on_q[:] = modes.rates @ q
        for k in range(3):
            operator = modes.rates[k * size : (k + 1) * size]
            on_velocity = operator @ velocity
            gyroscopic[k] = on_velocity - velocity @ operator
            bias[k] = np.sum(velocity * on_velocity)
            momentum[k] = np.sum(velocity * on_q[k * size : (k + 1) * size])
    coupling = on_q[: 3 * size].reshape(3, size)
    centrifugal = on_q[3 * size :].reshape(6, size)
    linear, linear_rate = modes.products @ q, modes.products @ velocity
    square, square_rate = centrifugal @ q, centrifugal @ velocity
    inertia, inertia_rate = airframe.inertia.copy(), np.zeros((3, 3))
    for i in range(3):
        inertia[i, i] += 2.0 * linear[i] - square[i]
        inertia_rate[i, i] = 2.0 * (linear_rate[i] - square_rate[i])
    for pair, i, k in ((3, 0, 1), (4, 0, 2), (5, 1, 2)):
        change = linear[pair] - 0.5 * square[pair]
        growth = linear_rate[pair] - square_rate[pair]
        inertia[i, k] += change
        inertia[k, i] += change
        inertia_rate[i, k] = inertia_rate[k, i] = growth
    return Turning(inertia, inertia_rate, momentum, bias, coupling, gyroscopic, centrifugal)


@numba.njit(cache=True)
def air_wrenches(
    time: float, airframe: Record, course: Array, velocity: Vector, rate: Vector, below: Vector
) -> tuple[Array, Array, float, float]:
    """Wrenches (6,) of lift, and of drag and damping; the rigid motion's power of either [W]."""
    share = lift_fraction(time, course[0], course[1], course[2], course[3])
    point = vector(airframe.lift_point)
    point_velocity = add(velocity, cross(rate, point))
    lift, drag, damping = air_loads(
        airframe, share * airframe.total_mass * airframe.gravity, point_velocity, rate, below
    )
    lifting, braking = np.zeros(6), np.zeros(6)
    put(lifting[:3], lift)
    put(lifting[3:], cross(point, lift))
    put(braking[:3], drag)
    put(braking[3:], add(cross(point, drag), damping))
    lost = dot(drag, point_velocity) + dot(damping, rate)
    return lifting, braking, dot(lift, point_velocity), lost


@numba.njit(cache=True)
def evaluate(
    time: float,
    state: Array,
    airframe: Record,
    gears: Records,
    modes: Modes,
    course: Array,
    derivative: Array,
    answer: Record,
    gear_answers: Records,
) -> None:
    """Fill the state's derivative and everything that the equations know at this instant.

    Parameters are those of `solver.landing.equations.evaluate`; ``gears`` and ``modes`` come from
    `compiled_modes`.  The answers are in body axes, wrenches about the displaced pivots.
    """
    size = modes.stiffness.size
    loss = AIRFRAME_STATES + GEAR_STATES * gears.size + WORK_STATES
    q, q_rate = state[loss + 1 : loss + 1 + size], state[loss + 1 + size :]
    turn = body_to_earth(state)
    below = (turn[2, 0], turn[2, 1], turn[2, 2])
    rate = (state[10], state[11], state[12])
    velocity = turned(turn.T, (state[7], state[8], state[9]))
    gravity = scaled(airframe.gravity, below)
    products = rate_products(rate)
    turning = turning_airframe(airframe, modes, q, q_rate)
    lifting, braking, lift_power, lost_power = air_wrenches(
        time, airframe, course, velocity, rate, below
    )
    air = lifting + braking

    body, load = np.zeros((6, 6)), air.copy()
    body[3:, 3:] = turning.inertia
    momentum = add(turned(turning.inertia, rate), vector(turning.momentum))
    carried = add(turned(turning.inertia_rate, rate), cross(rate, momentum))
    for i in range(3):
        body[i, i] = airframe.mass
        load[i] += airframe.mass * gravity[i]
        load[3 + i] -= carried[i] + turning.bias[i]
    elastic = -modes.stiffness * q - modes.damping * q_rate
    elastic += products @ modes.products + air @ modes.air
    elastic -= np.array(rate) @ turning.gyroscopic + products @ turning.centrifugal

    fittings = fittings_and_gears(
        state,
        gears,
        modes,
        modes.fittings @ q,
        modes.fittings @ q_rate,
        velocity,
        rate,
        below,
        gravity,
        gear_answers,
    )
    accelerations, modal, moving = solve(body, load, turning.coupling, elastic, modes, fittings)
    finish_gears(state, gears, fittings, moving, gear_answers, derivative)
    acceleration, rate_derivative = vector(accelerations[:3]), vector(accelerations[3:])
    put(answer.acceleration, acceleration)
    put(answer.rate_derivative, rate_derivative)
    put(answer.gravity, gravity)
    put(answer.air_force, vector(air[:3]))
    put(answer.air_moment, vector(air[3:]))

    derivative[0:3] = state[7:10]
    w, x, y, z = state[3], state[4], state[5], state[6]
    derivative[3] = -0.5 * (x * rate[0] + y * rate[1] + z * rate[2])
    derivative[4] = 0.5 * (w * rate[0] + y * rate[2] - z * rate[1])
    derivative[5] = 0.5 * (w * rate[1] + z * rate[0] - x * rate[2])
    derivative[6] = 0.5 * (w * rate[2] + x * rate[1] - y * rate[0])
    put(derivative[7:10], turned(turn, acceleration))
    put(derivative[10:13], rate_derivative)
    # The air loads also work on the elastic motion.
    moved = modes.air @ q_rate
    work = derivative[loss - WORK_STATES : loss]
    work[0] = fittings.oil_power
    work[1] = fittings.tyre_power
    work[2] = fittings.other_power - lost_power - braking @ moved
    work[3] = lift_power + lifting @ moved
    derivative[loss] = np.sum(modes.damping * q_rate**2)
    derivative[loss + 1 : loss + 1 + size] = q_rate
    derivative[loss + 1 + size :] = modal
