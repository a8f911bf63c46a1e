"""The flexible equations of motion driven directly, from any state."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.flexible_landing.energy import ENERGIES
from solver.flexible_landing.equations import evaluate, turning_airframe
from solver.flexible_landing.fitting import put_rotation
from solver.flexible_landing.integrate import integrate
from solver.flexible_landing.modal_record import Modes, compiled_modes
from solver.flexible_landing.modes import FlexibleAirframe
from solver.flexible_landing.simulate import flexible_state_scale
from solver.frames import rotation_matrix
from solver.landing.aircraft import LandingAircraft
from solver.landing.coupling import GEAR_ANSWER
from solver.landing.equations import AIRFRAME_ANSWER, AIRFRAME_STATES, GEAR_STATES
from solver.landing.records import GEAR_RECORD, Record, Records, airframe_record, gear_record

Course = tuple[float, float, float, float]
NO_LIFT: Course = (0.0, np.inf, 1.0, 0.0)


@dataclass(frozen=True)
class Body:
    """Everything the compiled equations read."""

    airframe: Record
    gears: Records  #: about the airframe's centre of gravity
    local: Records  #: about their pivots
    modes: Modes
    flexible: FlexibleAirframe

    @property
    def first(self) -> int:
        """Index of the first modal coordinate in a state."""
        return AIRFRAME_STATES + GEAR_STATES * len(self.gears) + 5


@dataclass(frozen=True)
class Flight:
    """Integrated states with what the equations say about them."""

    body: Body
    states: Array
    answers: Records
    gear_answers: Records
    stored: Array


def body_of(
    aircraft: LandingAircraft, flexible: FlexibleAirframe, gravity: float | None = None
) -> Body:
    airframe = airframe_record(aircraft)
    if gravity is not None:
        airframe["gravity"] = gravity
    gears = np.array(
        [gear_record(gear, aircraft.centre_of_gravity) for gear in aircraft.gears],
        dtype=GEAR_RECORD,
    )
    modes, local = compiled_modes(flexible, gears)
    return Body(airframe, gears, local, modes, flexible)


def fly(
    body: Body,
    state: Array,
    duration: float,
    tolerance: float = 1e-9,
    course: Course = NO_LIFT,
    interval: float = 1e-3,
) -> Flight:
    rows = round(duration / interval) + 1
    states = np.zeros((rows, len(state)))
    states[0] = state
    answers = np.zeros(rows, dtype=AIRFRAME_ANSWER)
    gear_answers = np.zeros((rows, len(body.gears)), dtype=GEAR_ANSWER)
    stored = np.zeros((rows, ENERGIES))
    scale = flexible_state_scale(len(body.gears), body.flexible.circular_frequency)
    good, _, _ = integrate(
        0.0, interval, states, interval / 10, scale, tolerance,
        body.airframe, body.local, body.modes, np.array(course), answers, gear_answers, stored,
    )  # fmt: skip
    assert good == rows
    return Flight(body, states, answers, gear_answers, stored)


def evaluated(body: Body, state: Array, course: Course = NO_LIFT) -> tuple[Array, Record, Records]:
    derivative = np.zeros_like(state)
    answer = np.zeros(1, dtype=AIRFRAME_ANSWER)
    gear_answers = np.zeros(len(body.gears), dtype=GEAR_ANSWER)
    evaluate(
        0.0, state, body.airframe, body.local, body.modes, np.array(course), derivative,
        answer[0], gear_answers,
    )  # fmt: skip
    return derivative, answer[0], gear_answers


def moving_state(body: Body, seed: int, height: float) -> Array:
    """A state in which everything moves: airframe, structure, legs, wheels."""
    generator = np.random.default_rng(seed)
    size = body.flexible.size
    state = np.zeros(body.first + 2 * size)
    state[2] = -height
    attitude = np.array([1.0, 0.0, 0.0, 0.0]) + 0.2 * generator.standard_normal(4)
    state[3:7] = attitude / np.linalg.norm(attitude)
    state[7:10] = [50.0, 1.0, 2.0]
    state[10:13] = generator.uniform(-0.5, 0.5, 3)
    for index in range(len(body.gears)):
        at = AIRFRAME_STATES + GEAR_STATES * index
        state[at] = generator.uniform(0.05, 0.25)
        state[at + 1] = generator.uniform(-1.0, 1.0)
        state[at + 2] = generator.uniform(-0.03, 0.03)
        state[at + 3] = generator.uniform(-2.0, 2.0)
        state[at + 4] = generator.uniform(-50.0, 200.0)
    # Decimetres at the slowest modes, each with the same energy: some 3 kJ in all.
    speed = 60.0 / np.sqrt(size)
    state[body.first : body.first + size] = (
        speed * generator.standard_normal(size) / body.flexible.circular_frequency
    )
    state[body.first + size :] = speed * generator.standard_normal(size)
    return state


def momenta(flight: Flight, row: int) -> tuple[Array, Array]:
    """Linear and angular momentum about the earth's origin, from the states, by definition."""
    body, state = flight.body, flight.states[row]
    size = body.flexible.size
    q = state[body.first : body.first + size].copy()
    q_rate = state[body.first + size :].copy()
    turn, rate = rotation_matrix(state[3:7]), state[10:13]
    turning = turning_airframe(body.airframe, body.modes, q, q_rate)
    linear = body.airframe["mass"] * state[7:10]
    angular = np.cross(state[0:3], linear) + turn @ (turning.inertia @ rate + turning.momentum)
    for index, gear in enumerate(body.gears):
        answer = flight.gear_answers[row, index]
        place = state[0:3] + turn @ answer["arm"]
        push = gear["unsprung_mass"] * (turn @ answer["axle_velocity"])
        rotation, tangent = np.zeros((3, 3)), np.zeros((3, 3))
        fitting = body.flexible.fittings[index, 3:]
        put_rotation(tuple(fitting @ q), rotation, tangent)
        leg_rate = rate + tangent @ (fitting @ q_rate)
        axle = answer["lateral"]
        spin = state[AIRFRAME_STATES + GEAR_STATES * index + 4]
        along = (leg_rate @ axle) * axle
        wheel = gear["transverse_inertia"] * (leg_rate - along)
        wheel = wheel + gear["spin_inertia"] * (along - spin * axle)
        linear = linear + push
        angular = angular + np.cross(place, push) + turn @ wheel
    return linear, angular
