"""Compiled inner loops of the peak search: bounds, and evaluation where they do not suffice.

Everything that loops calls is in this module: compiled code that is kept on disk does not notice
what changes elsewhere.
"""

import math
from typing import Any

import numba
import numpy as np

from solver.arrays import Array, IntArray, Short, Single

#: Covers the rounding of single precision in comparing a bound with a value.
_MARGIN = np.float32(1.0001)
_ZERO = np.float32(0.0)
_FAST = {"contract", "reassoc", "nsz"}
# These neither make arrays nor keep them; to count references at every call would cost as much as
# what they evaluate.
_STRICT: dict[str, Any] = {"cache": True, "_nrt": False}
_LEAN: dict[str, Any] = {**_STRICT, "fastmath": _FAST}


@numba.njit(**_LEAN)
def _values(rows: Single, e: int, points: Single, out: Single) -> None:  # pragma: no cover
    """Von Mises stress (k,) from the rows (n, 6, k) of element ``e``, larger face or point."""
    count = len(out)
    if points.shape[1] == 0:
        for k in range(count):
            a, b, c = rows[e, 0, k], rows[e, 1, k], rows[e, 2, k]
            bottom = a * a + b * b + c * c
            a, b, c = rows[e, 3, k], rows[e, 4, k], rows[e, 5, k]
            top = a * a + b * b + c * c
            out[k] = top if top > bottom else bottom
    else:
        for k in range(count):
            out[k] = _ZERO
        for i in range(points.shape[1]):
            p0, p1, p2 = points[e, i, 0], points[e, i, 1], points[e, i, 2]
            p3, p4 = points[e, i, 3], points[e, i, 4]
            for k in range(count):
                normal = p0 * rows[e, 0, k] + p1 * rows[e, 1, k] + p2 * rows[e, 2, k]
                normal += p3 * rows[e, 3, k] + p4 * rows[e, 4, k]
                square = normal * normal
                out[k] = square if square > out[k] else out[k]
        for k in range(count):
            out[k] += rows[e, 5, k] * rows[e, 5, k]
    for k in range(count):
        out[k] = math.sqrt(out[k])


@numba.njit(**_LEAN)
def _bounds(
    values: Single, e: int, others: Single, rise: Single, beside: Single, out: Single
) -> None:  # pragma: no cover - compiled
    """Bounds (ni,) of the stress of element ``e`` between knots, from estimates at the knots."""
    for i in range(len(out)):
        left, right = values[i] + others[e, i], values[i + 1] + others[e, i + 1]
        out[i] = ((left if left > right else right) + rise[e, i] + beside[e, i]) * _MARGIN


@numba.njit(**_LEAN)
def _highest(values: Single) -> int:  # pragma: no cover - compiled
    """Index of the largest value."""
    largest: Any = values[0]
    for i in range(len(values)):
        largest = max(largest, values[i])
    for i in range(len(values)):
        if values[i] >= largest:
            return i
    return 0


@numba.njit(**_STRICT)
def _all_known(values: Single) -> bool:  # pragma: no cover - compiled
    """Whether every value is a number."""
    known = True
    for i in range(len(values)):
        known = known and values[i] == values[i]
    return known


@numba.njit(**_LEAN)
def _rest(norms: Single, e: int, amplitudes: Single, t: int) -> float:  # pragma: no cover
    """How far the exact stress of element ``e`` may be from the compressed one at a sample."""
    total: Any = _ZERO
    for g in range(norms.shape[1]):
        total += norms[e, g] * amplitudes[t, g]
    result: float = total
    return result


@numba.njit(**_LEAN)
def _measure(
    s0: float, s1: float, s2: float, s3: float, s4: float, s5: float, points: Single, e: int
) -> float:  # pragma: no cover - compiled
    """Von Mises stress from the six rows of element ``e``."""
    if points.shape[1] == 0:
        bottom = s0 * s0 + s1 * s1 + s2 * s2
        top = s3 * s3 + s4 * s4 + s5 * s5
        return math.sqrt(top if top > bottom else bottom)
    best: Any = _ZERO
    for i in range(points.shape[1]):
        normal = points[e, i, 0] * s0 + points[e, i, 1] * s1 + points[e, i, 2] * s2
        normal += points[e, i, 3] * s3 + points[e, i, 4] * s4
        square = normal * normal
        best = square if square > best else best
    return math.sqrt(best + s5 * s5)


