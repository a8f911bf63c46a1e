"""Stress rows in sixteen bits, which halves the memory of an airframe and what a search reads.

Every entry of a row is a whole number of steps of which its largest has `STEPS`, so that it is off
by half a step at most.  The coordinates that rows are for move by amounts not too unlike (see
`ReducedStress.scale`); half a step in all of them is then little beside the row's own stress.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.arrays import IntArray, Short, Single

#: Steps from zero to a row's largest entry.
STEPS = 2**15 - 1


@dataclass(frozen=True, slots=True)
class RoundedRows:
    """Rows of n elements for m coordinates, six each."""

    numbers: Short  #: (n, 6, m) whole steps
    step: Single  #: (n, 6) stress of one step at unit coordinate [Pa]

    def __len__(self) -> int:
        return len(self.numbers)

    def __getitem__(self, elements: slice | IntArray) -> "RoundedRows":
        return RoundedRows(self.numbers[elements], self.step[elements])

    def exact(self) -> Single:
        """Rows (n, 6, m) as they are understood everywhere [Pa]."""
        rows: Single = self.numbers * self.step[..., None]
        return rows


def rounded(rows: NDArray[np.floating]) -> RoundedRows:
    """Round rows (n, 6, m) [Pa] to sixteen bits each."""
    largest = np.abs(rows).max(axis=2, initial=0.0)
    step = np.where(largest > 0.0, largest / STEPS, 1.0).astype(np.float32)
    return RoundedRows(np.rint(rows / step[..., None]).astype(np.int16), step)
