"""What bounds every element alike in the search for peaks: when to look, and what lies between.

Time is cut into intervals of 4 to 32 samples, short where the coordinates leave the straight line
between two ends.  The deviation from the lines is split into its principal directions and a rest.
"""

import math
from dataclasses import dataclass
from typing import Any

import numba
import numpy as np

from solver.arrays import Array, IntArray, Single

#: Samples of the longest and shortest intervals that are looked at as a whole, powers of two.
LONGEST, SHORTEST = 32, 4
#: Halvings from the longest interval to one of two samples.
LEVELS = 5
#: Deviation that an interval may have to stay whole, share of the largest norm of coordinates.
DEVIATION = 0.06
#: Principal directions of deviation.
LEADING_DIRECTIONS = 64
#: Directions that are sought at random beyond those, to find those well.
_OVERSAMPLING = 16
#: Samples whose deviation is smaller than this share of the largest do not choose directions.
_CALM = 1e-2
#: Square of the share of a deviation that rounding may hide from the rest.
_ROUNDING = np.float32(1e-6)
_ZERO = np.float32(0.0)
_FAST = {"contract", "reassoc", "nsz"}


@dataclass(frozen=True, slots=True)
class SearchPlan:
    """Samples are padded with the last one to n + 1; ni intervals with knots at their ends."""

    coordinates: Single  #: (n + 1, m) at every sample
    knots: IntArray  #: (ni + 1,) samples
    at_knots: Single  #: (m, ni + 1) coordinates
    knot_deviation: Single  #: (ni,) bound of the norm of the deviation between two knots
    directions: Single  #: (m, k) orthonormal, leading directions of deviation
    deviation: Single  #: (n, k) along the directions, from the line between the knots
    rest: Single  #: (n,) norm of the deviation in all other directions
    #: (LEVELS, n / 2, k + 2) for every aligned interval of 32, 16, ... samples the largest
    #: deviation from the line across it, along each direction and of the rest; last, their norm
    largest: Single
    spread_norms: Single  #: (ni + 1,) norm of coordinates / spread at the knots
    spread_deviation: Single  #: (ni,) largest norm of deviation / spread between two knots


