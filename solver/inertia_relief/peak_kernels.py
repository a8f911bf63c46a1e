"""Compiled inner loops of the peak search: bounds, and evaluation where they do not suffice.

Between two knots the stress rows of an element are a straight line, plus the deviation along its
leading directions, plus a small rest.  Intervals are halved while their bound reaches the best
value so far; in their middle the first two parts are cheap to evaluate and the rest is bounded;
only where both together reach the best value is the exact stress evaluated.
"""

import math
from typing import Any

import numba
import numpy as np

from solver.arrays import Array, IntArray, Single
from solver.inertia_relief.peak_plan import LEVELS, LONGEST

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
def _values(rows: Single, points: Single, out: Single) -> None:  # pragma: no cover - compiled
    """Von Mises stress (k,) from the rows (6, k) of one element, larger face or highest point."""
    count = len(out)
    if points.shape[0] == 0:
        for k in range(count):
            a, b, c = rows[0, k], rows[1, k], rows[2, k]
            bottom = a * a + b * b + c * c
            a, b, c = rows[3, k], rows[4, k], rows[5, k]
            top = a * a + b * b + c * c
            out[k] = top if top > bottom else bottom
    else:
        for k in range(count):
            out[k] = _ZERO
        for i in range(points.shape[0]):
            p0, p1, p2, p3, p4 = (
                points[i, 0],
                points[i, 1],
                points[i, 2],
                points[i, 3],
                points[i, 4],
            )
            for k in range(count):
                normal = p0 * rows[0, k] + p1 * rows[1, k] + p2 * rows[2, k] + p3 * rows[3, k]
                normal += p4 * rows[4, k]
                square = normal * normal
                out[k] = square if square > out[k] else out[k]
        for k in range(count):
            out[k] += rows[5, k] * rows[5, k]
    for k in range(count):
        out[k] = math.sqrt(out[k])


@numba.njit(cache=True, fastmath=_FAST)
def _bounds(
    values: Single, deviation: Single, norm: float, between: Single, dropped: float, out: Single
) -> None:  # pragma: no cover - compiled
    """Cheap bounds (ni,) of the stress between knots, from norms of everything that deviates."""
    for i in range(len(out)):
        larger = values[i] if values[i] > values[i + 1] else values[i + 1]
        out[i] = (larger + norm * deviation[i] + dropped * between[i]) * _MARGIN


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
    The last of ``out`` (k + 2,) is the norm of the others.
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
    everything: Any = _ZERO
    for k in range(count + 1):
        everything += out[k]
        out[k] = math.sqrt(out[k])
    out[count + 1] = math.sqrt(everything)


@numba.njit(cache=True, fastmath=_FAST)
def _rise(norms: Single, largest: Single) -> float:  # pragma: no cover - compiled
    """How far the stress can rise above the line between an interval's ends."""
    total: Any = _ZERO
    for k in range(len(norms) - 1):
        total += norms[k] * largest[k]
    rise: float = total
    return rise


