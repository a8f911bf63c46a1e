"""Computing chapters, in this process or in several; one that fails keeps none from the rest."""

import multiprocessing
import traceback
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from importlib import import_module
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess
from time import perf_counter
from typing import Protocol

from threadpoolctl import threadpool_limits

from verification.chapter import Chapter
from verification.outcome import Outcome
from verification.run import Run

#: Where a chapter's module is looked for.
CHAPTERS = "verification.chapters"


class Watcher(Protocol):
    """Who is told how the chapters are getting on."""

    def started(self, chapter: str) -> None:
        """Note that a chapter was begun."""

    def progress(self, chapter: str, step: str, share: float) -> None:
        """Note that ``share`` of a chapter's present step is done."""

    def finished(self, outcome: Outcome) -> None:
        """Note that a chapter is done, or failed."""


def compute_chapter(name: str, run: Run, package: str = CHAPTERS) -> Outcome:
    """Compute one chapter; whatever it raises is its outcome."""
    first = len(run.taken)
    start = perf_counter()
    chapter: Chapter | None = None
    failure = ""
    try:
        with threadpool_limits(1):
            chapter = import_module(f"{package}.{name}").chapter(run)
    except Exception:
        failure = traceback.format_exc()
    airframe = vars(run).get("airframe")
    return Outcome(
        name=name,
        chapter=chapter,
        failure=failure,
        seconds=perf_counter() - start,
        taken=tuple(run.taken[first:]),
        aircraft="" if airframe is None else airframe.content_hash,
    )


def compute_here(
    names: Sequence[str], run: Run, watcher: Watcher, package: str = CHAPTERS
) -> list[Outcome]:
    """Compute chapters one after the other in this process."""
    outcomes = []
    name = ""
    run = replace(run, progress=lambda step, share: watcher.progress(name, step, share))
    for name in names:
        watcher.started(name)
        outcomes.append(compute_chapter(name, run, package))
        watcher.finished(outcomes[-1])
    return outcomes


@dataclass(frozen=True, slots=True)
class _Worker:
    process: SpawnProcess
    pipe: Connection


def compute_apart(
    names: Sequence[str],
    run: Run,
    watcher: Watcher,
    processes: int = 2,
    package: str = CHAPTERS,
) -> list[Outcome]:
    """Compute chapters in several processes, each keeping its models from chapter to chapter.

    A process that dies (out of memory, a fault in compiled code) fails the chapter it was at and
    is replaced.
    """
    waiting = list(names)
    outcomes: dict[str, Outcome] = {}
    busy: dict[Connection, tuple[_Worker, str, float]] = {}
    idle = [_worker(run, package) for _ in range(min(processes, len(waiting)))]
    try:
        while waiting or busy:
            while waiting and idle:
                worker, name = idle.pop(), waiting.pop(0)
                with suppress(OSError):  # of a dead process, which receiving finds out
                    worker.pipe.send(name)
                busy[worker.pipe] = (worker, name, perf_counter())
                watcher.started(name)
            for pipe in wait(list(busy)):
                assert isinstance(pipe, Connection)
                worker, name, start = busy[pipe]
                try:
                    message = pipe.recv()
                except (EOFError, OSError):
                    worker.process.join()
                    failure = f"its process ended with exit code {worker.process.exitcode}"
                    message = Outcome(name, None, failure, perf_counter() - start)
                    worker = _worker(run, package)
                if isinstance(message, Outcome):
                    outcomes[name] = message
                    watcher.finished(message)
                    del busy[pipe]
                    idle.append(worker)
                else:
                    watcher.progress(name, *message)
    finally:
        for worker in idle + [entry[0] for entry in busy.values()]:
            worker.process.terminate()
            worker.process.join()
    return [outcomes[name] for name in names]


def _worker(run: Run, package: str) -> _Worker:
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    plain = Run(run.folder, run.quick)
    process = context.Process(target=_work, args=(theirs, plain, package), daemon=True)
    process.start()
    theirs.close()  # so that the end of the process ends the pipe
    return _Worker(process, ours)


def _work(pipe: Connection, settings: Run, package: str) -> None:
    """Compute the chapters whose names come through the pipe."""
    run = replace(settings, progress=_Throttle(lambda *message: pipe.send(message)))
    while True:
        try:
            name = pipe.recv()
        except EOFError:
            return
        pipe.send(compute_chapter(name, run, package))


class _Throttle:
    """Progress that passes on what is new, not every step of a long integration."""

    def __init__(self, send: Callable[[str, float], None], interval: float = 0.1) -> None:
        self._send, self._interval = send, interval
        self._step, self._last = "", 0.0

    def __call__(self, step: str, share: float) -> None:
        now = perf_counter()
        if step == self._step and share < 1.0 and now - self._last < self._interval:
            return
        self._step, self._last = step, now
        self._send(step, share)
