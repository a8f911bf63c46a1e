"""Energy of a flexible airframe on its gears, at an instant that has just been evaluated."""

import numba
import numpy as np

from solver.arrays import Array
from solver.flexible_landing.equations import turning_airframe
from solver.flexible_landing.fitting import put_rotation
from solver.flexible_landing.modal_record import Modes
from solver.landing.equations import AIRFRAME_STATES, GEAR_STATES, WORK_STATES, body_to_earth
from solver.landing.leg import stored_energy
from solver.landing.records import Record, Records
from solver.landing.vectors import across, add, dot, turned, vector

#: Kinetic, gravitational, gas, stops, swing springs, tyres, as in the rigid landing; then elastic.
ENERGIES = 7


@numba.njit(cache=True)
def energies(
    state: Array,
    airframe: Record,
    gears: Records,
    modes: Modes,
    gear_answers: Records,
    result: Array,
) -> None:
    """Fill (7,) energies [J]; see `ENERGIES`."""
    count, size = gears.size, modes.stiffness.size
    first = AIRFRAME_STATES + GEAR_STATES * count + WORK_STATES + 1
    q, velocity = state[first : first + size], state[first + size :]
    rate = (state[10], state[11], state[12])
    result[:] = 0.0
    turning = turning_airframe(airframe, modes, q, velocity)
    kinetic = 0.5 * airframe.mass * (state[7] ** 2 + state[8] ** 2 + state[9] ** 2)
    kinetic += 0.5 * dot(rate, turned(turning.inertia, rate)) + dot(rate, vector(turning.momentum))
    kinetic += 0.5 * np.sum(velocity**2)
    turn = body_to_earth(state)
    below = (turn[2, 0], turn[2, 1], turn[2, 2])
    potential = -airframe.mass * airframe.gravity * state[2]
    places, rates = modes.fittings @ q, modes.fittings @ velocity
    fitting_turn, tangent = np.zeros((3, 3)), np.zeros((3, 3))
    for index in range(count):
        gear, kept = gears[index], gear_answers[index]
        at = AIRFRAME_STATES + GEAR_STATES * index
        angular = slice(6 * index + 3, 6 * index + 6)
        put_rotation(vector(places[angular]), fitting_turn, tangent)
        leg_rate = add(rate, turned(tangent, vector(rates[angular])))
        axle_velocity, lateral = vector(kept.axle_velocity), vector(kept.lateral)
        skew_rate = across(leg_rate, lateral)
        spin = dot(leg_rate, lateral) - state[at + 4]
        kinetic += 0.5 * gear.unsprung_mass * dot(axle_velocity, axle_velocity)
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
    result[6] = 0.5 * np.sum(modes.stiffness * q**2)
