"""The state at the first instant: the first tyre just touches, the gears hang in equilibrium.

Gears that were on the ground before are closed by what the touching one leaves to them.
"""

from functools import partial

import numpy as np

from solver.arrays import Array
from solver.errors import RecordError, SimulationDivergedError
from solver.frames import quaternion_from_euler, rotation_matrix
from solver.landing.contact import Contact
from solver.landing.coupling import GEAR_ANSWER
from solver.landing.equations import (
    AIRFRAME_ANSWER,
    AIRFRAME_STATES,
    GEAR_STATES,
    WORK_STATES,
    evaluate,
)
from solver.landing.grounded import Evaluation, stand_on_grounded
from solver.landing.lift import angle_of_attack
from solver.landing.records import Record, Records

#: What a contact may be.  Wider than any aircraft's envelope: beyond these the record is wrong.
RANGES = {
    "sink_rate": (0.01, 15.0),
    "ground_speed": (5.0, 150.0),
    "pitch": (-0.6, 0.6),
    "roll": (-0.6, 0.6),
    "drift": (-0.6, 0.6),
    "pitch_rate": (-2.0, 2.0),
    "roll_rate": (-2.0, 2.0),
    "yaw_rate": (-2.0, 2.0),
}

#: Height at which the hanging gears are brought to rest, clear of the ground [m].
_CLEAR = 100.0

#: Acceleration of a gear that is at rest [m/s2, rad/s2].
_REST = 1e-7


def check_contact(contact: Contact) -> None:
    """Refuse a contact that no landing can have.

    Raises
    ------
    RecordError
        Names field, value and range.
    """
    for name, (low, high) in RANGES.items():
        value = getattr(contact, name)
        if not low <= value <= high:
            raise RecordError(f"contact {name} {value:g} is outside {low:g} to {high:g}")


def initial_state(
    contact: Contact,
    airframe: Record,
    gears: Records,
    course: Array,
    wheel_speeds: Array | None = None,
    down: tuple[int, ...] = (),
) -> Array:
    """State vector at the first ground contact.

    Each strut rests on its extension stop, and each leg on its swing spring, under the weight of
    its unsprung mass in the aircraft's initial acceleration, so that nothing rings before the
    ground does.

    Parameters
    ----------
    contact : Contact
        Motion of the WHOLE aircraft's centre of gravity.
    airframe, gears, course
        As for `solver.landing.equations.evaluate`; the airframe's angle of attack at the contact
        is filled in here, and what the gears that are down carry is taken off the lift.
    wheel_speeds : (n_gears,) array, optional
        At which the wheels turn already, forward positive [rad/s]; at rest by default.
    down : tuple of int, optional
        Gears that are on the ground already, rolling; the first tyre of the others touches.

    Returns
    -------
    (13 + 5 n_gears + 4,) array

    Raises
    ------
    SimulationDivergedError
        The gears find no rest.
    """
    state = np.zeros(AIRFRAME_STATES + GEAR_STATES * len(gears) + WORK_STATES)
    state[2] = -_CLEAR
    state[3:7] = quaternion_from_euler(contact.roll, contact.pitch, contact.drift)
    rate = np.array([contact.roll_rate, contact.pitch_rate, contact.yaw_rate])
    turn = rotation_matrix(state[3:7])
    state[7:10] = [contact.ground_speed, 0.0, contact.sink_rate]
    state[7:10] -= turn @ np.cross(rate, airframe["centre_of_gravity"])
    state[10:13] = rate
    if wheel_speeds is not None:
        end = AIRFRAME_STATES + GEAR_STATES * len(gears)
        state[AIRFRAME_STATES + 4 : end : GEAR_STATES] = wheel_speeds
    point_velocity = turn.T @ state[7:10] + np.cross(rate, airframe["lift_point"])
    airframe["contact_angle_of_attack"] = angle_of_attack(tuple(point_velocity))
    evaluation = partial(_evaluated, airframe=airframe, gears=gears, course=course)
    _hang(state, airframe, gears, evaluation)
    touching = [index for index in range(len(gears)) if index not in down]
    # The deflection of a tyre grows with the depth one to one.
    state[2] = -_CLEAR - np.max(evaluation(state)[2]["deflection"][touching])
    if down:
        weight = airframe["total_mass"] * airframe["gravity"]
        fraction, hanging = course[0], state.copy()
        # Lift decays: it is not less than what it tends to.
        least = min(fraction, course[3]) if np.isfinite(course[1]) else 0.0
        # The lift that is left changes how the struts fall with the aircraft, by little.
        for _ in range(2):
            state[:] = hanging
            stand_on_grounded(state, down, gears, evaluation, (fraction - least) * weight)
            _bring_to_rest(state, gears, evaluation)
            carried = evaluation(state)[2]["normal"].sum()
            course[0] = fraction - carried / weight
    return state


def _evaluated(
    state: Array, airframe: Record, gears: Records, course: Array
) -> tuple[Array, Record, Records]:
    derivative = np.zeros_like(state)
    answers = np.zeros(1, dtype=AIRFRAME_ANSWER)
    gear_answers: Records = np.zeros(len(gears), dtype=GEAR_ANSWER)
    evaluate(0.0, state, airframe, gears, course, derivative, answers[0], gear_answers)
    return derivative, answers[0], gear_answers


def _hang(state: Array, airframe: Record, gears: Records, evaluation: Evaluation) -> None:
    """Guess where the gears hang and bring them to rest there."""
    for index, gear in enumerate(gears):
        preload = gear["pneumatic_area"] * gear["initial_gas_pressure"]
        hanging = gear["unsprung_mass"] * airframe["gravity"]
        state[AIRFRAME_STATES + GEAR_STATES * index] = -(preload + hanging) / gear["stop_stiffness"]
    _bring_to_rest(state, gears, evaluation)


def _bring_to_rest(state: Array, gears: Records, evaluation: Evaluation) -> None:
    """Newton's method on stroke and swing until the gears' own accelerations vanish."""
    free = []
    for index, gear in enumerate(gears):
        at = AIRFRAME_STATES + GEAR_STATES * index
        free += [at, at + 2] if gear["swings"] else [at]
    unknowns = np.array(free)
    for _ in range(20):
        residual = evaluation(state)[0][unknowns + 1]
        if np.max(np.abs(residual)) < _REST:
            return
        slope = np.empty((len(unknowns), len(unknowns)))
        for column, unknown in enumerate(unknowns):
            moved = state.copy()
            moved[unknown] += 1e-7
            slope[:, column] = evaluation(moved)[0][unknowns + 1]
        state[unknowns] -= np.linalg.solve((slope - residual[:, None]) / 1e-7, residual)
    raise SimulationDivergedError(
        f"the gears find no rest before the contact, accelerations {residual} left"
    )
