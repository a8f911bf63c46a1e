"""What is kept of a linear analysis: peaks, the most stressed element at every sample, fields."""

import numpy as np

from solver.arrays import Array, IntArray
from solver.fe.stress import SHELL_ROWS, StressRecovery


class LinearRecorder:
    """Takes displacement blocks as `integrate_full_order` hands them out.

    Parameters
    ----------
    wanted : (nw,) array
        Samples whose whole fields are kept.
    """

    def __init__(self, recovery: StressRecovery, samples: int, wanted: IntArray) -> None:
        count = recovery.n_shells + recovery.n_beams
        self._recovery, self._wanted = recovery, wanted
        self.peak = np.zeros(count)  #: (ne,) largest von Mises stress so far [Pa]
        self.largest = np.zeros(samples)  #: (nt,) of all elements [Pa]
        self.element = np.zeros(samples, dtype=np.int64)  #: (nt,) where that is
        self.fields = np.zeros((len(wanted), count))  #: von Mises stress [Pa]
        #: (nw, n_shells) smaller principal stress in the middle of the thickness [Pa]
        self.compression = np.zeros((len(wanted), recovery.n_shells))
        self.displacements = np.zeros((len(wanted), recovery.shell_operator.shape[1]))

    def __call__(self, first: int, displacements: Array) -> None:
        """Take the samples ``first`` onwards, displacements (n, nb)."""
        shells = self._recovery.shell_operator @ displacements
        stress = self._recovery.von_mises(shells, self._recovery.beam_operator @ displacements)
        np.maximum(self.peak, stress.max(axis=1), out=self.peak)
        samples = slice(first, first + stress.shape[1])
        self.element[samples] = stress.argmax(axis=0)
        self.largest[samples] = stress.max(axis=0)
        for row, sample in enumerate(self._wanted - first):
            if 0 <= sample < stress.shape[1]:
                self.fields[row] = stress[:, sample]
                self.compression[row] = _least_membrane_stress(shells[:, sample])
                self.displacements[row] = displacements[:, sample]


def _least_membrane_stress(rows: Array) -> Array:
    """Smaller principal stress (n,) of the mean of both faces from rows (6 n,)."""
    x, y, xy = rows.reshape(-1, 2, SHELL_ROWS // 2).mean(axis=1).T
    least: Array = 0.5 * (x + y) - np.hypot(0.5 * (x - y), xy)
    return least
