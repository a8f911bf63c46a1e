"""Running peaks of a full-order history, block by block, so that it is never held whole."""

from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Array

if TYPE_CHECKING:
    from solver.fe.stress import StressRecovery


class PeakAccumulator:
    """Takes displacement blocks as `integrate_full_order` hands them out."""

    def __init__(self, recovery: "StressRecovery") -> None:
        count = recovery.n_shells + recovery.n_beams
        self._recovery = recovery
        self.stress = np.zeros(count)  #: (ne,) largest von Mises so far [Pa]
        self.sample = np.zeros(count, dtype=np.int64)  #: (ne,) index of its sample

    def __call__(self, first: int, displacements: Array) -> None:
        """Take the samples ``first`` onwards, displacements (n, nb)."""
        stress = self._recovery.von_mises(
            self._recovery.shell_operator @ displacements,
            self._recovery.beam_operator @ displacements,
        )
        largest = stress.argmax(axis=1)
        value = np.take_along_axis(stress, largest[:, None], axis=1)[:, 0]
        higher = value > self.stress
        self.stress[higher] = value[higher]
        self.sample[higher] = first + largest[higher]
