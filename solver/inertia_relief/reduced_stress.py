"""Stress of every element in reduced coordinates: exact rows, and the same compressed by blocks.

Elements next to each other follow the same motion, so the rows of a block of elements factor into
a few patterns, combinations of the coordinates, and the share that each row takes of them.  What
the factors leave out is bounded for every element: they are for choosing what to look at, and what
is reported comes from the exact rows.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from solver.arrays import Array, IntArray, Single

#: Elements of a block.
BLOCK = 128


@dataclass(frozen=True, slots=True)
class StressBlock:
    """Some elements of one kind; n elements, m coordinates, r patterns, p measures."""

    rows: Single  #: (n, 6, m) see `StressRows`
    points: Single  #: (n, 8, 5) of beams, (n, 0, 5) of shells
    patterns: slice  #: rows of `ReducedStress.patterns`
    shares: Single  #: (6 n, r) of the patterns
    squares: Single  #: (n, p) see `measure_squares`, of the compressed rows
    dropped: Single  #: (n,) largest stress left out for unit norm of coordinates / spread


@dataclass(frozen=True, slots=True)
class ReducedStress:
    """All blocks, shells first, in arrays that can be mapped from files.

    Everything here is for coordinates divided by ``scale``: norms of coordinates that move by
    amounts less unlike bound stress more narrowly.
    """

    scale: Single  #: (m,)
    spread: Array  #: (m,) how far landings move each of coordinates / scale
    shell_rows: Single  #: (n_shells, 6, m) rows whose squares sum to von Mises, two faces
    beam_rows: Single  #: (n_beams, 6, m) five rows of normal stress, sqrt(3) times the shear
    beam_points: Single  #: (n_beams, 8, 5) normal stress of the points from the five rows
    pattern_counts: IntArray  #: (blocks,)
    patterns: Single  #: (sum of the counts, m) of the coordinates
    shares: Single  #: block by block
    shell_squares: Single  #: (n_shells, 2) see `StressBlock`
    beam_squares: Single  #: (n_beams, 8) see `StressBlock`
    dropped: Single  #: (n_shells + n_beams,) see `StressBlock`

    @property
    def element_count(self) -> int:
        """Number of elements, shells first."""
        return len(self.shell_rows) + len(self.beam_rows)

    def blocks(self) -> Iterator[StressBlock]:
        """Yield blocks in the order of the elements."""
        no_points = np.zeros((len(self.shell_rows), 0, 5), dtype=np.float32)
        counts = iter(self.pattern_counts.tolist())
        element = pattern = share = 0
        for rows, points, squares in (
            (self.shell_rows, no_points, self.shell_squares),
            (self.beam_rows, self.beam_points, self.beam_squares),
        ):
            for start in range(0, len(rows), BLOCK):
                part = slice(start, start + BLOCK)
                exact = np.asarray(rows[part])
                height, count = 6 * len(exact), next(counts)
                shares = self.shares[share : share + height * count]
                yield StressBlock(
                    rows=exact,
                    points=np.asarray(points[part]),
                    patterns=slice(pattern, pattern + count),
                    shares=np.asarray(shares).reshape(height, count),
                    squares=np.asarray(squares[part]),
                    dropped=np.asarray(self.dropped[element : element + len(exact)]),
                )
                element, pattern = element + len(exact), pattern + count
                share += height * count


def no_stress(size: int) -> ReducedStress:
    """Stress of no element at all, for models of the motion alone."""
    rows = np.zeros((0, 6, size), dtype=np.float32)
    return ReducedStress(
        scale=np.ones(size, dtype=np.float32),
        spread=np.ones(size),
        shell_rows=rows,
        beam_rows=rows,
        beam_points=np.zeros((0, 8, 5), dtype=np.float32),
        pattern_counts=np.zeros(0, dtype=np.int64),
        patterns=np.zeros((0, size), dtype=np.float32),
        shares=np.zeros(0, dtype=np.float32),
        shell_squares=np.zeros((0, 2), dtype=np.float32),
        beam_squares=np.zeros((0, 8), dtype=np.float32),
        dropped=np.zeros(0, dtype=np.float32),
    )
