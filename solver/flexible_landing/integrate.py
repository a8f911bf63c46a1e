"""Time integration of the flexible landing: the scheme and step control of the rigid one."""

import numba
import numpy as np

from solver.arrays import Array
from solver.flexible_landing.energy import energies
from solver.flexible_landing.equations import evaluate
from solver.flexible_landing.modal_record import Modes
from solver.landing.integrate import NODES, STEP_LIMIT, next_step, put_stage, step_error
from solver.landing.records import Record, Records


@numba.njit(cache=True)
def integrate(
    start: float,
    interval: float,
    states: Array,
    first_step: float,
    scale: Array,
    tolerance: float,
    airframe: Record,
    gears: Records,
    modes: Modes,
    course: Array,
    answers: Records,
    gear_answers: Records,
    stored: Array,
) -> tuple[int, float, int]:
    """Fill the grid from its first row on; see `solver.landing.integrate.integrate`.

    Returns
    -------
    rows : int
        Rows that are good; fewer than those of ``states`` means that the motion diverged.
    step : float
        Step to go on with [s].
    evaluations : int
        Of the equations.
    """
    size = states.shape[1]
    stages, trial = np.empty((7, size)), np.empty(size)
    now = states[0].copy()
    step = first_step
    evaluations = 1
    evaluate(start, now, airframe, gears, modes, course, stages[0], answers[0], gear_answers[0])
    energies(now, airframe, gears, modes, gear_answers[0], stored[0])
    for row in range(1, states.shape[0]):
        answer, gear_answer = answers[row], gear_answers[row]
        begin, done = start + (row - 1) * interval, 0.0
        for _ in range(STEP_LIMIT):
            left = interval - done
            # Equal shares of what is left, never a crumb at the end.
            part = left / np.ceil(left / step * (1.0 - 1e-9))
            for stage in range(1, 7):
                put_stage(now, stages, stage, part, trial)
                evaluate(
                    begin + done + NODES[stage] * part,
                    trial,
                    airframe,
                    gears,
                    modes,
                    course,
                    stages[stage],
                    answer,
                    gear_answer,
                )
            evaluations += 6
            error = step_error(now, trial, stages, part, scale, tolerance)
            step = next_step(step, part, error, interval)
            if error <= 1.0:
                done += part
                now[:] = trial
                stages[0] = stages[6]
                if left - part <= 1e-9 * interval:
                    break
            if step < 1e-9 * interval:
                return row, step, evaluations
        else:
            return row, step, evaluations
        now[3:7] /= np.sqrt(now[3] ** 2 + now[4] ** 2 + now[5] ** 2 + now[6] ** 2)
        states[row] = now
        evaluate(
            start + row * interval,
            now,
            airframe,
            gears,
            modes,
            course,
            stages[0],
            answer,
            gear_answer,
        )
        energies(now, airframe, gears, modes, gear_answer, stored[row])
        evaluations += 1
    return states.shape[0], step, evaluations
