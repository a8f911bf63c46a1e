"""The equations of motion driven directly: any state, with or without gravity and ground."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.landing.aircraft import LandingAircraft
from solver.landing.coupling import GEAR_ANSWER
from solver.landing.equations import AIRFRAME_ANSWER, AIRFRAME_STATES, GEAR_STATES
from solver.landing.integrate import integrate
from solver.landing.records import (
    GEAR_RECORD,
    Record,
    Records,
    airframe_record,
    gear_record,
)
from solver.landing.simulate import state_scale


@dataclass(frozen=True)
class Flight:
    """Integrated states with what the equations say about them."""

    airframe: Record
    gears: Records
    time: Array
    states: Array
    answers: Records
    gear_answers: Records
    stored: Array


def records(aircraft: LandingAircraft, gravity: float | None = None) -> tuple[Record, Records]:
    airframe = airframe_record(aircraft)
    if gravity is not None:
        airframe["gravity"] = gravity
    gears = [gear_record(gear, aircraft.centre_of_gravity) for gear in aircraft.gears]
    return airframe, np.array(gears, dtype=GEAR_RECORD)


def fly(
    airframe: Record,
    gears: Records,
    state: Array,
    duration: float,
    tolerance: float = 1e-10,
    course: tuple[float, float, float, float] = (0.0, np.inf, 1.0, 0.0),
    interval: float = 1e-3,
) -> Flight:
    rows = round(duration / interval) + 1
    states = np.zeros((rows, len(state)))
    states[0] = state
    answers = np.zeros(rows, dtype=AIRFRAME_ANSWER)
    gear_answers = np.zeros((rows, len(gears)), dtype=GEAR_ANSWER)
    stored = np.zeros((rows, 6))
    good, _, _ = integrate(
        0.0, interval, states, interval / 10, state_scale(len(gears)), tolerance,
        airframe, gears, np.array(course), answers, gear_answers, stored,
    )  # fmt: skip
    assert good == rows
    time = interval * np.arange(rows)
    return Flight(airframe, gears, time, states, answers, gear_answers, stored)


def moving_state(gears: Records, seed: int, height: float) -> Array:
    """A state in which everything moves: tumbling airframe, swinging legs, spinning wheels."""
    generator = np.random.default_rng(seed)
    state = np.zeros(AIRFRAME_STATES + GEAR_STATES * len(gears) + 4)
    state[2] = -height
    attitude = np.array([1.0, 0.0, 0.0, 0.0]) + 0.2 * generator.standard_normal(4)
    state[3:7] = attitude / np.linalg.norm(attitude)
    state[7:10] = [50.0, 1.0, 2.0]
    state[10:13] = generator.uniform(-0.5, 0.5, 3)
    for index in range(len(gears)):
        at = AIRFRAME_STATES + GEAR_STATES * index
        state[at] = generator.uniform(0.05, 0.25)
        state[at + 1] = generator.uniform(-1.0, 1.0)
        state[at + 2] = generator.uniform(-0.03, 0.03)
        state[at + 3] = generator.uniform(-2.0, 2.0)
        state[at + 4] = generator.uniform(-50.0, 200.0)
    return state
