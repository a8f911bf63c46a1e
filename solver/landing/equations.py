"""Equations of motion of a rigid airframe on moving gears, by Kane's method.

Unknown accelerations: the airframe's a_O and alpha (body axes), and per gear s'', theta'' and the
spin's derivative.  With j the direction e (axle) or, for a rigid leg, also f, the unsprung mass m_u
pulls along j only as the airframe carries it along; along d it hangs on the strut's force N and
along f on the swing spring T = -(k theta + c theta') / L.  Those are known, so that every gear's
own accelerations drop out exactly and 6 x 6 equations remain:

    (M + sum m_u j j^T + I_t P) [a_O; alpha] = loads - N d + T f + j . (F_g + m_u (g - b))

where M holds the airframe's mass and inertia, P takes the part of alpha across the axle and I_t is
the wheels' inertia about a diameter.  Spin adds the gyroscopic moment -omega x H.  Then

    a_0     = a_O + alpha x r + b,   F = F_g + m_u g
    s''     = d . a_0 - (d . F + N) / m_u
    theta'' = (f . a_0 - (f . F - T) / m_u) / L
    spin'   = e . alpha - e . M_g / I_w

Nothing is neglected: momentum and energy are conserved to rounding and integration error (tested).

State vector: earth position of the airframe's centre of gravity (3), attitude quaternion (4), its
earth velocity (3), body rate (3); per gear stroke, stroke rate, swing, swing rate, spin; at the end
the work of oil, tyres, everything else that dissipates, and lift.
"""

import numba
import numpy as np

from solver.arrays import Array
from solver.landing.coupling import add_force, add_leg, finish_leg, put, solve
from solver.landing.leg import leg_state, stored_energy
from solver.landing.lift import air_loads, lift_fraction
from solver.landing.records import Record, Records
from solver.landing.vectors import across, add, cross, dot, scaled, turned, vector

#: Length of the airframe's part of the state.
AIRFRAME_STATES = 13
#: Per gear.
GEAR_STATES = 5
#: Work integrals at the end: oil, tyres, other losses, lift.
WORK_STATES = 4

#: What one evaluation says about the airframe besides the derivative.
AIRFRAME_ANSWER = np.dtype(
    [
        ("acceleration", np.float64, 3),
        ("rate_derivative", np.float64, 3),
        ("gravity", np.float64, 3),
        ("air_force", np.float64, 3),
        ("air_moment", np.float64, 3),
        ("matrix", np.float64, (6, 6)),
        ("right_hand_side", np.float64, 6),
    ]
)


@numba.njit(cache=True)
def body_to_earth(state: Array) -> Array:
    """Rotation matrix (3, 3) of the state's quaternion, whose length need not be exactly one."""
    w, x, y, z = state[3], state[4], state[5], state[6]
    n = 1.0 / (w * w + x * x + y * y + z * z)
    turn = np.empty((3, 3))
    turn[0, 0] = (w * w + x * x - y * y - z * z) * n
    turn[0, 1] = 2 * (x * y - w * z) * n
    turn[0, 2] = 2 * (x * z + w * y) * n
    turn[1, 0] = 2 * (x * y + w * z) * n
    turn[1, 1] = (w * w - x * x + y * y - z * z) * n
    turn[1, 2] = 2 * (y * z - w * x) * n
    turn[2, 0] = 2 * (x * z - w * y) * n
    turn[2, 1] = 2 * (y * z + w * x) * n
    turn[2, 2] = (w * w - x * x - y * y + z * z) * n
    return turn


