"""The state of a run between two steps, and how it outlives an interruption."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import monotonic
from typing import Protocol

import numpy as np

from solver.arrays import Array
from solver.nonlinear.account import Account
from solver.nonlinear.configuration import Pose
from solver.nonlinear.midpoint import Motion
from solver.nonlinear.structure import NonlinearStructure

#: Time between two notes of the state on disk [s].
INTERVAL = 20.0


@dataclass(frozen=True, slots=True)
class Sample:
    """State handed to the recorder."""

    index: int  #: of the sample, 0 at the start
    time: float  #: [s]
    motion: Motion
    account: Account


class Recorder(Protocol):
    """Keeps what is wanted of a run; its arrays are stored with the state of the motion."""

    def __call__(self, sample: Sample) -> None:
        """Take a sample."""

    def arrays(self) -> dict[str, Array]:
        """Everything kept so far."""

    def restore(self, arrays: dict[str, Array]) -> None:
        """Take back what `arrays` gave."""


@dataclass(frozen=True, slots=True)
class Checkpoint:
    """Where an interrupted run is kept.

    The key must name everything that the run depends on: a file with another key is not used.
    """

    path: Path
    key: str


@dataclass(slots=True)
class RunState:
    """State between two steps."""

    step: int
    motion: Motion
    account: Account
    guesses: list[Array]  # increments of the last steps, oldest first
    iterations: int = 0
    seconds: float = 0.0
    largest_error: float = 0.0


class Keeper:
    """Writes the state of a run now and then, and reads it back."""

    def __init__(
        self,
        checkpoint: Checkpoint,
        structure: NonlinearStructure,
        record: Recorder | Callable[[Sample], None],
    ) -> None:
        self._place, self._structure = checkpoint, structure
        self._record: Recorder = record  # type: ignore[assignment]
        self._last = monotonic()

    def restored(self) -> RunState | None:
        """Take up an earlier run of the same key, if there is one."""
        if not self._place.path.exists():
            return None
        with np.load(self._place.path) as stored:
            arrays = dict(stored)
        if str(arrays["key"]) != self._place.key:
            return None
        prefix = "record_"
        self._record.restore(
            {name.removeprefix(prefix): a for name, a in arrays.items() if name.startswith(prefix)}
        )
        pose = Pose(arrays["positions"], arrays["quaternions"])
        at = self._structure.constraints.placed(pose)
        motion = Motion(
            pose=pose,
            velocities=arrays["velocities"],
            rates=arrays["rates"],
            at=at,
            places=self._structure.points.places(at),
            deformations=self._structure.elements.deformations(at),
        )
        step, iterations, seconds, error = arrays["counts"].tolist()
        return RunState(
            step=int(step),
            motion=motion,
            account=Account.of(arrays["account"]),
            guesses=list(arrays["guesses"]),
            iterations=int(iterations),
            seconds=seconds,
            largest_error=error,
        )

    def note(self, run: RunState) -> None:
        """Write the state if it is time to."""
        if monotonic() - self._last < INTERVAL:
            return
        path = self._place.path
        path.parent.mkdir(parents=True, exist_ok=True)
        partial = path.with_name(path.name + ".partial.npz")
        recorded = {f"record_{name}": array for name, array in self._record.arrays().items()}
        np.savez(
            partial,
            allow_pickle=False,
            key=np.array(self._place.key),
            counts=np.array([run.step, run.iterations, run.seconds, run.largest_error]),
            positions=run.motion.pose.positions,
            quaternions=run.motion.pose.quaternions,
            velocities=run.motion.velocities,
            rates=run.motion.rates,
            account=run.account.values(),
            guesses=np.array(run.guesses),
            **recorded,
        )
        partial.replace(path)
        self._last = monotonic()

    def finish(self) -> None:
        """Delete what is no longer needed."""
        self._place.path.unlink(missing_ok=True)
