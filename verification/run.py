"""One run of the verification: what it may take from earlier ones, and what its chapters share."""

import shutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from time import perf_counter

import numpy as np

from solver.aircraft.airframe import Airframe, load_airframe
from solver.aircraft.bizjet import build_bizjet
from solver.arrays import Array
from solver.inertia_relief.build import reduced_model
from solver.inertia_relief.reduced import ReducedModel
from solver.progress import Progress, silent
from verification.store import digest_of, digest_of_sources, exclusive

ROOT = Path(__file__).parent.parent

#: What the airframe's model and its reduced form rest on.
MODEL_SOURCES = ("solver/fe", "solver/aircraft", "solver/inertia_relief")


@dataclass(frozen=True, slots=True)
class StoredResult:
    """A long computation of a chapter, done in this run or in an earlier one."""

    name: str
    seconds: float  #: that it took when it was computed
    is_earlier: bool  #: whether it was taken from the store


@dataclass(frozen=True)
class Run:
    """Settings and shared values of one run."""

    folder: Path  #: where results are kept, so that an interrupted run resumes
    quick: bool = False  #: the short form: small sizes, coarse steps, no hour-long reference
    progress: Progress = field(default=silent)
    taken: list[StoredResult] = field(default_factory=list)  #: from `stored`, in order

    @cached_property
    def airframe(self) -> Airframe:
        """The full-size example aircraft, generated in this run."""
        folder = self.folder / "aircraft"
        # Two chapters at once must not write the same files.
        with exclusive(self.folder / "aircraft.lock"):
            build_bizjet(folder, progress=self.progress)
            return load_airframe(folder, self.progress)

    @cached_property
    def reduced(self) -> ReducedModel:
        """Reduced model of the example aircraft, kept while its sources are unchanged."""
        airframe = self.airframe
        folder = self.folder / "reduced" / digest_of_sources(ROOT, MODEL_SOURCES)
        with exclusive(self.folder / "reduced.lock"):
            if not folder.exists():
                shutil.rmtree(folder.parent, ignore_errors=True)  # of other sources; 200 MB each
            return reduced_model(airframe, folder, progress=self.progress)

    def stored(
        self,
        name: str,
        inputs: Sequence[object],
        sources: Sequence[str],
        compute: Callable[[], Mapping[str, Array]],
    ) -> dict[str, Array]:
        """Give a long computation's result, stored while what it rests on is unchanged.

        Parameters
        ----------
        inputs : sequence
            Everything the result depends on: arrays, numbers, texts, dataclasses and collections
            of such; see `verification.store.digest_of`.
        sources : sequence of str
            Packages or modules whose text the result depends on, as paths below the project's
            root, for instance ``solver/nonlinear``.
        compute : callable
            Gives the named arrays.
        """
        digest = digest_of([inputs, digest_of_sources(ROOT, sources)])
        target = self.folder / "results" / f"{name}-{digest}.npz"
        target.parent.mkdir(parents=True, exist_ok=True)
        with exclusive(target.with_suffix(".lock")):
            if target.exists():
                with np.load(target) as kept:
                    result = dict(kept)
                seconds = float(result.pop("stored_seconds"))
                self.taken.append(StoredResult(name, seconds, is_earlier=True))
                return result
            start = perf_counter()
            result = {key: np.asarray(value) for key, value in compute().items()}
            seconds = perf_counter() - start
            partial = target.with_suffix(".partial.npz")
            np.savez_compressed(partial, allow_pickle=False, stored_seconds=seconds, **result)
            partial.replace(target)
        self.taken.append(StoredResult(name, seconds, is_earlier=False))
        return result