def plan_search(coordinates: Single, spread: Array) -> SearchPlan:
    """Prepare the search in a history (nt, m) of coordinates that move by ``spread`` (m,)."""
    count, size = coordinates.shape
    length = max(1, -(-(count - 1) // LONGEST)) * LONGEST
    padded = np.empty((length + 1, size), dtype=np.float32)
    padded[:count], padded[count:] = coordinates, coordinates[-1]
    squares = np.empty((LEVELS, length), dtype=np.float32)
    _line_distances(padded, squares)
    largest_norm = float(np.einsum("ij,ij->i", padded, padded).max())
    knots = _knots(squares, DEVIATION**2 * largest_norm)
    deviation = _deviation(padded, knots)
    deviated = np.einsum("ij,ij->i", deviation, deviation)
    lively = deviation[deviated > _CALM**2 * deviated.max()]
    directions = _principal(lively, min(size, LEADING_DIRECTIONS))
    along = padded @ directions
    along_deviation = _deviation(along, knots)
    rest = np.empty(length, dtype=np.float32)
    _rest(along_deviation, deviated, rest)
    largest = np.zeros((LEVELS, length // 2, along.shape[1] + 2), dtype=np.float32)
    _largest(along, squares, largest)
    lengths = np.diff(knots)
    level = np.round(np.log2(LONGEST / lengths)).astype(np.int64)
    inverse = (1.0 / spread).astype(np.float32)
    at_knots = padded[knots]
    return SearchPlan(
        coordinates=padded,
        knots=knots,
        at_knots=np.ascontiguousarray(at_knots.T),
        knot_deviation=np.ascontiguousarray(largest[level, knots[:-1] // lengths, -1]),
        directions=np.ascontiguousarray(directions),
        deviation=along_deviation,
        rest=rest,
        largest=largest,
        spread_norms=np.linalg.norm(at_knots * inverse, axis=1),
        spread_deviation=np.maximum.reduceat(
            np.linalg.norm(deviation * inverse, axis=1), knots[:-1]
        ),
    )


def _principal(deviation: Single, count: int) -> Single:
    """Orthonormal directions (m, count) that carry most of a deviation (n, m).

    Randomised subspace iteration (Halko, Martinsson and Tropp, 2011, algorithm 4.4); any
    orthonormal directions serve, good ones leave less to do.
    """
    width = min(deviation.shape[1], count + _OVERSAMPLING)
    sketch = np.random.default_rng(1).standard_normal((len(deviation), width), dtype=np.float32)
    basis = np.linalg.qr(deviation.T @ sketch)[0]
    basis = np.linalg.qr(deviation.T @ (deviation @ basis))[0]
    projected = deviation @ basis
    directions = np.linalg.eigh((projected.T @ projected).astype(np.float64))[1]
    leading: Single = basis @ directions[:, ::-1][:, :count].astype(np.float32)
    return leading


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
def _knots(squares: Single, limit: float) -> IntArray:  # pragma: no cover - compiled
    """Find the longest aligned intervals whose squared distances stay below ``limit``."""
    count = squares.shape[1]
    knots = np.empty(count // SHORTEST + 1, dtype=np.int64)
    found, start = 0, 0
    while start < count:
        level, step = 0, LONGEST
        while step > SHORTEST and (
            start % step != 0 or squares[level, start : start + step].max() > limit
        ):
            level, step = level + 1, step >> 1
        knots[found] = start
        found, start = found + 1, start + step
    knots[found] = count
    return knots[: found + 1]


@numba.njit(cache=True, fastmath=_FAST)
def _deviation(history: Single, knots: IntArray) -> Single:  # pragma: no cover - compiled
    """Distance (n, k) of a history (n + 1, k) from the lines between its knots."""
    out = np.zeros((len(history) - 1, history.shape[1]), dtype=np.float32)
    for i in range(len(knots) - 1):
        start, stop = knots[i], knots[i + 1]
        for t in range(start + 1, stop):
            share = np.float32((t - start) / (stop - start))
            for k in range(history.shape[1]):
                left, right = history[start, k], history[stop, k]
                out[t, k] = history[t, k] - (left + share * (right - left))
    return out


@numba.njit(cache=True, fastmath=_FAST)
def _rest(along: Single, squares: Single, out: Single) -> None:  # pragma: no cover - compiled
    """Norm (n,) of what a deviation of given squared norm (n,) has beside ``along`` (n, k)."""
    for t in range(len(out)):
        left: Any = squares[t]
        for k in range(along.shape[1]):
            left -= along[t, k] * along[t, k]
        out[t] = math.sqrt((left if left > _ZERO else _ZERO) + _ROUNDING * squares[t])


@numba.njit(cache=True, fastmath=_FAST)
def _largest(along: Single, squares: Single, out: Single) -> None:  # pragma: no cover - compiled
    """Fill `SearchPlan.largest` from the coordinates (n + 1, k) along the directions."""
    count = along.shape[1]
    deviation = np.empty(count, dtype=np.float32)
    for level in range(LEVELS):
        step = LONGEST >> level
        for i in range(squares.shape[1] // step):
            start = i * step
            for t in range(start + 1, start + step):
                share = np.float32((t - start) / step)
                left: Any = squares[level, t]
                for k in range(count):
                    line = along[start, k] + share * (along[start + step, k] - along[start, k])
                    deviation[k] = abs(along[t, k] - line)
                    left -= deviation[k] * deviation[k]
                    if deviation[k] > out[level, i, k]:
                        out[level, i, k] = deviation[k]
                left = math.sqrt((left if left > _ZERO else _ZERO) + _ROUNDING * squares[level, t])
                if left > out[level, i, count]:
                    out[level, i, count] = left
            everything: Any = _ZERO
            for k in range(count + 1):
                everything += out[level, i, k] * out[level, i, k]
            out[level, i, count + 1] = math.sqrt(everything)
