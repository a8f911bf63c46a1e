"""How a gear enters the airframe's six equations, and leaves them again (see `equations`)."""

import numba
import numpy as np

from solver.arrays import Array
from solver.landing.leg import Leg
from solver.landing.records import Record
from solver.landing.vectors import Vector, across, add, along, cross, dot, scaled, vector

#: What one evaluation says about a gear; the first block is kept between its two passes.
GEAR_ANSWER = np.dtype(
    [
        ("length", np.float64),
        ("down", np.float64, 3),
        ("forward", np.float64, 3),
        ("lateral", np.float64, 3),
        ("arm", np.float64, 3),
        ("bias", np.float64, 3),
        ("load", np.float64, 3),
        ("ground_moment", np.float64, 3),
        ("gyroscopic_moment", np.float64, 3),
        ("push", np.float64),
        ("swing_force", np.float64),
        ("strut_force", np.float64),
        ("deflection", np.float64),
        ("normal", np.float64),
        ("ground_force", np.float64, 3),  # body axes
        ("axle_velocity", np.float64, 3),  # body axes
        ("force", np.float64, 3),  # of the gear on the airframe, body axes
        ("moment", np.float64, 3),  # the same, about the pivot
    ]
)


@numba.njit(cache=True)
def put(target: Array, value: Vector) -> None:
    """Write a vector into an array."""
    target[0], target[1], target[2] = value


@numba.njit(cache=True)
def add_carried_mass(
    matrix: Array, right: Array, mass: float, direction: Vector, arm: Vector, pull: float
) -> None:
    """Add a mass that the airframe carries along one direction only, and the load on it there."""
    turn = cross(arm, direction)
    row = (direction[0], direction[1], direction[2], turn[0], turn[1], turn[2])
    for i in range(6):
        right[i] += row[i] * pull
        for k in range(6):
            matrix[i, k] += mass * row[i] * row[k]


@numba.njit(cache=True)
def add_force(right: Array, force: Vector, arm: Vector) -> None:
    """Add a force that acts at ``arm``."""
    turn = cross(arm, force)
    for i in range(3):
        right[i] += force[i]
        right[3 + i] += turn[i]


@numba.njit(cache=True)
def solve(matrix: Array, right: Array) -> None:
    """Solve the symmetric positive definite 6 x 6 system in place (Cholesky)."""
    for j in range(6):
        for k in range(j):
            matrix[j, j] -= matrix[j, k] ** 2
        matrix[j, j] = np.sqrt(matrix[j, j])
        for i in range(j + 1, 6):
            for k in range(j):
                matrix[i, j] -= matrix[i, k] * matrix[j, k]
            matrix[i, j] /= matrix[j, j]
    for i in range(6):
        for k in range(i):
            right[i] -= matrix[i, k] * right[k]
        right[i] /= matrix[i, i]
    for i in range(5, -1, -1):
        for k in range(i + 1, 6):
            right[i] -= matrix[k, i] * right[k]
        right[i] /= matrix[i, i]


@numba.njit(cache=True)
def add_leg(
    gear: Record,
    leg: Leg,
    swing: float,
    swing_rate: float,
    spin: float,
    rate: Vector,
    gravity: Vector,
    matrix: Array,
    right: Array,
    kept: Record,
) -> None:
    """Add one gear to the 6 x 6 equations and keep what the second pass needs."""
    mass = gear.unsprung_mass
    load = along(leg.ground_force, mass, gravity)
    pull = along(load, -mass, leg.bias)
    # The stroke's share of the swing spring's energy pushes along the strut.
    push = leg.strut_force + 0.5 * leg.swing_slope * swing**2
    swing_force = 0.0
    add_force(right, scaled(-push, leg.down), leg.arm)
    add_carried_mass(matrix, right, mass, leg.lateral, leg.arm, dot(leg.lateral, pull))
    if gear.swings:
        swing_force = -(leg.swing_stiffness * swing + leg.swing_damping * swing_rate) / leg.length
        add_force(right, scaled(swing_force, leg.forward), leg.arm)
    else:
        add_carried_mass(matrix, right, mass, leg.forward, leg.arm, dot(leg.forward, pull))

    # Wheels: only the part across the axle reaches the leg, the rest spins them.
    momentum = scaled(gear.transverse_inertia, across(rate, leg.lateral))
    momentum = along(momentum, gear.spin_inertia * (dot(rate, leg.lateral) - spin), leg.lateral)
    gyroscopic = scaled(-1.0, cross(rate, momentum))
    carried = across(leg.ground_moment, leg.lateral)
    for i in range(3):
        right[3 + i] += carried[i] + gyroscopic[i]
        matrix[3 + i, 3 + i] += gear.transverse_inertia
        for k in range(3):
            matrix[3 + i, 3 + k] -= gear.transverse_inertia * leg.lateral[i] * leg.lateral[k]

    kept.length = leg.length
    put(kept.down, leg.down)
    put(kept.forward, leg.forward)
    put(kept.lateral, leg.lateral)
    put(kept.arm, leg.arm)
    put(kept.bias, leg.bias)
    put(kept.load, load)
    put(kept.ground_moment, leg.ground_moment)
    put(kept.gyroscopic_moment, gyroscopic)
    kept.push = push
    kept.swing_force = swing_force
    kept.strut_force = leg.strut_force
    kept.deflection = leg.deflection
    kept.normal = leg.normal
    put(kept.ground_force, leg.ground_force)
    put(kept.axle_velocity, leg.velocity)


@numba.njit(cache=True)
def finish_leg(
    gear: Record,
    acceleration: Vector,
    rate_derivative: Vector,
    stroke_rate: float,
    swing_rate: float,
    kept: Record,
    derivative: Array,
) -> None:
    """Accelerations of one gear, and its wrench on the airframe about the pivot."""
    mass = gear.unsprung_mass
    down, forward, lateral = vector(kept.down), vector(kept.forward), vector(kept.lateral)
    arm, load = vector(kept.arm), vector(kept.load)
    moment = vector(kept.ground_moment)
    carried = add(add(acceleration, cross(rate_derivative, arm)), vector(kept.bias))
    derivative[0] = stroke_rate
    derivative[1] = dot(down, carried) - (dot(down, load) + kept.push) / mass
    derivative[2] = swing_rate
    derivative[3] = 0.0
    sideways = dot(lateral, load) - mass * dot(lateral, carried)
    if gear.swings:
        ahead = kept.swing_force
        derivative[3] = (dot(forward, carried) - (dot(forward, load) - ahead) / mass) / kept.length
    else:
        ahead = dot(forward, load) - mass * dot(forward, carried)
    derivative[4] = dot(lateral, rate_derivative) - dot(lateral, moment) / gear.spin_inertia

    force = along(along(scaled(-kept.push, down), ahead, forward), sideways, lateral)
    turning = add(across(moment, lateral), vector(kept.gyroscopic_moment))
    turning = along(turning, -gear.transverse_inertia, across(rate_derivative, lateral))
    lever = along(arm, -1.0, vector(gear.pivot))
    put(kept.force, force)
    put(kept.moment, add(cross(lever, force), turning))