@numba.njit(**_LEAN, inline="always")
def _sums(
    rows: Single | Short, e: int, history: Single, one: int, two: int
) -> tuple[Any, ...]:  # pragma: no cover - compiled
    """Six rows of element ``e`` of (n, 6, k) times a history at two samples.

    Two at a time, because rows are read once for both and each sum alone would wait on itself.
    """
    s0 = s1 = s2 = s3 = s4 = s5 = _ZERO
    t0 = t1 = t2 = t3 = t4 = t5 = _ZERO
    for k in range(rows.shape[2]):
        a, b = history[one, k], history[two, k]
        r, q = np.float32(rows[e, 0, k]), np.float32(rows[e, 1, k])
        s0, t0, s1, t1 = s0 + r * a, t0 + r * b, s1 + q * a, t1 + q * b
        r, q = np.float32(rows[e, 2, k]), np.float32(rows[e, 3, k])
        s2, t2, s3, t3 = s2 + r * a, t2 + r * b, s3 + q * a, t3 + q * b
        r, q = np.float32(rows[e, 4, k]), np.float32(rows[e, 5, k])
        s4, t4, s5, t5 = s4 + r * a, t4 + r * b, s5 + q * a, t5 + q * b
    return s0, s1, s2, s3, s4, s5, t0, t1, t2, t3, t4, t5


@numba.njit(**_LEAN)
def _stress(
    shares: Single, e: int, patterns: Single, one: int, two: int, points: Single
) -> tuple[float, float]:  # pragma: no cover - compiled
    """Von Mises stress of element ``e`` from shares (n, 6, r) and patterns at two samples."""
    s0, s1, s2, s3, s4, s5, t0, t1, t2, t3, t4, t5 = _sums(shares, e, patterns, one, two)
    return (
        _measure(s0, s1, s2, s3, s4, s5, points, e),
        _measure(t0, t1, t2, t3, t4, t5, points, e),
    )


@numba.njit(**_LEAN)
def _row_stress(
    numbers: Short, step: Single, e: int, history: Single, one: int, two: int, points: Single
) -> tuple[float, float]:  # pragma: no cover - compiled
    """Von Mises stress of element ``e`` from its rows and the coordinates at two samples."""
    s0, s1, s2, s3, s4, s5, t0, t1, t2, t3, t4, t5 = _sums(numbers, e, history, one, two)
    one_step = step[e, 0], step[e, 1], step[e, 2], step[e, 3], step[e, 4], step[e, 5]
    p0, p1, p2, p3, p4, p5 = one_step
    return (
        _measure(p0 * s0, p1 * s1, p2 * s2, p3 * s3, p4 * s4, p5 * s5, points, e),
        _measure(p0 * t0, p1 * t1, p2 * t2, p3 * t3, p4 * t4, p5 * t5, points, e),
    )


@numba.njit(**_STRICT)
def _gather(
    e: int,
    begin: int,
    end: int,
    bounds: Single,
    at_knots: Single,
    others: Single,
    beside: Single,
    knots: IntArray,
    shares: Single,
    patterns: Single,
    points: Single,
    rest_norms: Single,
    norms: Single,
    certain: float,
    likeliest: int,
    floor: float,
    samples: IntArray,
    estimates: Single,
    doubt: Single,
    candidates: IntArray,
    reach: Single,
    found: int,
) -> tuple[int, float, int, int]:  # pragma: no cover - compiled
    """Gather the samples in intervals ``begin`` to ``end`` that can hold more than is certain.

    Returns
    -------
    int, float, int, int
        Number of candidates, what is certain now, the candidate it comes from, and the number of
        estimates.
    """
    # first all samples, then all estimates: loops without surprises keep the processor busy
    count, done = 0, -1
    limit = max(floor, certain)
    for i in range(begin, end):
        if bounds[i] <= limit:
            continue
        start, stop = knots[i], knots[i + 1]
        # the ends are known by the leading patterns, and may have been looked at from before
        if start == done or (at_knots[i] + others[e, i] + beside[e, i]) * _MARGIN <= limit:
            start += 1
        done = stop
        if (at_knots[i + 1] + others[e, i + 1] + beside[e, i]) * _MARGIN <= limit:
            stop -= 1
            done = -1
        for t in range(start, stop + 1):
            samples[count + t - start] = t
            doubt[count + t - start] = beside[e, i]
        count += max(0, stop + 1 - start)
    samples[count] = samples[max(0, count - 1)]
    for c in range(0, count, 2):
        pair = _stress(shares, e, patterns, samples[c], samples[c + 1], points)
        estimates[c], estimates[c + 1] = pair[0], pair[1]
    for c in range(count):
        certain = max(certain, estimates[c] - doubt[c])
    limit = max(floor, certain)
    for c in range(count):
        if (estimates[c] + doubt[c]) * _MARGIN > limit:
            t = samples[c]
            rest: Any = _rest(rest_norms, e, norms, t)
            if (estimates[c] + rest) * _MARGIN > limit:
                candidates[found], reach[found] = t, (estimates[c] + rest) * _MARGIN
                if estimates[c] - rest >= certain:
                    certain, likeliest = estimates[c] - rest, found
                    limit = max(floor, certain)
                found += 1
    return found, certain, likeliest, count