@numba.njit(cache=True)
def search_block(
    operator: Single,
    points: Single,
    total: Single,
    dropped: Single,
    beside: Single,
    between: Single,
    rows: Single,
    leading: Single,
    coordinates: Single,
    knots: IntArray,
    knot_deviation: Single,
    deviation: Single,
    rest: Single,
    largest: Single,
    stress: Array,
    sample: IntArray,
) -> int:  # pragma: no cover - compiled
    """Find the peak of every element of a block; return how many samples were evaluated.

    Parameters
    ----------
    operator : (n, 6, m) array
        Exact stress rows [Pa].
    points : (n, 8, 5) array
        Normal stress of a beam's points from its first five rows; (n, 0, 5) for shells.
    total : (n, p) array
        Sum over the coordinates of the squares of each measure, see `measure_squares`.
    dropped : (n,) array
        See `StressBlock`.
    beside : (ni + 1,) array
        Norm of coordinates / spread that compression leaves out, at the knots.
    between : (ni,) array
        The same at most between two knots.
    rows : (n, 6, ni + 1) array
        Compressed rows times the coordinates at the knots.
    leading : (n, 6, k) array
        Compressed rows times the leading directions.
    coordinates, knots, knot_deviation, deviation, rest, largest : arrays
        See `SearchPlan`.
    stress, sample : (n,) arrays
        Filled with peak and sample.
    """
    count, measures = total.shape
    knot_count, directions = len(knots), deviation.shape[1]
    leading_squares = np.empty((measures, directions), dtype=np.float32)
    bounds = np.empty(knot_count - 1, dtype=np.float32)
    values = np.empty(knot_count, dtype=np.float32)
    norms = np.empty(directions + 2, dtype=np.float32)
    nothing = np.zeros(6, dtype=np.float32)
    line = np.empty(6, dtype=np.float32)
    # intervals still to be looked at: first sample, length, bounds of the stress at both ends
    pending = np.empty((LEVELS + 2, 2), dtype=np.int64)
    ends = np.empty((LEVELS + 2, 2), dtype=np.float32)
    evaluated = 0
    for e in range(count):
        _values(rows[e], points[e], values)
        top = np.argmax(values)
        _squares(leading[e], points[e], leading_squares)
        _direction_norms(leading_squares, total[e], norms)
        where = knots[top]
        best: Any = _stress(operator[e], coordinates[where], nothing, points[e])
        evaluated += 1
        _bounds(values, knot_deviation, norms[-1], between, dropped[e], bounds)
        # outwards from the highest knot, so that the best value is high from the beginning
        for turn in range(2 * knot_count):
            i = top - 1 - turn // 2 if turn % 2 == 0 else top + turn // 2
            if i < 0 or i >= knot_count - 1 or bounds[i] <= best:
                continue
            start, whole = knots[i], knots[i + 1] - knots[i]
            margin = dropped[e] * between[i]
            depth = 1
            pending[0, 0], pending[0, 1] = start, whole
            ends[0, 0], ends[0, 1] = values[i], values[i + 1]
            outer = i if i < top else i + 1  # the knot at the other end has had its turn
            if (values[outer] + dropped[e] * beside[outer]) * _MARGIN > best:
                value: Any = _stress(operator[e], coordinates[knots[outer]], nothing, points[e])
                evaluated += 1
                if value > best:
                    best, where = value, knots[outer]
            while depth > 0:
                depth -= 1
                begin, width = pending[depth, 0], pending[depth, 1]
                left, right = ends[depth, 0], ends[depth, 1]
                level, longest = 0, LONGEST
                while longest > width:
                    level, longest = level + 1, longest >> 1
                reach = margin + (left if left > right else right)
                among = largest[level, begin // width]
                # the product of the norms bounds the sum of the products, at less cost
                if (reach + norms[-1] * among[-1]) * _MARGIN <= best:
                    continue
                if (reach + _rise(norms, among)) * _MARGIN <= best:
                    continue
                middle = begin + (width >> 1)
                share = np.float32((middle - start) / whole)
                for row in range(6):
                    at = rows[e, row, i]
                    line[row] = at + share * (rows[e, row, i + 1] - at)
                value = _stress(leading[e], deviation[middle], line, points[e])
                value = np.float32(value + norms[directions] * rest[middle])
                if (value + margin) * _MARGIN > best:
                    exact: Any = _stress(operator[e], coordinates[middle], nothing, points[e])
                    evaluated += 1
                    if exact > best:
                        best, where = exact, middle
                        value = exact if exact < value else value
                if width > 2:
                    half = width >> 1
                    pending[depth, 0], pending[depth, 1] = begin, half
                    ends[depth, 0], ends[depth, 1] = left, value
                    pending[depth + 1, 0], pending[depth + 1, 1] = middle, half
                    ends[depth + 1, 0], ends[depth + 1, 1] = value, right
                    depth += 2
        stress[e] = best
        sample[e] = where
    return evaluated
