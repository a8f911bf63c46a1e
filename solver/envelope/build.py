"""Making an aircraft's envelope: landings over several processes, then a surface."""

import fcntl
import multiprocessing
import os
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from solver import __version__
from solver.arrays import Array
from solver.assess import AssessmentModel, load_assessment_model
from solver.envelope.domain import Domain
from solver.envelope.envelope import COVERED_SHARE, Basis, Envelope, SurfaceError
from solver.envelope.samples import Sample, SampleFile, held_out
from solver.envelope.sampling import find_domain, sample_rounds, solve_one
from solver.envelope.store import envelope_path, load_envelope, save_envelope
from solver.envelope.surface import GRADED, Surface
from solver.errors import ModelError
from solver.progress import Progress, silent

#: Two minutes on two cores where a landing takes 0.2 s.
LANDINGS = 1200

STEP = "landings of the envelope"


class EnvelopeBusyError(Exception):
    """Another process makes the same envelope now."""


def build_envelope(
    folder: Path,
    cache: Path,
    landings: int = LANDINGS,
    processes: int | None = None,
    progress: Progress = silent,
) -> Envelope:
    """Envelope of the aircraft in ``folder``, from ``cache`` or made and stored there.

    Parameters
    ----------
    folder : Path
        Aircraft folder.
    cache : Path
        Holds reduced models and envelopes.
    landings : int
        How many to solve; landings of an interrupted run count.
    processes : int, optional
        By default as many as there are cores; 1 solves in this one.

    Raises
    ------
    ModelError
        The aircraft cannot be used, or hardly any of its landings can be simulated.
    EnvelopeBusyError
        Another process is at it.
    """
    model = load_assessment_model(folder, cache, progress)
    path = envelope_path(cache, model.content_hash)
    with _alone(path.with_suffix(".lock")):
        stored = load_envelope(path, model.airframe.definition)
        if stored is not None:
            return stored
        domain = find_domain(model)
        kept = SampleFile(path.with_suffix(".landings.jsonl"))
        known = kept.read()
        count = min(len(known), landings)

        def solve(asked: Sequence[tuple[int, Array]]) -> Iterator[Sample]:
            nonlocal count
            with kept.appending() as stream:
                for sample in _solved(model, folder, cache, asked, processes or _cores()):
                    kept.write(stream, sample)
                    count += 1
                    progress(STEP, count / landings)
                    yield sample

        samples, surface = sample_rounds(domain, model.airframe, known, landings, solve)
        error, compared = surface_error(domain, surface, samples)
        envelope = Envelope(
            basis=Basis(
                content_hash=model.content_hash,
                program_version=__version__,
                landings=len(surface.places),
                failed=sum(not sample.is_solved for sample in samples),
            ),
            domain=domain,
            surface=surface,
            error=error,
            held_out=compared,
            mass_states=model.airframe.mass_states,
        )
        save_envelope(path, envelope)
        kept.remove()
    return envelope


def surface_error(
    domain: Domain, surface: Surface, samples: Sequence[Sample]
) -> tuple[SurfaceError, Array]:
    """Compare the surface with the landings that were held out, where it is graded.

    Returns
    -------
    SurfaceError
    (n, 2) array
        Utilisation expected and found of every landing compared.

    Raises
    ------
    ModelError
        Too few of them lie near the limits to tell.
    """
    out = [s for s in samples if s.is_solved and held_out([s.number])[0]]
    enough = round(1.0 / (1.0 - COVERED_SHARE))
    if len(out) < enough:
        raise ModelError(f"{len(out)} landings are too few to compare an envelope with: {enough}")
    expected, stops = surface(domain.unit(np.array([s.coordinates for s in out])))
    found = np.array([s.utilisations.max() for s in out])
    graded = (expected > GRADED[0]) & (expected < GRADED[1])
    if graded.sum() < enough:
        raise ModelError(
            f"{int(graded.sum())} of {len(out)} landings to compare with are expected to use "
            f"{GRADED[0]:g} to {GRADED[1]:g} of a limit; {enough} are needed, so ask for more"
        )
    relative = found[graded] / expected[graded] - 1.0
    beyond = np.array([s.stops.max() for s in out])[graded] / stops[graded] - 1.0
    error = SurfaceError(
        above=max(0.0, float(np.quantile(relative, COVERED_SHARE))),
        below=max(0.0, -float(np.quantile(relative, 1.0 - COVERED_SHARE))),
        stops_above=max(0.0, float(np.quantile(beyond, COVERED_SHARE))),
        root_mean_square=float(np.sqrt(np.mean(relative**2))),
        landings=int(graded.sum()),
    )
    return error, np.column_stack([expected, found])


def _cores() -> int:
    return os.cpu_count() or 1


def _solved(
    model: AssessmentModel,
    folder: Path,
    cache: Path,
    asked: Sequence[tuple[int, Array]],
    processes: int,
) -> Iterator[Sample]:
    if processes == 1:
        for number, coordinates in asked:
            yield solve_one(model, number, coordinates)
        return
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(processes, context, _load, (folder, cache)) as pool:
        waiting: list[Future[Sample]] = [pool.submit(_solve, *landing) for landing in asked]
        try:
            for done in as_completed(waiting):
                yield done.result()
        finally:
            pool.shutdown(cancel_futures=True)


_model: AssessmentModel | None = None


def _load(folder: Path, cache: Path) -> None:
    """Give a process of the pool its model; the reduced one is mapped, not copied."""
    global _model
    threading.Thread(target=_end_with_parent, daemon=True).start()
    _model = load_assessment_model(folder, cache)


def _end_with_parent() -> None:
    """End this process if the one that wants its answers was killed: it would wait for ever."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _solve(number: int, coordinates: Array) -> Sample:
    if _model is None:
        raise RuntimeError("the process was given no model")
    return solve_one(_model, number, coordinates)


@contextmanager
def _alone(lock: Path) -> Iterator[None]:
    """Let one process at a time make an envelope; the lock goes with the process that held it."""
    lock.parent.mkdir(parents=True, exist_ok=True)
    with lock.open("w") as stream:
        try:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise EnvelopeBusyError(f"another process holds {lock}") from error
        yield
