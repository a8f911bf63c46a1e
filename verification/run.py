"""One run of the verification: what it may take from earlier ones, and what its chapters share."""

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from solver.aircraft.airframe import Airframe, load_airframe
from solver.aircraft.bizjet import build_bizjet
from solver.arrays import Array
from solver.inertia_relief.build import reduced_model
from solver.inertia_relief.reduced import ReducedModel
from solver.progress import Progress, silent

ROOT = Path(__file__).parent.parent


@dataclass(frozen=True)
class Run:
    """Settings and shared values of one run."""

    folder: Path  #: where results are kept, so that an interrupted run resumes
    quick: bool = False  #: the short form: small sizes, coarse steps, no hour-long reference
    progress: Progress = field(default=silent)

    @cached_property
    def airframe(self) -> Airframe:
        """The full-size example aircraft, generated in this run."""
        folder = self.folder / "aircraft"
        build_bizjet(folder, progress=self.progress)
        return load_airframe(folder, self.progress)

    @cached_property
    def reduced(self) -> ReducedModel:
        """Reduced model of the example aircraft."""
        return reduced_model(self.airframe, self.folder / "reduced", progress=self.progress)

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
            Everything the result depends on: arrays by their bytes, other values by ``repr``.
        sources : sequence of str
            Packages or modules whose text the result depends on, as paths below the project's
            root, for instance ``solver/nonlinear``.
        compute : callable
            Gives the named arrays.
        """
        digest = hashlib.sha256()
        for value in inputs:
            if isinstance(value, np.ndarray):
                digest.update(np.ascontiguousarray(value).tobytes())
            else:
                digest.update(repr(value).encode())
        for source in sources:
            path = ROOT / source
            for file in sorted(path.rglob("*.py")) if path.is_dir() else [path]:
                digest.update(file.read_bytes())
        target = self.folder / "results" / f"{name}-{digest.hexdigest()[:16]}.npz"
        if target.exists():
            with np.load(target) as kept:
                return dict(kept)
        result = {key: np.asarray(value) for key, value in compute().items()}
        target.parent.mkdir(parents=True, exist_ok=True)
        partial = target.with_suffix(".partial.npz")
        np.savez_compressed(partial, allow_pickle=False, **result)
        partial.replace(target)
        return result
