"""Patterns of a block of elements over time: everywhere, at the knots, and off the lines between.

From the grid's samples to all others they follow cubics, see `SearchPlan`.
"""

import math
from typing import Any

import numba
import numpy as np

from solver.arrays import IntArray, Single

_ZERO = np.float32(0.0)
_FAST = {"contract", "reassoc", "nsz"}


@numba.njit(cache=True, fastmath=_FAST)
def fill_patterns(
    at_grid: Single,
    support: IntArray,
    weights: Single,
    knots: IntArray,
    edges: IntArray,
    leading: int,
    history: Single,
    at_knots: Single,
    rise: Single,
    others: Single,
) -> None:  # pragma: no cover - compiled
    """Patterns at every sample, and how far they leave the straight lines between knots.

    Parameters
    ----------
    at_grid : (ng, r) array
        Patterns at the samples of the grid.
    support, weights, knots : arrays
        See `SearchPlan`.
    edges : (groups + 1,) array
        First patterns of each group.
    leading : int
        Number of the leading groups.
    history : (n + 1, r) array
        Filled with the patterns.
    at_knots : (ni + 1, patterns of the leading groups) array
        Filled with the leading ones at the knots.
    rise : (ni, groups) array
        Filled with a bound of the norm, group by group, of the deviation within an interval.
    others : (ni + 1, groups - leading) array
        Filled with the norms of the groups that do not lead, at the knots.
    """
    count = at_grid.shape[1]
    for t in range(len(history)):
        first = support[t]
        if weights.shape[1] == 4:
            w0, w1, w2, w3 = weights[t, 0], weights[t, 1], weights[t, 2], weights[t, 3]
            for k in range(count):
                history[t, k] = (
                    w0 * at_grid[first, k]
                    + w1 * at_grid[first + 1, k]
                    + w2 * at_grid[first + 2, k]
                    + w3 * at_grid[first + 3, k]
                )
        else:
            for k in range(count):
                history[t, k] = _ZERO
            for i in range(weights.shape[1]):
                for k in range(count):
                    history[t, k] += weights[t, i] * at_grid[first + i, k]
    for i in range(len(knots)):
        knot = knots[i]
        for k in range(edges[leading]):
            at_knots[i, k] = history[knot, k]
        for g in range(leading, len(edges) - 1):
            other: Any = _ZERO
            for k in range(edges[g], edges[g + 1]):
                other += history[knot, k] * history[knot, k]
            others[i, g - leading] = math.sqrt(other)
    farthest = np.empty(count, dtype=np.float32)
    for i in range(len(knots) - 1):
        start, stop = knots[i], knots[i + 1]
        for k in range(count):
            farthest[k] = _ZERO
        for t in range(start + 1, stop):
            share = np.float32((t - start) / (stop - start))
            for k in range(count):
                left, right = history[start, k], history[stop, k]
                away = abs(history[t, k] - (left + share * (right - left)))
                farthest[k] = away if away > farthest[k] else farthest[k]
        for g in range(len(edges) - 1):
            total: Any = _ZERO
            for k in range(edges[g], edges[g + 1]):
                total += farthest[k] * farthest[k]
            rise[i, g] = math.sqrt(total)