@numba.njit(cache=True)
def gather_candidates(
    points: Single,
    shares: Single,
    rest_norms: Single,
    at_knots: Single,
    others: Single,
    rise: Single,
    beside: Single,
    norms: Single,
    patterns: Single,
    knots: IntArray,
    floors: Single,
    starts: IntArray,
    candidates: IntArray,
    reach: Single,
) -> int:  # pragma: no cover - compiled
    """Gather the samples that can hold an element's peak; return how many were estimated.

    Of an element that stays below its floor there are none.

    Parameters
    ----------
    points : (n, 8, 5) array
        Normal stress of a beam's points from its first five rows; (n, 0, 5) for shells.
    shares : (n, 6, r) array
        Compressed stress rows [Pa].
    rest_norms : (n, 2 * groups) array
        See `ReducedStress`.
    at_knots : (n, 6, ni + 1) array
        Stress rows by the leading patterns, at the knots.
    others : (n, ni + 1) array
        Stress by other patterns at the knots, at most.
    rise, beside : (n, ni) arrays
        How far compressed stress rises above the line between two knots, and how far the exact
        one may be from it, at most.
    norms, knots : arrays
        See `SearchPlan`.
    patterns : (n + 1, r) array
        At every sample.
    floors : (n,) array
        Stress of each element that is not looked for.
    starts : (n + 1,) array
        Filled with the place of each element's first candidate, which is the likeliest.
    candidates, reach : (n * (samples + knots),) arrays
        Filled with samples and what the stress can be there at most.
    """
    intervals = len(knots) - 1
    bounds = np.empty(intervals, dtype=np.float32)
    values = np.empty(intervals + 1, dtype=np.float32)
    samples = np.empty(len(patterns) + len(knots) + 1, dtype=np.int64)
    estimates = np.empty(len(samples), dtype=np.float32)
    doubt = np.empty(len(samples), dtype=np.float32)
    found = estimated = 0
    for e in range(len(shares)):
        _values(at_knots, e, points, values)
        _bounds(values, e, others, rise, beside, bounds)
        top = _highest(values)
        first, certain = found, np.float32(-1.0)
        starts[e] = found
        likeliest = found
        # around the highest knot first, so that much is certain from the beginning
        near, far = max(top - 1, 0), min(top + 1, intervals)
        for turn in range(3):
            begin = near if turn == 0 else (0 if turn == 1 else far)
            end = far if turn == 0 else (near if turn == 1 else intervals)
            found, certain, likeliest, looked = _gather(
                e,
                begin,
                end,
                bounds,
                values,
                others,
                beside,
                knots,
                shares,
                patterns,
                points,
                rest_norms,
                norms,
                certain,
                likeliest,
                floors[e],
                samples,
                estimates,
                doubt,
                candidates,
                reach,
                found,
            )
            estimated += looked
        if found == first:
            if floors[e] > _ZERO and _all_known(bounds):
                continue
            # at rest, or the motion is not a number, and so is the peak
            candidates[first], reach[first] = knots[top], _ZERO
            found += 1
        candidates[first], candidates[likeliest] = candidates[likeliest], candidates[first]
        reach[first], reach[likeliest] = reach[likeliest], reach[first]
    starts[len(shares)] = found
    return estimated


@numba.njit(**_STRICT)
def evaluate_candidates(
    numbers: Short,
    step: Single,
    points: Single,
    elements: IntArray,
    coordinates: Single,
    starts: IntArray,
    candidates: IntArray,
    reach: Single,
    floors: Single,
    stress: Array,
    sample: IntArray,
) -> int:  # pragma: no cover - compiled
    """Find the peaks among the candidates; return how many were evaluated.

    Parameters
    ----------
    numbers, step : (n, 6, m), (n, 6) arrays
        See `RoundedRows`.
    points : (n, 8, 5) or (n, 0, 5) array
        See `gather_candidates`.
    elements : (k,) array
        Those of the n that there are candidates of.
    starts, candidates, reach : arrays
        See `gather_candidates`.
    floors : (k,) array
        See `gather_candidates`.
    coordinates : (n + 1, m) array
        At every sample.
    stress, sample : (n,) arrays
        Filled with peak and sample where there are candidates.
    """
    evaluated = 0
    for k in range(len(elements)):
        if starts[k] == starts[k + 1]:
            continue
        # the likeliest alone, then two at a time what can still be higher
        e, where = elements[k], candidates[starts[k]]
        best: Any = _row_stress(numbers, step, e, coordinates, where, where, points)[0]
        evaluated += 1
        waiting = -1
        for c in range(starts[k] + 1, starts[k + 1]):
            if reach[c] <= max(floors[k], best):
                continue
            if waiting < 0:
                waiting = candidates[c]
                continue
            pair = _row_stress(numbers, step, e, coordinates, waiting, candidates[c], points)
            evaluated += 2
            if pair[0] > best:
                best, where = pair[0], waiting
            if pair[1] > best:
                best, where = pair[1], candidates[c]
            waiting = -1
        if waiting >= 0:
            value: Any = _row_stress(numbers, step, e, coordinates, waiting, waiting, points)[0]
            evaluated += 1
            if value > best:
                best, where = value, waiting
        stress[e] = best
        sample[e] = where
    return evaluated
