"""Stress of every element in reduced coordinates: exact rows, and the same compressed by blocks.

Elements next to each other follow the same motion, so the rows of a block of elements factor into
a few patterns, combinations of the coordinates that move most, and the share that each row takes
of them.  What the factors leave out is bounded for every element, by groups of coordinates that
move alike: the factors are for choosing what to look at, and what is reported comes from the exact
rows.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from solver.arrays import IntArray, Short, Single
from solver.inertia_relief.rounded_rows import RoundedRows

#: Elements of a block.
BLOCK = 256
#: Members of a group of coordinates and of a group of patterns at most.
COORDINATE_GROUP, PATTERN_GROUP = 32, 16


@dataclass(frozen=True, slots=True)
class StressBlock:
    """Some elements of one kind; n elements, m coordinates, r patterns."""

    rows: RoundedRows  #: see `StressRows`
    points: Single  #: (n, 8, 5) of beams, (n, 0, 5) of shells
    patterns: Single  #: (r, h) of the last h coordinates
    leading: int  #: patterns that suffice for an estimate
    shares: Single  #: (6 n, r) of the patterns
    pattern_norms: Single  #: (n, groups of the most patterns) see `ReducedStress`
    rest_norms: Single  #: (n, 2 * groups) see `ReducedStress`

    def compressed_part(self, elements: IntArray) -> "StressBlock":
        """Return the block with the compressed rows of some elements; the exact rows stay."""
        rank = self.shares.shape[1]
        return replace(
            self,
            points=self.points[elements],
            shares=self.shares.reshape(-1, 6, rank)[elements].reshape(-1, rank),
            pattern_norms=self.pattern_norms[elements],
            rest_norms=self.rest_norms[elements],
        )


@dataclass(frozen=True, slots=True)
class ReducedStress:
    """All blocks, shells first, in arrays that can be mapped from files.

    Everything here is for coordinates divided by ``scale``: differences of coordinates that move
    by amounts less unlike tell better where the stress is curved in time.  Norms are the largest
    stress, of both faces or of all points, that unit norm of a group of amplitudes can cause;
    `group_edges` says which groups.
    """

    scale: Single  #: (m,)
    #: (n_shells, 6, m), (n_shells, 6) rows whose squares sum to von Mises, two faces
    shell_numbers: Short
    shell_step: Single
    #: (n_beams, 6, m), (n_beams, 6) five rows of normal stress, sqrt(3) times the shear
    beam_numbers: Short
    beam_step: Single
    beam_points: Single  #: (n_beams, 8, 5) normal stress of the points from the five rows
    pattern_shapes: IntArray  #: (blocks, 3) patterns, coordinates (the last ones), leading patterns
    patterns: Single  #: block by block
    shares: Single  #: block by block
    pattern_norms: Single  #: (ne, groups of the most patterns) stress from groups of patterns
    #: (ne, 2 * groups of m) stress from groups of coordinates: what the factors leave out, then
    #: what they hold
    rest_norms: Single

    @property
    def element_count(self) -> int:
        """Number of elements, shells first."""
        return len(self.shell_step) + len(self.beam_step)

    @property
    def shell_rows(self) -> RoundedRows:
        """Rows of the shells."""
        return RoundedRows(np.asarray(self.shell_numbers), np.asarray(self.shell_step))

    @property
    def beam_rows(self) -> RoundedRows:
        """Rows of the beams."""
        return RoundedRows(np.asarray(self.beam_numbers), np.asarray(self.beam_step))

    def blocks(self) -> Iterator[StressBlock]:
        """Yield blocks in the order of the elements."""
        # plain views once: slices of mapped files cost more than what is done with small ones
        every_share, every_pattern = np.asarray(self.shares), np.asarray(self.patterns)
        pattern_norms, rest_norms = np.asarray(self.pattern_norms), np.asarray(self.rest_norms)
        no_points = np.zeros((len(self.shell_step), 0, 5), dtype=np.float32)
        shapes = iter(self.pattern_shapes.tolist())
        element = pattern = share = 0
        for rows, points in (
            (self.shell_rows, no_points),
            (self.beam_rows, np.asarray(self.beam_points)),
        ):
            for start in range(0, len(rows), BLOCK):
                part = slice(start, start + BLOCK)
                exact = rows[part]
                height, (count, known, leading) = 6 * len(exact), next(shapes)
                elements = slice(element, element + len(exact))
                yield StressBlock(
                    rows=exact,
                    points=points[part],
                    patterns=every_pattern[pattern : pattern + count * known].reshape(count, known),
                    leading=leading,
                    shares=every_share[share : share + height * count].reshape(height, count),
                    pattern_norms=pattern_norms[elements],
                    rest_norms=rest_norms[elements],
                )
                element, pattern = element + len(exact), pattern + count * known
                share += height * count


def group_edges(count: int, widest: int = COORDINATE_GROUP) -> IntArray:
    """First members of groups of ``count`` amplitudes, the most important first: 1, 1, 2, 4...

    Returns
    -------
    (groups + 1,) array
        From 0 to ``count``; no group has more than ``widest`` members.
    """
    edges = [0]
    while edges[-1] < count:
        edges.append(min(count, edges[-1] + min(max(1, edges[-1]), widest)))
    return np.array(edges, dtype=np.int64)


def no_stress(size: int) -> ReducedStress:
    """Stress of no element at all, for models of the motion alone."""
    rows, step = np.zeros((0, 6, size), dtype=np.int16), np.zeros((0, 6), dtype=np.float32)
    return ReducedStress(
        scale=np.ones(size, dtype=np.float32),
        shell_numbers=rows,
        shell_step=step,
        beam_numbers=rows,
        beam_step=step,
        beam_points=np.zeros((0, 8, 5), dtype=np.float32),
        pattern_shapes=np.zeros((0, 3), dtype=np.int64),
        patterns=np.zeros(0, dtype=np.float32),
        shares=np.zeros(0, dtype=np.float32),
        pattern_norms=np.zeros((0, 0), dtype=np.float32),
        rest_norms=np.zeros((0, 2 * (len(group_edges(size)) - 1)), dtype=np.float32),
    )
