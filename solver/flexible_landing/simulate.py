"""One landing of a flexible airframe that moves with its gears and is moved by them."""

from dataclasses import dataclass, replace

import numpy as np

from solver.arrays import Array
from solver.errors import RecordError, SimulationDivergedError
from solver.flexible_landing.energy import ENERGIES
from solver.flexible_landing.initial import flexible_initial_state
from solver.flexible_landing.integrate import integrate
from solver.flexible_landing.modal_record import compiled_modes
from solver.flexible_landing.modes import FlexibleAirframe
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.coupling import GEAR_ANSWER
from solver.landing.equations import AIRFRAME_ANSWER
from solver.landing.histories import Run, landing_history
from solver.landing.history import LandingHistory, Outcome
from solver.landing.initial import check_contact
from solver.landing.lift import lift_course
from solver.landing.records import GEAR_RECORD, Records, airframe_record, gear_record
from solver.landing.simulate import SimulationOptions, state_scale

#: Size of a modal velocity at which the tolerance is an absolute one [kg^1/2 m/s].
_MODAL_SPEED = 1.0


@dataclass(frozen=True, slots=True)
class FlexibleLanding:
    """A landing and the elastic motion in it; nt instants, m modes.

    ``history`` is that of the mean-axis frame.  Its gear forces act on the deformed airframe, its
    energy account lacks the two figures that stand here, and its closure error has them.
    """

    history: LandingHistory
    coordinates: Array  #: (m, nt) modal [kg^1/2 m]
    velocities: Array  #: (m, nt)
    elastic_energy: Array  #: (nt,) [J]
    structural_loss: Array  #: (nt,) lost in the structure's damping [J]
    evaluations: int  #: of the equations of motion


def simulate_flexible_landing(
    aircraft: LandingAircraft,
    flexible: FlexibleAirframe,
    contact: Contact,
    options: SimulationOptions | None = None,
) -> FlexibleLanding:
    """Simulate one landing with two-way coupling, up to the time limit of the options.

    Parameters
    ----------
    aircraft : LandingAircraft
        The airframe's rigid body, its gears and its air loads.
    flexible : FlexibleAirframe
        Modes of the same airframe at the same loading.

    Raises
    ------
    RecordError
        The contact or its lift is outside what a landing can be.
    SimulationDivergedError
        The motion leaves the finite numbers or its energy account does not close.
    """
    options = options or SimulationOptions()
    check_contact(contact)
    if contact.nose_wheel_down:
        raise RecordError("a flexible landing begins with its first contact, no nose wheel down")
    course = lift_course(contact.lift)
    lift = np.array(
        [course.fraction, course.decay_start, course.decay_time, course.residual_fraction]
    )
    airframe = airframe_record(aircraft)
    gears: Records = np.array(
        [gear_record(gear, aircraft.centre_of_gravity) for gear in aircraft.gears],
        dtype=GEAR_RECORD,
    )
    modes, local = compiled_modes(flexible, gears)
    state = flexible_initial_state(contact, airframe, gears, modes, local, lift)
    interval = options.output_interval
    rows = round(options.time_limit / interval) + 1
    states, stored = np.zeros((rows, len(state))), np.zeros((rows, ENERGIES))
    states[0] = state
    answers = np.zeros(rows, dtype=AIRFRAME_ANSWER)
    gear_answers: Records = np.zeros((rows, len(gears)), dtype=GEAR_ANSWER)
    good, step, evaluations = integrate(
        0.0,
        interval,
        states,
        interval / 10,
        flexible_state_scale(len(gears), flexible.circular_frequency),
        options.tolerance,
        airframe,
        local,
        modes,
        lift,
        answers,
        gear_answers,
        stored,
    )
    if good < rows or not np.all(np.isfinite(states)):
        raise SimulationDivergedError(
            f"the motion diverged {good * interval:.4f} s after the contact, step {step:.3g} s"
        )
    size = flexible.size
    first = len(state) - 2 * size
    run = Run(
        time=interval * np.arange(rows, dtype=np.float64),
        states=states[:, : first - 1],
        answers=answers,
        gear_answers=gear_answers,
        stored=stored[:, :6],
        evaluations=evaluations,
        outcome=Outcome.TIME_LIMIT,
    )
    history = landing_history(aircraft, contact, run)
    elastic, loss = stored[:, 6].copy(), states[:, first - 1].copy()
    account = history.energy
    total = account.kinetic + account.potential + account.gas + account.tyre + account.strut_bending
    total = total + account.stops + account.dissipated_hydraulic + account.dissipated_tyre
    total = total + account.dissipated_other - account.lift_work + elastic + loss
    error = float(np.max(np.abs(total - total[0])) / account.impact_energy)
    if not error <= options.energy_bound:
        raise SimulationDivergedError(
            f"the energy account is off by {error:.3g} of the impact energy "
            f"{account.impact_energy:.4g} J, bound {options.energy_bound:g}"
        )
    return FlexibleLanding(
        history=replace(history, energy=replace(account, closure_error=error)),
        coordinates=np.ascontiguousarray(states[:, first : first + size].T),
        velocities=np.ascontiguousarray(states[:, first + size :].T),
        elastic_energy=elastic,
        structural_loss=loss,
        evaluations=evaluations,
    )


def flexible_state_scale(gear_count: int, circular_frequency: Array) -> Array:
    """Size of each state below which the integration's tolerance is an absolute one."""
    size = len(circular_frequency)
    return np.concatenate(
        [
            state_scale(gear_count),
            [1.0e4],
            _MODAL_SPEED / circular_frequency,
            np.full(size, _MODAL_SPEED),
        ]
    )
