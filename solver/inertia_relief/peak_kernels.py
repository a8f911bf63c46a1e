"""Compiled inner loops of the peak search: bounds, and evaluation where they do not suffice.

Between two coarse samples the stress rows of an element are a straight line, plus the deviation
along its leading directions, plus a small rest.  Intervals are halved while their bound reaches
the best value so far; in their middle the first two parts are cheap to evaluate and the rest is
bounded; only where both together reach the best value are all coordinates evaluated.
"""

import math
from typing import Any

import numba
import numpy as np

from solver.arrays import Array, IntArray
from solver.inertia_relief.reduced import Single

#: Samples between two coarse ones, a power of two.
STEP = 8
#: Times that an interval can be halved.
LEVELS = 3
#: Covers the rounding of single precision in comparing a bound with a value.
_MARGIN = np.float32(1.0001)
_ZERO = np.float32(0.0)
_FAST = {"contract", "reassoc", "nsz"}


@numba.njit(cache=True, fastmath=_FAST)
def _squares(rows: Single, points: Single, out: Single) -> None:  # pragma: no cover
    """Squares of von Mises stress by measure and column.

    ``rows`` (6, k) gives ``out`` (p, k): both faces of a shell, or the eight points of a beam.
    """
    count = rows.shape[1]
    if points.shape[0] == 0:
        for face in range(2):
            for k in range(count):
                a, b, c = rows[3 * face, k], rows[3 * face + 1, k], rows[3 * face + 2, k]
                out[face, k] = a * a + b * b + c * c
        return
    for i in range(points.shape[0]):
        a, b, c, d, e = points[i, 0], points[i, 1], points[i, 2], points[i, 3], points[i, 4]
        for k in range(count):
            normal = a * rows[0, k] + b * rows[1, k] + c * rows[2, k] + d * rows[3, k]
            normal += e * rows[4, k]
            out[i, k] = normal * normal + rows[5, k] * rows[5, k]


@numba.njit(cache=True, fastmath=_FAST)
def _measure(
    s0: float, s1: float, s2: float, s3: float, s4: float, s5: float, points: Single
) -> float:  # pragma: no cover - compiled
    """Von Mises stress from the six rows of one element."""
    if points.shape[0] == 0:
        bottom = s0 * s0 + s1 * s1 + s2 * s2
        top = s3 * s3 + s4 * s4 + s5 * s5
        return math.sqrt(top if top > bottom else bottom)
    best: Any = _ZERO
    for i in range(points.shape[0]):
        normal = points[i, 0] * s0 + points[i, 1] * s1 + points[i, 2] * s2 + points[i, 3] * s3
        normal += points[i, 4] * s4
        square = normal * normal
        best = square if square > best else best
    return math.sqrt(best + s5 * s5)


@numba.njit(cache=True, fastmath=_FAST)
def _stress(
    rows: Single, coordinates: Single, base: Single, points: Single
) -> float:  # pragma: no cover - compiled
    """Von Mises stress of one element from ``base`` (6,) and rows (6, k) times coordinates."""
    s0 = s1 = s2 = s3 = s4 = s5 = _ZERO
    for k in range(len(coordinates)):
        z = coordinates[k]
        s0 += rows[0, k] * z
        s1 += rows[1, k] * z
        s2 += rows[2, k] * z
        s3 += rows[3, k] * z
        s4 += rows[4, k] * z
        s5 += rows[5, k] * z
    return _measure(
        base[0] + s0, base[1] + s1, base[2] + s2, base[3] + s3, base[4] + s4, base[5] + s5, points
    )


@numba.njit(cache=True, fastmath=_FAST)
def _direction_norms(squares: Single, total: Single, out: Single) -> None:  # pragma: no cover
    """Largest stress for unit norm along each leading direction (k,), then in all others.

    ``squares`` (p, k) are those of the leading directions, ``total`` (p,) of all coordinates.
    """
    count = squares.shape[1]
    for k in range(count + 1):
        out[k] = _ZERO
    for i in range(len(total)):
        left = total[i] * _MARGIN
        for k in range(count):
            left -= squares[i, k]
        out[count] = left if left > out[count] else out[count]
        for k in range(count):
            out[k] = squares[i, k] if squares[i, k] > out[k] else out[k]
    for k in range(count + 1):
        out[k] = math.sqrt(out[k])


@numba.njit(cache=True, fastmath=_FAST)
def _interval_bounds(
    norms: Single, deviation: Single, values: Single, out: Single
) -> None:  # pragma: no cover - compiled
    """Bounds (ni,) of every interval between coarse samples; ``deviation`` (k, ni)."""
    for i in range(len(out)):
        out[i] = values[i] if values[i] > values[i + 1] else values[i + 1]
    for k in range(len(norms)):
        for i in range(len(out)):
            out[i] += norms[k] * deviation[k, i]
    for i in range(len(out)):
        out[i] *= _MARGIN