@numba.njit(cache=True)
def evaluate(
    time: float,
    state: Array,
    airframe: Record,
    gears: Records,
    course: Array,
    derivative: Array,
    answer: Record,
    gear_answers: Records,
) -> None:
    """Fill the state's derivative and everything that the equations know at this instant.

    Parameters
    ----------
    time : float
        After the first contact [s].
    state : (13 + 5 n_gears + 4,) array
    airframe : AIRFRAME_RECORD
    gears : (n_gears,) array of GEAR_RECORD
    course : (4,) array
        Lift: fraction, decay start [s], decay time [s], residual fraction.
    derivative : (13 + 5 n_gears + 4,) array
        Filled.
    answer : AIRFRAME_ANSWER
        Filled.
    gear_answers : (n_gears,) array of GEAR_ANSWER
        Filled.
    """
    turn = body_to_earth(state)
    below = (turn[2, 0], turn[2, 1], turn[2, 2])
    rate = (state[10], state[11], state[12])
    velocity = turned(turn.T, (state[7], state[8], state[9]))
    gravity = scaled(airframe.gravity, below)
    matrix, right = answer.matrix, answer.right_hand_side
    matrix[:, :] = 0.0
    right[:] = 0.0

    # Airframe with its own weight and the air loads.
    for i in range(3):
        matrix[i, i] = airframe.mass
        for k in range(3):
            matrix[3 + i, 3 + k] = airframe.inertia[i, k]
    weight = airframe.total_mass * airframe.gravity
    share = lift_fraction(time, course[0], course[1], course[2], course[3])
    point = vector(airframe.lift_point)
    point_velocity = add(velocity, cross(rate, point))
    lift, drag, damping = air_loads(airframe, share * weight, point_velocity, rate, below)
    air_force = add(lift, drag)
    air_moment = add(cross(point, air_force), damping)
    add_force(right, scaled(airframe.mass, gravity), (0.0, 0.0, 0.0))
    add_force(right, air_force, point)
    inertia_moment = cross(rate, turned(airframe.inertia, rate))
    for i in range(3):
        right[3 + i] += damping[i] - inertia_moment[i]

    oil_power, tyre_power = 0.0, 0.0
    other_power = -dot(drag, point_velocity) - dot(damping, rate)
    for index in range(gears.size):
        gear = gears[index]
        at = AIRFRAME_STATES + GEAR_STATES * index
        leg = leg_state(
            gear,
            state[at],
            state[at + 1],
            state[at + 2],
            state[at + 3],
            state[at + 4],
            velocity,
            rate,
            below,
            state[2],
        )
        add_leg(
            gear,
            leg,
            state[at + 2],
            state[at + 3],
            state[at + 4],
            rate,
            gravity,
            matrix,
            right,
            gear_answers[index],
        )
        oil_power += leg.hydraulic_power
        tyre_power += leg.tyre_power
        other_power += leg.other_power

    solve(matrix, right)
    acceleration = (right[0], right[1], right[2])
    rate_derivative = (right[3], right[4], right[5])
    put(answer.acceleration, acceleration)
    put(answer.rate_derivative, rate_derivative)
    put(answer.gravity, gravity)
    put(answer.air_force, air_force)
    put(answer.air_moment, air_moment)

    derivative[0:3] = state[7:10]
    w, x, y, z = state[3], state[4], state[5], state[6]
    derivative[3] = -0.5 * (x * rate[0] + y * rate[1] + z * rate[2])
    derivative[4] = 0.5 * (w * rate[0] + y * rate[2] - z * rate[1])
    derivative[5] = 0.5 * (w * rate[1] + z * rate[0] - x * rate[2])
    derivative[6] = 0.5 * (w * rate[2] + x * rate[1] - y * rate[0])
    put(derivative[7:10], turned(turn, acceleration))
    put(derivative[10:13], rate_derivative)
    for index in range(gears.size):
        at = AIRFRAME_STATES + GEAR_STATES * index
        finish_leg(
            gears[index],
            acceleration,
            rate_derivative,
            state[at + 1],
            state[at + 3],
            gear_answers[index],
            derivative[at : at + GEAR_STATES],
        )
    end = AIRFRAME_STATES + GEAR_STATES * gears.size
    derivative[end] = oil_power
    derivative[end + 1] = tyre_power
    derivative[end + 2] = other_power
    derivative[end + 3] = dot(lift, point_velocity)


@numba.njit(cache=True)
def energies(
    state: Array, airframe: Record, gears: Records, gear_answers: Records, result: Array
) -> None:
    """Fill (6,) energies at the instant just evaluated [J].

    Kinetic, gravitational (zero at the ground), gas, stops, swing springs, tyres.
    """
    rate = (state[10], state[11], state[12])
    result[:] = 0.0
    kinetic = 0.5 * airframe.mass * (state[7] ** 2 + state[8] ** 2 + state[9] ** 2)
    kinetic += 0.5 * dot(rate, turned(airframe.inertia, rate))
    turn = body_to_earth(state)
    below = (turn[2, 0], turn[2, 1], turn[2, 2])
    potential = -airframe.mass * airframe.gravity * state[2]
    for index in range(gears.size):
        gear, kept = gears[index], gear_answers[index]
        at = AIRFRAME_STATES + GEAR_STATES * index
        velocity, lateral = vector(kept.axle_velocity), vector(kept.lateral)
        skew_rate = across(rate, lateral)
        spin = dot(rate, lateral) - state[at + 4]
        kinetic += 0.5 * gear.unsprung_mass * dot(velocity, velocity)
        kinetic += 0.5 * gear.transverse_inertia * dot(skew_rate, skew_rate)
        kinetic += 0.5 * gear.spin_inertia * spin**2
        height = -(state[2] + dot(below, vector(kept.arm)))
        potential += gear.unsprung_mass * airframe.gravity * height
        gas, stops, swing, tyre = stored_energy(gear, state[at], state[at + 2], kept.deflection)
        result[2] += gas
        result[3] += stops
        result[4] += swing
        result[5] += tyre
    result[0] = kinetic
    result[1] = potential
