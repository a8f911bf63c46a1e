"""Nonlinear dynamics of a free structure, step after step, interrupted and resumed at will."""

from collections.abc import Callable
from dataclasses import dataclass
from time import process_time

import numpy as np

from solver.arrays import Array
from solver.errors import SimulationDivergedError
from solver.inertia_relief.damping import RayleighDamping
from solver.nonlinear.account import Account
from solver.nonlinear.checkpoint import Checkpoint, Keeper, Recorder, RunState, Sample
from solver.nonlinear.correction import Corrector
from solver.nonlinear.loads import DirectedLoads
from solver.nonlinear.midpoint import MidpointStep, Motion
from solver.nonlinear.newton import SolvedStep, solve_step
from solver.nonlinear.structure import NonlinearStructure
from solver.progress import Progress, silent

#: Energy norm of the correction not made in a step, relative to that of the deformation.
TOLERANCE = 1e-5


@dataclass(frozen=True, slots=True)
class NonlinearReport:
    """What a run took."""

    steps: int
    iterations: int  #: evaluations of the residual, in all
    seconds: float  #: processor time, parts before an interruption included [s]
    factorisations: int  #: since the last interruption
    largest_error: float  #: see `solver.nonlinear.newton.SolvedStep`


def integrate_nonlinear(
    structure: NonlinearStructure,
    start: Motion,
    loads: DirectedLoads,
    damping: RayleighDamping,
    corrector: Corrector,
    step: float,
    count: int,
    record: Recorder | Callable[[Sample], None],
    every: int = 1,
    tolerance: float = TOLERANCE,
    checkpoint: Checkpoint | None = None,
    progress: Progress = silent,
) -> NonlinearReport:
    """Integrate ``count`` steps of the free motion of a structure.

    Parameters
    ----------
    start : Motion
        At the first time of the loads.
    corrector : Corrector
        Made for the same step and damping.
    step : float
        [s]
    record : Recorder or callable
        Called at the start and after every ``every`` steps; with a checkpoint it must be a
        `Recorder`.
    tolerance : float
        See `TOLERANCE`.
    checkpoint : Checkpoint, optional
        The run writes its state there now and then (`solver.nonlinear.checkpoint.INTERVAL`) and
        begins from it if it has one; the file is deleted at the end.

    Raises
    ------
    SimulationDivergedError
        A step does not converge.
    """
    keeper = None if checkpoint is None else Keeper(checkpoint, structure, record)
    run = None if keeper is None else keeper.restored()
    if run is None:
        run = RunState(0, start, Account(), [])
        record(Sample(0, float(loads.time[0]), start, run.account))
    size = float(np.ptp(structure.model.coordinates, axis=0).max())
    began = float(loads.time[0])
    while run.step < count:
        clock = process_time()
        middle = loads.at(began + (run.step + 0.5) * step)
        equations = MidpointStep(structure, run.motion, step, damping, middle, loads.gravity)
        corrector.prepare(run.motion.at)
        try:
            solved = solve_step(equations, corrector, _guess(run, structure), tolerance, size)
        except SimulationDivergedError:
            corrector.renew(run.motion.at)
            guess = run.guesses[-1] if run.guesses else np.zeros((len(structure.free_nodes), 6))
            solved = solve_step(equations, corrector, guess, tolerance, size)
        corrector.judge(solved.iterations)
        account = _accounted(run, structure, middle, loads.gravity, solved, step)
        run.step, run.motion, run.account = run.step + 1, solved.trial.motion, account
        run.guesses = [*run.guesses, solved.increments][-3:]
        run.iterations += solved.iterations
        if np.isfinite(solved.error):
            run.largest_error = max(run.largest_error, solved.error)
        run.seconds += process_time() - clock
        if run.step % every == 0:
            record(Sample(run.step // every, began + run.step * step, run.motion, run.account))
            progress("nonlinear integration", run.step / count)
        if keeper is not None:
            keeper.note(run)
    if keeper is not None:
        keeper.finish()
    return NonlinearReport(
        count, run.iterations, run.seconds, corrector.factorisations, run.largest_error
    )


def _guess(run: RunState, structure: NonlinearStructure) -> Array:
    """Extrapolate the last increments: parabola, line, constant, as far as they reach back."""
    if not run.guesses:
        return np.zeros((len(structure.free_nodes), 6))
    if len(run.guesses) == 1:
        return run.guesses[0]
    if len(run.guesses) == 2:
        return 2 * run.guesses[1] - run.guesses[0]
    return 3 * (run.guesses[2] - run.guesses[1]) + run.guesses[0]


def _accounted(
    run: RunState,
    structure: NonlinearStructure,
    loads: Array,
    gravity: Array,
    solved: SolvedStep,
    step: float,
) -> Account:
    """Account after a step."""
    account, trial = run.account, solved.trial
    weights = np.asarray(structure.points.mass.sum(axis=1)).ravel()
    places = 0.5 * (run.motion.places + trial.motion.places)
    weight = weights[:, None] * gravity
    # moments are taken before the loads are carried to the free nodes
    force = loads[:, :3].sum(axis=0) + weight.sum(axis=0)
    moment = (np.cross(trial.middle.positions, loads[:, :3]) + loads[:, 3:]).sum(axis=0)
    moment += np.cross(places, weight).sum(axis=0)
    carried = structure.on_free_nodes(trial.middle, loads.copy())
    travelled = trial.motion.places - run.motion.places
    return Account(
        load_work=account.load_work + float(np.vdot(carried, solved.increments)),
        gravity_work=account.gravity_work + float(np.vdot(weight, travelled)),
        elastic_work=account.elastic_work + trial.elastic_work,
        damping_work=account.damping_work + trial.damping_work,
        impulse=account.impulse + step * np.concatenate([force, moment]),
    )
