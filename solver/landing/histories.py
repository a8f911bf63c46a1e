"""From the integrated states to the histories, contacts and the energy account of a landing."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.frames import body_structural, rotation_matrix
from solver.gear.parameters import Gear
from solver.gear.pins import pin_load_matrix
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.equations import AIRFRAME_STATES, GEAR_STATES
from solver.landing.history import (
    EnergyAccount,
    GearHistory,
    GroundContact,
    LandingHistory,
    Outcome,
)
from solver.landing.peaks import refined_peak
from solver.landing.records import GRAVITY, Records


@dataclass(frozen=True, slots=True)
class Run:
    """An integrated landing, one row per instant."""

    time: Array  #: (nt,) [s]
    states: Array  #: (nt, n_states)
    answers: Records  #: (nt,) of AIRFRAME_ANSWER
    gear_answers: Records  #: (nt, n_gears) of GEAR_ANSWER
    stored: Array  #: (nt, 6) energies
    evaluations: int  #: of the equations of motion
    outcome: Outcome


def landing_history(aircraft: LandingAircraft, contact: Contact, run: Run) -> LandingHistory:
    """Put the integrated landing into the form that the other rooms read."""
    attitude = run.states[:, 3:7]
    turn = rotation_matrix(attitude)
    velocity = np.einsum("tji,tj->ti", turn, run.states[:, 7:10])
    rate = run.states[:, 10:13]
    acceleration = run.answers["acceleration"].copy()
    rate_derivative = run.answers["rate_derivative"].copy()
    gravity = run.answers["gravity"].copy()

    arm = body_structural(aircraft.total_centre_of_gravity - aircraft.centre_of_gravity)
    specific = acceleration - gravity + np.cross(rate_derivative, arm)
    specific = specific + np.cross(rate, np.cross(rate, arm))
    gears = tuple(
        _gear_history(gear, index, run, turn) for index, gear in enumerate(aircraft.gears)
    )
    return LandingHistory(
        time=run.time,
        origin=np.asarray(aircraft.centre_of_gravity, dtype=np.float64),
        position=run.states[:, 0:3].copy(),
        attitude=attitude.copy(),
        velocity=velocity,
        acceleration=acceleration,
        gravity=gravity,
        rate=rate.copy(),
        rate_derivative=rate_derivative,
        normal_load_factor=-specific[:, 2] / GRAVITY,
        air_wrench=np.concatenate([run.answers["air_force"], run.answers["air_moment"]], axis=1),
        gears=gears,
        contacts=_contacts(run, gears, turn),
        energy=_energy_account(aircraft, contact, run),
        outcome=run.outcome,
    )


def _gear_history(gear: Gear, index: int, run: Run, turn: Array) -> GearHistory:
    answers = run.gear_answers[:, index]
    at = AIRFRAME_STATES + GEAR_STATES * index
    wrench = np.concatenate([answers["force"], answers["moment"]], axis=1)
    pin_loads = np.zeros((len(run.time), len(gear.pins), 6))
    if gear.pins:
        matrix = pin_load_matrix(gear.pins, gear.pivot)
        structural = body_structural(wrench.reshape(-1, 2, 3)).reshape(-1, 6)
        loads = (structural @ matrix.T).reshape(len(run.time), -1, 2, 3)
        pin_loads = body_structural(loads).reshape(len(run.time), -1, 6)
    return GearHistory(
        name=gear.name,
        reference_point=np.asarray(gear.pivot, dtype=np.float64),
        strut_force=answers["strut_force"].copy(),
        ground_force=np.einsum("tij,tj->ti", turn, answers["ground_force"]),
        stroke=run.states[:, at].copy(),
        stroke_rate=run.states[:, at + 1].copy(),
        tyre_deflection=np.maximum(answers["deflection"], 0.0),
        wheel_speed=run.states[:, at + 4].copy(),
        bending_angle=run.states[:, at + 2].copy(),
        wrench=wrench,
        pin_positions=np.array([pin.position for pin in gear.pins]).reshape(-1, 3),
        pin_loads=pin_loads,
    )


def _contacts(run: Run, gears: tuple[GearHistory, ...], turn: Array) -> tuple[GroundContact, ...]:
    """Every stay of every gear on the ground, in order of time."""
    contacts: list[GroundContact] = []
    for index, gear in enumerate(gears):
        answers = run.gear_answers[:, index]
        down_speed = np.einsum("ti,ti->t", turn[:, 2, :], answers["axle_velocity"])
        for first, last, start, end in _stays(run.time, answers["deflection"]):
            stay = slice(first, last + 1)
            time = run.time[stay]
            peak_time, peak = refined_peak(time, answers["normal"][stay])
            contacts.append(
                GroundContact(
                    gear=gear.name,
                    start=start,
                    end=end,
                    peak_ground_force=peak,
                    peak_time=peak_time,
                    peak_strut_force=refined_peak(time, gear.strut_force[stay])[1],
                    peak_stroke=refined_peak(time, gear.stroke[stay])[1],
                    closure_speed=float(np.interp(start, run.time, down_speed)),
                )
            )
    return tuple(sorted(contacts, key=lambda contact: contact.start))


def _stays(time: Array, deflection: Array) -> list[tuple[int, int, float, float | None]]:
    """First and last sample, start and end of every time with positive deflection."""
    touches = deflection > 0
    # The first tyre touches at time zero, its deflection is zero there and grows at once.
    if len(touches) > 1 and touches[1] and deflection[0] > -1e-9:
        touches[0] = True
    changes = np.flatnonzero(np.diff(touches.astype(np.int8)))
    starts = [int(change) + 1 for change in changes if touches[change + 1]]
    ends = [int(change) for change in changes if touches[change]]
    if touches[0]:
        starts.insert(0, 0)
    stays = []
    for number, first in enumerate(starts):
        start = float(time[0]) if first == 0 else _crossing(time, deflection, first - 1)
        last, end = len(time) - 1, None
        if number < len(ends):
            last = ends[number]
            end = _crossing(time, deflection, last)
        stays.append((first, last, start, end))
    return stays


def _crossing(time: Array, values: Array, before: int) -> float:
    """Time at which the line from sample ``before`` to the next one crosses zero."""
    low, high = values[before], values[before + 1]
    return float(time[before] + (time[before + 1] - time[before]) * low / (low - high))


def _energy_account(aircraft: LandingAircraft, contact: Contact, run: Run) -> EnergyAccount:
    kinetic, potential, gas, stops, swing, tyre = (column.copy() for column in run.stored.T)
    end = run.states.shape[1] - 4
    oil, rubber, other, lift = (run.states[:, end + i].copy() for i in range(4))
    total = kinetic + potential + gas + stops + swing + tyre + oil + rubber + other - lift
    impact = 0.5 * aircraft.total_mass * contact.sink_rate**2
    return EnergyAccount(
        kinetic=kinetic,
        potential=potential,
        gas=gas,
        tyre=tyre,
        strut_bending=swing,
        stops=stops,
        dissipated_hydraulic=oil,
        dissipated_tyre=rubber,
        dissipated_other=other,
        lift_work=lift,
        impact_energy=impact,
        closure_error=float(np.max(np.abs(total - total[0])) / impact),
    )
