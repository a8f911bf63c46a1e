"""One landing: from the first contact until the aircraft rolls, or a stated limit."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from solver.arrays import Array
from solver.errors import RecordError, SimulationDivergedError
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.coupling import GEAR_ANSWER
from solver.landing.equations import (
    AIRFRAME_ANSWER,
    AIRFRAME_STATES,
    GEAR_STATES,
)
from solver.landing.histories import Run, landing_history
from solver.landing.history import LandingHistory, Outcome
from solver.landing.initial import check_contact, initial_state
from solver.landing.integrate import integrate
from solver.landing.lift import LiftCourse, lift_course, lift_fraction
from solver.landing.records import GEAR_RECORD, GRAVITY, Records, airframe_record, gear_record


@dataclass(frozen=True, slots=True)
class SimulationOptions:
    """How long and how finely a landing is followed.

    A landing has settled into rolling when over `settling_window` every tyre stays on the ground,
    the vertical speed and the strokes' rates stay below `settled_speed` and roll and pitch rate
    below `settled_rate`; and when every gear has its peak load behind it and the ground has carried
    at least the load that the final lift will leave to it, or the lift has come within
    `settled_lift` of the weight of its final value.
    """

    output_interval: float = 1e-3  #: grid of the histories [s]
    time_limit: float = 4.0  #: [s]
    tolerance: float = 1e-6  #: of a step of integration, relative to each state's size
    settling_window: float = 0.15  #: [s]
    settled_speed: float = 0.15  #: [m/s]
    settled_rate: float = 0.05  #: [rad/s]
    settled_lift: float = 0.05  #: of the weight
    stop_when_settled: bool = True  #: False: always run to the limit
    energy_bound: float = 2e-3  #: largest admissible energy error over the impact energy

    def __post_init__(self) -> None:
        if not 1e-5 <= self.output_interval <= 0.01:
            raise RecordError(f"output_interval {self.output_interval:g} s is outside 1e-5 to 0.01")
        if not self.output_interval <= self.time_limit <= 60.0:
            raise RecordError(f"time_limit {self.time_limit:g} s is outside one interval to 60 s")
        if not 1e-12 <= self.tolerance <= 1e-3:
            raise RecordError(f"tolerance {self.tolerance:g} is outside 1e-12 to 1e-3")


#: Time between two looks at whether the motion has settled [s].
_LOOK = 0.05


def simulate_landing(
    aircraft: LandingAircraft,
    contact: Contact,
    options: SimulationOptions | None = None,
    wheel_speeds: Array | None = None,
) -> LandingHistory:
    """Simulate one landing.

    Parameters
    ----------
    aircraft : LandingAircraft
    contact : Contact
        State of the whole aircraft's centre of gravity at the first ground contact, and the lift.
    options : SimulationOptions, optional
    wheel_speeds : (n_gears,) array, optional
        At which the wheels turn already, forward positive [rad/s]; at rest by default.

    Returns
    -------
    LandingHistory

    Raises
    ------
    RecordError
        The contact or its lift is outside what a landing can be.
    SimulationDivergedError
        The motion leaves the finite numbers or its energy account does not close.
    """
    options = options or SimulationOptions()
    check_contact(contact)
    course = lift_course(contact.lift)
    run = _integrated(aircraft, contact, course, options, wheel_speeds)
    history = landing_history(aircraft, contact, run)
    error = history.energy.closure_error
    if not error <= options.energy_bound:
        raise SimulationDivergedError(
            f"the energy account is off by {error:.3g} of the impact energy "
            f"{history.energy.impact_energy:.4g} J, bound {options.energy_bound:g}"
        )
    return history


class _Rows(NamedTuple):
    """Arrays with one row per instant of the grid."""

    states: Array
    answers: Records
    gear_answers: Records
    stored: Array


def _integrated(
    aircraft: LandingAircraft,
    contact: Contact,
    course: LiftCourse,
    options: SimulationOptions,
    wheel_speeds: Array | None,
) -> Run:
    airframe = airframe_record(aircraft)
    gears: Records = np.array(
        [gear_record(gear, aircraft.centre_of_gravity) for gear in aircraft.gears],
        dtype=GEAR_RECORD,
    )
    lift = np.array(
        [course.fraction, course.decay_start, course.decay_time, course.residual_fraction]
    )
    down = aircraft.nose_gears if contact.nose_wheel_down else ()
    state = initial_state(contact, airframe, gears, lift, wheel_speeds, down)
    course = replace(course, fraction=float(lift[0]))
    scale = state_scale(len(gears))

    interval = options.output_interval
    rows = round(options.time_limit / interval) + 1
    chunk = max(1, round(_LOOK / interval))
    kept = _Rows(
        np.zeros((rows, len(state))),
        np.zeros(rows, dtype=AIRFRAME_ANSWER),
        np.zeros((rows, len(gears)), dtype=GEAR_ANSWER),
        np.zeros((rows, 6)),
    )
    kept.states[0] = state
    step = interval / 10
    evaluations = 0
    outcome = Outcome.TIME_LIMIT
    first = 0
    while first < rows - 1:
        last = min(first + chunk, rows - 1)
        part = slice(first, last + 1)
        good, step, count = integrate(
            first * interval,
            interval,
            kept.states[part],
            step,
            scale,
            options.tolerance,
            airframe,
            gears,
            lift,
            kept.answers[part],
            kept.gear_answers[part],
            kept.stored[part],
        )
        evaluations += count
        if good < last + 1 - first or not np.all(np.isfinite(kept.states[last])):
            raise SimulationDivergedError(
                f"the motion diverged {(first + good) * interval:.4f} s after the contact, "
                f"step {step:.3g} s"
            )
        first = last
        if options.stop_when_settled and _is_settled(kept, last + 1, aircraft, course, options):
            outcome = Outcome.SETTLED
            break
    end = first + 1
    return Run(
        time=interval * np.arange(end, dtype=np.float64),
        states=kept.states[:end],
        answers=kept.answers[:end],
        gear_answers=kept.gear_answers[:end],
        stored=kept.stored[:end],
        evaluations=evaluations,
        outcome=outcome,
    )


def state_scale(gear_count: int) -> Array:
    """Size of each state below which the integration's tolerance is an absolute one.

    The speed over ground and the place along the runway are large and smooth; the others must be
    right to a small part of the motion of the gears (millimetres, centimetres per second).
    """
    airframe = [1.0] * 3 + [0.1] * 4 + [1.0] * 3 + [0.1] * 3
    gear = [0.01, 1.0, 0.01, 1.0, 10.0]
    return np.array(airframe + gear * gear_count + [1.0e4] * 4)


def _is_settled(
    kept: _Rows,
    rows: int,
    aircraft: LandingAircraft,
    course: LiftCourse,
    options: SimulationOptions,
) -> bool:
    """Whether the aircraft rolls; see `SimulationOptions`."""
    interval = options.output_interval
    window = slice(max(0, rows - round(options.settling_window / interval) - 1), rows)
    if rows * interval < 2 * options.settling_window:
        return False
    normal = kept.gear_answers["normal"][:rows]
    states = kept.states[window]
    strokes = AIRFRAME_STATES + 1 + GEAR_STATES * np.arange(len(aircraft.gears))
    is_rolling = (
        bool(np.all(normal[window] > 0))
        and bool(np.all(np.abs(states[:, 9]) < options.settled_speed))
        and bool(np.all(np.abs(states[:, 10:12]) < options.settled_rate))
        and bool(np.all(np.abs(states[:, strokes]) < options.settled_speed))
    )
    if not is_rolling:
        return False
    lift = lift_fraction(
        (rows - 1) * interval,
        course.fraction,
        course.decay_start,
        course.decay_time,
        course.residual_fraction,
    )
    if abs(lift - course.final_fraction) < options.settled_lift:
        return True
    weight = aircraft.total_mass * GRAVITY
    has_peaked = bool(np.all(np.argmax(normal, axis=0) < window.start))
    return has_peaked and float(np.max(normal.sum(axis=1))) >= weight * (1 - course.final_fraction)
