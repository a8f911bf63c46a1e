"""The landings an envelope is made of, kept line by line while it is being made.

Whoever is interrupted goes on with what is there.
"""

import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TextIO

import numpy as np

from solver.arrays import Array, BoolArray

#: Every fifth landing is never fitted, only compared with.
_HELD_OUT = 5


@dataclass(frozen=True, slots=True)
class Sample:
    """One landing of an envelope; empty arrays for one that cannot be simulated."""

    number: int
    coordinates: Array  #: (12,)
    utilisations: Array  #: (k,) of every zone and gear
    stops: Array  #: (m,)

    @property
    def is_solved(self) -> bool:
        """Whether there is an outcome."""
        return len(self.utilisations) > 0


def held_out(numbers: Sequence[int]) -> BoolArray:
    """Which of the numbered landings are kept for comparing."""
    kept: BoolArray = np.asarray(numbers) % _HELD_OUT == _HELD_OUT - 1
    return kept


class SampleFile:
    """Landings solved so far, a line for each; the last line may be cut off."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def read(self) -> list[Sample]:
        """Landings of the lines that are whole."""
        try:
            lines = self._path.read_text().splitlines()
        except FileNotFoundError:
            return []
        found = []
        for line in lines:
            try:
                row = json.loads(line)
            except json.JSONDecodeError:
                continue  # whoever wrote it was interrupted
            found.append(
                Sample(
                    row["number"],
                    _array(row["coordinates"]),
                    _array(row["utilisations"]),
                    _array(row["stops"]),
                )
            )
        return found

    @contextmanager
    def appending(self) -> Iterator[TextIO]:
        """Open for more lines; a line that was cut off is ended first."""
        self._path.parent.mkdir(parents=True, exist_ok=True)
        with self._path.open("a") as stream:
            stream.write("\n" if stream.tell() else "")
            yield stream

    @staticmethod
    def write(stream: TextIO, sample: Sample) -> None:
        """Add a landing, and see that it is on disk before the next."""
        row = {
            name: value.tolist() if isinstance(value, np.ndarray) else value
            for name, value in asdict(sample).items()
        }
        stream.write(json.dumps(row) + "\n")
        stream.flush()

    def remove(self) -> None:
        """Forget the landings: their envelope is stored."""
        self._path.unlink(missing_ok=True)


def _array(values: list[float]) -> Array:
    return np.array(values, dtype=np.float64)
