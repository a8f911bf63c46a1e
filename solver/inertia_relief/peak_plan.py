"""What bounds every element alike in the search for peaks: when to look, and what lies between.

Time is cut twice, short where the coordinates leave the straight line between two ends.  At the
*grid* the patterns of stress are found, and between its samples they follow cubics.  At the coarser
*knots*, some of the grid, the stress of every element is estimated, and from one knot to the next
it is bounded.
"""

from dataclasses import dataclass
from typing import Any

import numba
import numpy as np

from solver.arrays import IntArray, Single
from solver.inertia_relief.reduced_stress import group_edges

#: Samples of the longest interval and of the shortest between knots, powers of two.
LONGEST, SHORTEST = 32, 4
#: Halvings from the longest interval to one of two samples.
LEVELS = 5
#: Deviation from the straight line that an interval between knots may have to stay whole, share
#: of the largest norm of coordinates; and one between samples of the grid.
DEVIATION, GRID_DEVIATION = 0.07, 0.03
_ZERO = np.float32(0.0)
_FAST = {"contract", "reassoc", "nsz"}


@dataclass(frozen=True, slots=True)
class SearchPlan:
    """Samples are padded with the last one to n + 1; ni intervals with knots at their ends."""

    coordinates: Single  #: (n + 1, m) at every sample
    at_grid: Single  #: (ng, m) at the samples of the grid
    support: IntArray  #: (n + 1,) first of the samples of the grid that a sample is found from
    weights: Single  #: (n + 1, 4 or 2) of those
    knots: IntArray  #: (ni + 1,) samples
    #: (n + 1, 2 * groups) norm of each group of coordinates, then of their distance from what the
    #: grid says
    norms: Single
    largest: Single  #: (2 * groups, ni) of those within an interval, both ends included

    def window(self, begin: int, end: int) -> "SearchPlan":
        """Return the plan of the intervals from ``begin`` before ``end`` alone."""
        samples = slice(int(self.knots[begin]), int(self.knots[end]) + 1)
        support = self.support[samples]
        first, last = int(support[0]), int(support[-1]) + self.weights.shape[1]
        return SearchPlan(
            coordinates=self.coordinates[samples],
            at_grid=self.at_grid[first:last],
            support=support - first,
            weights=self.weights[samples],
            knots=self.knots[begin : end + 1] - samples.start,
            norms=self.norms[samples],
            largest=self.largest[:, begin:end],
        )


def plan_search(coordinates: Single) -> SearchPlan:
    """Prepare the search in a history (nt, m) of coordinates."""
    count, size = coordinates.shape
    length = max(1, -(-(count - 1) // LONGEST)) * LONGEST
    padded = np.empty((length + 1, size), dtype=np.float32)
    padded[:count], padded[count:] = coordinates, coordinates[-1]
    squares = np.empty((LEVELS, length), dtype=np.float32)
    _line_distances(padded, squares)
    largest_norm = float(np.einsum("ij,ij->i", padded, padded).max())
    knots = _cut(squares, DEVIATION**2 * largest_norm, SHORTEST)
    grid = _cut(squares, GRID_DEVIATION**2 * largest_norm, 1)
    support, weights = _interpolation(grid, min(4, len(grid)))
    at_grid = padded[grid]
    norms = np.empty((length + 1, 2 * (len(group_edges(size)) - 1)), dtype=np.float32)
    _group_norms(padded, at_grid, support, weights, group_edges(size), norms)
    inside = np.maximum.reduceat(norms[:-1], knots[:-1], axis=0)
    return SearchPlan(
        coordinates=padded,
        at_grid=at_grid,
        support=support,
        weights=weights,
        knots=knots,
        norms=norms,
        largest=np.ascontiguousarray(np.maximum(inside, norms[knots[1:]]).T),
    )


@numba.njit(cache=True, fastmath=_FAST)
def _line_distances(coordinates: Single, out: Single) -> None:  # pragma: no cover - compiled
    """Squared distances (LEVELS, n) from the lines across intervals of every length."""
    size = coordinates.shape[1]
    for level in range(LEVELS):
        step = LONGEST >> level
        for start in range(0, out.shape[1], step):
            out[level, start] = _ZERO
            for j in range(1, step):
                share = np.float32(j / step)
                total: Any = _ZERO
                for k in range(size):
                    left, right = coordinates[start, k], coordinates[start + step, k]
                    distance = coordinates[start + j, k] - (left + share * (right - left))
                    total += distance * distance
                out[level, start + j] = total


@numba.njit(cache=True)
def _cut(squares: Single, limit: float, shortest: int) -> IntArray:  # pragma: no cover - compiled
    """Find the longest aligned intervals whose squared distances stay below ``limit``."""
    count = squares.shape[1]
    ends = np.empty(count // shortest + 1, dtype=np.int64)
    found, start = 0, 0
    while start < count:
        level, step = 0, LONGEST
        while step > shortest and (
            start % step != 0 or squares[level, start : start + step].max() > limit
        ):
            level, step = level + 1, step >> 1
        ends[found] = start
        found, start = found + 1, start + step
    ends[found] = count
    return ends[: found + 1]


@numba.njit(cache=True)
def _interpolation(
    grid: IntArray, points: int
) -> tuple[IntArray, Single]:  # pragma: no cover - compiled
    """Lagrange's polynomials through the nearest ``points`` samples, see `SearchPlan`."""
    count = grid[-1] + 1
    support = np.empty(count, dtype=np.int64)
    weights = np.empty((count, points), dtype=np.float32)
    interval = 0
    for t in range(count):
        while interval < len(grid) - 2 and grid[interval + 1] <= t:
            interval += 1
        first = min(max(0, interval - (points // 2 - 1)), len(grid) - points)
        support[t] = first
        for i in range(points):
            weight = 1.0
            for j in range(points):
                if j != i:
                    weight *= (t - grid[first + j]) / (grid[first + i] - grid[first + j])
            weights[t, i] = weight
    return support, weights


@numba.njit(cache=True, fastmath=_FAST)
def _group_norms(
    history: Single,
    at_grid: Single,
    support: IntArray,
    weights: Single,
    edges: IntArray,
    out: Single,
) -> None:  # pragma: no cover - compiled
    """Norms (n + 1, 2 * groups) of groups of a history and of its distance from the grid's."""
    count, size = history.shape
    groups = len(edges) - 1
    distance = np.empty(size, dtype=np.float32)
    for t in range(count):
        for k in range(size):
            distance[k] = -history[t, k]
        for i in range(weights.shape[1]):
            weight, sample = weights[t, i], support[t] + i
            for k in range(size):
                distance[k] += weight * at_grid[sample, k]
        for g in range(groups):
            # groups count from the most moved coordinate, the last one
            first, last = size - edges[g + 1], size - edges[g]
            moved: Any = _ZERO
            off: Any = _ZERO
            for k in range(first, last):
                moved += history[t, k] * history[t, k]
                off += distance[k] * distance[k]
            out[t, g] = np.sqrt(moved)
            out[t, groups + g] = np.sqrt(off)