@numba.njit(cache=True, fastmath=_FAST)
def _interval_bound(norms: Single, largest: Single) -> float:  # pragma: no cover - compiled
    """How far the stress can rise above the line between an interval's ends."""
    total: Any = _ZERO
    for k in range(len(norms)):
        total += norms[k] * largest[k]
    rise: float = total
    return rise


@numba.njit(cache=True)
def search_block(
    operator: Single,
    total: Single,
    points: Single,
    coarse_rows: Single,
    leading_rows: Single,
    coordinates: Single,
    deviation: Single,
    rest: Single,
    coarse_largest: Single,
    largest: Single,
    stress: Array,
    sample: IntArray,
) -> int:  # pragma: no cover - compiled
    """Find the peak of every element of a block; return how many samples were evaluated.

    Parameters
    ----------
    operator : (n, 6, m) array
        Stress rows [Pa].
    total : (n, p) array
        Sum over the coordinates of the squares of each measure, see `_squares`.
    points : (n, 8, 5) array
        Normal stress of a beam's points from its first five rows; (n, 0, 5) for shells.
    coarse_rows : (n, 6, ni + 1) array
        Stress at the coarse samples.
    leading_rows : (n, 6, k) array
        Stress in the leading directions of deviation.
    coordinates : (ni STEP + 1, m) array
        At every sample.
    deviation : (ni STEP, k) array
        Deviation of every sample from the straight line between coarse ones, leading directions.
    rest : (ni STEP,) array
        Norm of that deviation in all other directions.
    coarse_largest : (k + 1, ni) array
        Largest deviation between coarse samples along each leading direction and, last, of the
        rest.
    largest : (LEVELS, ni STEP / 2, k + 1) array
        The same between the ends of every interval, of its halves, and so on to two samples.
    stress, sample : (n,) arrays
        Filled with peak and sample.
    """
    count, _, coarse_count = coarse_rows.shape
    directions, measures = leading_rows.shape[2], total.shape[1]
    leading_squares = np.empty((measures, directions), dtype=np.float32)
    coarse_squares = np.empty((measures, coarse_count), dtype=np.float32)
    values = np.empty(coarse_count, dtype=np.float32)
    bounds = np.empty(coarse_count - 1, dtype=np.float32)
    norms = np.empty(directions + 1, dtype=np.float32)
    nothing = np.zeros(6, dtype=np.float32)
    line = np.empty(6, dtype=np.float32)
    # intervals still to be looked at: level, index, bounds of the stress at both ends
    pending = np.empty((LEVELS + 2, 2), dtype=np.int64)
    ends = np.empty((LEVELS + 2, 2), dtype=np.float32)
    evaluated = 0
    for e in range(count):
        _squares(coarse_rows[e], points[e], coarse_squares)
        for i in range(coarse_count):
            square = coarse_squares[0, i]
            for j in range(1, measures):
                square = coarse_squares[j, i] if coarse_squares[j, i] > square else square
            values[i] = math.sqrt(square)
        _squares(leading_rows[e], points[e], leading_squares)
        _direction_norms(leading_squares, total[e], norms)
        _interval_bounds(norms, coarse_largest, values, bounds)
        best, where, highest = values[0], 0, 0
        for i in range(1, coarse_count):
            if values[i] > best:
                best, where = values[i], i * STEP
        for i in range(coarse_count - 1):
            if bounds[i] > bounds[highest]:
                highest = i
        for turn in range(-1, coarse_count - 1):  # the most promising interval comes first
            i = highest if turn < 0 else turn
            if bounds[i] <= best or turn == highest:
                continue
            depth = 1
            pending[0, 0], pending[0, 1] = 0, i
            ends[0, 0], ends[0, 1] = values[i], values[i + 1]
            while depth > 0:
                depth -= 1
                level, index = pending[depth, 0], pending[depth, 1]
                left, right = ends[depth, 0], ends[depth, 1]
                larger = left if left > right else right
                rise = _interval_bound(norms, largest[level, index])
                if (larger + rise) * _MARGIN <= best:
                    continue
                width = STEP >> level
                middle = index * width + (width >> 1)
                share = np.float32((middle - i * STEP) / STEP)
                for row in range(6):
                    start = coarse_rows[e, row, i]
                    line[row] = start + share * (coarse_rows[e, row, i + 1] - start)
                value: Any = _stress(leading_rows[e], deviation[middle], line, points[e])
                value = np.float32(value + norms[directions] * rest[middle])
                if value * _MARGIN > best:
                    value = np.float32(
                        _stress(operator[e], coordinates[middle], nothing, points[e])
                    )
                    evaluated += 1
                    if value > best:
                        best, where = value, middle
                if level + 1 < LEVELS:
                    pending[depth, 0], pending[depth, 1] = level + 1, 2 * index
                    ends[depth, 0], ends[depth, 1] = left, value
                    pending[depth + 1, 0], pending[depth + 1, 1] = level + 1, 2 * index + 1
                    ends[depth + 1, 0], ends[depth + 1, 1] = value, right
                    depth += 2
        stress[e] = best
        sample[e] = where
    return evaluated
