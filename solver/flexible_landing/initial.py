"""The state at the first instant: steady flight shape, hanging gears, the first tyre touching."""

import numpy as np

from solver.arrays import Array
from solver.errors import SimulationDivergedError
from solver.flexible_landing.equations import evaluate
from solver.flexible_landing.modal_record import Modes
from solver.landing.contact import Contact
from solver.landing.coupling import GEAR_ANSWER
from solver.landing.equations import AIRFRAME_ANSWER, AIRFRAME_STATES, GEAR_STATES
from solver.landing.initial import initial_state
from solver.landing.records import Record, Records

#: Height at which the aircraft is brought to rest, clear of the ground [m].
_CLEAR = 100.0
#: Largest acceleration left: gears [m/s2, rad/s2]; modes, over their frequency [kg^1/2 m/s].
_REST = 1e-8


def flexible_initial_state(
    contact: Contact,
    airframe: Record,
    gears: Records,
    modes: Modes,
    local_gears: Records,
    course: Array,
) -> Array:
    """State vector at the first ground contact.

    The airframe has the shape in which it flies under lift, weight and the weight of its hanging
    gears; the gears rest on their stops and springs as in the rigid landing.  Nothing rings before
    the ground is felt.

    Parameters
    ----------
    contact, airframe, gears, course
        As for `solver.landing.initial.initial_state`.
    modes, local_gears
        See `compiled_modes`.

    Returns
    -------
    (13 + 5 n_gears + 5 + 2 m,) array

    Raises
    ------
    SimulationDivergedError
        No state of rest is found.
    """
    rigid = initial_state(contact, airframe, gears, course)
    frequency = np.sqrt(modes.stiffness)
    size = len(frequency)
    state = np.concatenate([rigid, np.zeros(1 + 2 * size)])
    state[2] = -_CLEAR
    free = []
    for index, gear in enumerate(gears):
        at = AIRFRAME_STATES + GEAR_STATES * index
        free += [at, at + 2] if gear["swings"] else [at]
    first = len(rigid) + 1
    unknowns = np.array(free + list(range(first, first + size)))
    rates = np.array([at + 1 for at in free] + list(range(first + size, first + 2 * size)))
    scale = np.concatenate([np.ones(len(free)), 1 / frequency])

    def evaluated() -> tuple[Array, Records]:
        derivative = np.zeros_like(state)
        answer = np.zeros(1, dtype=AIRFRAME_ANSWER)
        gear_answers: Records = np.zeros(len(gears), dtype=GEAR_ANSWER)
        evaluate(
            0.0, state, airframe, local_gears, modes, course, derivative, answer[0], gear_answers
        )
        return derivative[rates] * scale, gear_answers

    residual, _ = evaluated()
    for _ in range(20):
        slope = np.empty((len(unknowns), len(unknowns)))
        for column, unknown in enumerate(unknowns):
            kept = state[unknown]
            state[unknown] += 1e-6 * scale[column]
            slope[:, column] = (evaluated()[0] - residual) / 1e-6
            state[unknown] = kept
        state[unknowns] -= scale * np.linalg.solve(slope, residual)
        residual, gear_answers = evaluated()
        if np.max(np.abs(residual)) < _REST:
            # The deflection of a tyre grows with the depth one to one.
            state[2] = -_CLEAR - np.max(gear_answers["deflection"])
            return state
    raise SimulationDivergedError(
        f"airframe and gears find no rest before the contact, {np.abs(residual).max():.3g} left"
    )
