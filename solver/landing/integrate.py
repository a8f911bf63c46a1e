"""Time integration: Dormand & Prince's embedded Runge-Kutta pair 5(4), adaptive.

J. R. Dormand, P. J. Prince, J. Comp. Appl. Math. 6 (1980) 19.  Each interval of the output grid is
integrated on its own with as many steps as the tolerance asks for, so that the grid's instants are
ends of steps: states there carry the full order and no interpolation, and the equations are
evaluated once more there for accelerations and forces.  The kinks of first contact and of the stops
are found by the step control.
"""

import numba
import numpy as np

from solver.arrays import Array
from solver.landing.equations import energies, evaluate
from solver.landing.records import Record, Records

#: Steps within one grid interval after which the run counts as diverged.
STEP_LIMIT = 20000

_A = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0],
        [44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0],
        [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ]
)
NODES = np.array([0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
_ERROR = np.array([71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])


@numba.njit(cache=True)
def put_stage(now: Array, stages: Array, stage: int, part: float, trial: Array) -> None:
    """Fill the trial state of a stage from the derivatives of those before it."""
    trial[:] = now
    for k in range(stage):
        if _A[stage, k] != 0.0:
            trial += part * _A[stage, k] * stages[k]


@numba.njit(cache=True)
def step_error(
    now: Array, trial: Array, stages: Array, part: float, scale: Array, tolerance: float
) -> float:
    """Error of a step from ``now`` to ``trial`` over its bound, root mean square of all states."""
    error = 0.0
    for i in range(now.size):
        change = 0.0
        for k in range(7):
            change += _ERROR[k] * stages[k, i]
        bound = scale[i] + max(abs(now[i]), abs(trial[i]))
        error += (part * change / (tolerance * bound)) ** 2
    return float(np.sqrt(error / now.size))


@numba.njit(cache=True)
def next_step(step: float, part: float, error: float, interval: float) -> float:
    """Step to try after one of length ``part`` with this error."""
    if not error < 1e12:
        return 0.1 * part
    growth: float = min(5.0, max(0.2, 0.9 * max(error, 1e-8) ** -0.2))
    if error > 1.0 or growth < 1.0:
        return growth * part
    # A step cut short by the grid says nothing against a longer one.
    return min(max(step, growth * part), interval)


@numba.njit(cache=True, nogil=True)
def integrate(
    start: float,
    interval: float,
    states: Array,
    first_step: float,
    scale: Array,
    tolerance: float,
    airframe: Record,
    gears: Records,
    course: Array,
    answers: Records,
    gear_answers: Records,
    stored: Array,
) -> tuple[int, float, int]:
    """Fill the grid from its first row on.

    Parameters
    ----------
    start : float
        Time of the first row [s].
    interval : float
        Grid interval [s].
    states : (n + 1, n_states) array
        First row given, the others filled.
    first_step : float
        Step to try first [s].
    scale : (n_states,) array
        Size of each state at which the tolerance is an absolute one.
    tolerance : float
        Error of a step, relative to scale + |state|.
    airframe, gears, course
        As for `evaluate`.
    answers : (n + 1,) array of AIRFRAME_ANSWER
        Filled, first row too.
    gear_answers : (n + 1, n_gears) array of GEAR_ANSWER
        Filled.
    stored : (n + 1, 6) array
        Filled with `energies`.

    Returns
    -------
    rows : int
        Rows that are good; fewer than n + 1 means that the motion diverged.
    step : float
        Step to go on with [s].
    evaluations : int
        Of the equations.
    """
    size = states.shape[1]
    stages = np.empty((7, size))
    trial = np.empty(size)
    now = states[0].copy()
    step = first_step
    evaluations = 1
    evaluate(start, now, airframe, gears, course, stages[0], answers[0], gear_answers[0])
    energies(now, airframe, gears, gear_answers[0], stored[0])
    for row in range(1, states.shape[0]):
        answer, gear_answer = answers[row], gear_answers[row]
        begin = start + (row - 1) * interval
        done = 0.0
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
        length = np.sqrt(now[3] ** 2 + now[4] ** 2 + now[5] ** 2 + now[6] ** 2)
        now[3:7] /= length
        states[row] = now
        evaluate(
            start + row * interval, now, airframe, gears, course, stages[0], answer, gear_answer
        )
        energies(now, airframe, gears, gear_answer, stored[row])
        evaluations += 1
    return states.shape[0], step, evaluations
