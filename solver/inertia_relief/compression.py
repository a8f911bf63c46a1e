"""A landing's own history written in as few vectors as it needs.

The principal directions of the history in the strain-energy norm: what is dropped is known at every
sample, hence so is the largest stress error it can cause.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array


@dataclass(frozen=True, slots=True)
class CompressedHistory:
    """``coordinates ~ directions @ amplitudes``."""

    directions: Array  #: (m, r) orthonormal
    amplitudes: Array  #: (r, nt)
    dropped: float  #: largest norm over time of what is left out
    largest: float  #: largest norm over time of the history


def compress(coordinates: Array, tolerance: float) -> CompressedHistory:
    """Compress a history (m, nt) until at no sample more than ``tolerance`` of it is dropped.

    Parameters
    ----------
    tolerance : float
        Norm dropped at any sample relative to the largest norm of any sample.
    """
    directions = np.linalg.eigh(coordinates @ coordinates.T)[1][:, ::-1]
    amplitudes = directions.T @ coordinates
    # norm of what each rank leaves out at each sample, summed from the smallest direction up
    squares = np.cumsum((amplitudes * amplitudes)[::-1], axis=0)[::-1].max(axis=1)
    largest = float(np.sqrt(squares[0]))
    keep = np.flatnonzero(squares > (tolerance * largest) ** 2)
    rank = int(keep[-1]) + 1 if len(keep) else 1
    dropped = float(np.sqrt(squares[rank])) if rank < len(squares) else 0.0
    return CompressedHistory(
        np.ascontiguousarray(directions[:, :rank]),
        np.ascontiguousarray(amplitudes[:rank]),
        dropped,
        largest,
    )
