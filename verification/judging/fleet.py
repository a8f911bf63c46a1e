"""Fly a fleet, landing by landing in several processes, resuming where an earlier run stopped."""

import json
import multiprocessing
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict, dataclass
from pathlib import Path

from threadpoolctl import threadpool_limits

from solver.aircraft.bizjet import build_bizjet
from solver.assess import AssessmentModel, load_assessment_model
from solver.flight_data.frame_file import packaged_frame
from solver.flight_data.geometry import Installation
from verification.judging.flight import fly
from verification.judging.methods import Answers, Recorder, answer, believed_installation
from verification.judging.population import draw_landing
from verification.judging.use_of_limits import UseOfLimits
from verification.run import ROOT
from verification.store import digest_of, digest_of_sources, exclusive

#: Recorders in turn.
RECORDERS = (Recorder("business-jet-8", 8.0), Recorder("business-jet-16", 16.0))

#: What an answer rests on.
_SOURCES = (
    "solver",
    *(
        f"verification/judging/{name}.py"
        for name in (
            "population", "service_scatter", "flight", "use_of_limits", "reading", "true_parts",
            "given_truth", "methods", "fleet",
        )
    ),
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Fleet:
    """What is flown, and where its answers are kept."""

    landings: int
    seed: int
    folder: Path
    cache: Path  #: of reduced models
    processes: int = 2

    @property
    def answers_file(self) -> Path:
        """One line for each landing; other sources or another seed have another file."""
        digest = digest_of([self.seed, digest_of_sources(ROOT, _SOURCES)])
        return self.folder / f"answers-{digest}.jsonl"


def judging_model(folder: Path, cache: Path) -> AssessmentModel:
    """Return the example aircraft, generated anew so that it is the one of these sources."""
    aircraft = folder / "aircraft"
    # Several processes must not write the same files.
    with exclusive(folder / "aircraft.lock"):
        build_bizjet(aircraft)
        return load_assessment_model(aircraft, cache)


def stored_answers(fleet: Fleet) -> dict[int, Answers]:
    """Answers of earlier runs, by number; a line that was cut off is flown again."""
    found: dict[int, Answers] = {}
    if fleet.answers_file.exists():
        for line in fleet.answers_file.read_text(encoding="utf-8").splitlines():
            try:
                each = Answers(**json.loads(line))
            except (ValueError, TypeError):
                continue
            found[each.number] = each
    return found


def fly_fleet(fleet: Fleet, progress: Callable[[int], None]) -> list[Answers]:
    """Answers of all landings of a fleet, in order.

    Parameters
    ----------
    fleet : Fleet
    progress : callable
        Is told how many landings are there after each.
    """
    answers = {n: a for n, a in stored_answers(fleet).items() if n < fleet.landings}
    progress(len(answers))
    missing = [number for number in range(fleet.landings) if number not in answers]
    fleet.folder.mkdir(parents=True, exist_ok=True)
    with fleet.answers_file.open("a", encoding="utf-8") as stream:
        # Ends a line that was cut off.
        stream.write("\n")
        for each in _flown(fleet, missing):
            answers[each.number] = each
            stream.write(json.dumps(asdict(each)) + "\n")
            stream.flush()
            progress(len(answers))
    return [answers[number] for number in sorted(answers)]


def _flown(fleet: Fleet, numbers: list[int]) -> Iterator[Answers]:
    if not numbers:
        return
    with ProcessPoolExecutor(
        min(fleet.processes, len(numbers)),
        mp_context=multiprocessing.get_context("spawn"),
        initializer=_prepare,
        initargs=(fleet.folder, fleet.cache),
    ) as pool:
        pending = [pool.submit(_answer, number, fleet.seed) for number in numbers]
        try:
            for done in as_completed(pending):
                yield done.result()
        finally:
            pool.shutdown(cancel_futures=True)


@dataclass(frozen=True, slots=True)
class _Prepared:
    use: UseOfLimits
    installation: Installation


_prepared: _Prepared | None = None


def _prepare(folder: Path, cache: Path) -> None:
    """Load the model once for each process."""
    global _prepared
    threadpool_limits(1)
    model = judging_model(folder, cache)
    _prepared = _Prepared(UseOfLimits(model), believed_installation(model))


def _answer(number: int, seed: int) -> Answers:
    assert _prepared is not None
    use, installation = _prepared.use, _prepared.installation
    frames = [packaged_frame(recorder.frame) for recorder in RECORDERS]
    flown = fly(use, draw_landing(number, seed), frames, installation)
    return answer(use, flown, installation, RECORDERS, number % len(RECORDERS))
