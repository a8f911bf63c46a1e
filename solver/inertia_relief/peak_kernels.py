"""Compiled inner loops of the peak search: bounds, and evaluation where they do not suffice.

Stress of an element at one sample is a few short dot products; its rows stay in the first-level
cache while the search halves the intervals that its bounds cannot rule out.
"""

import math

import numba
import numpy as np

from solver.arrays import Array, IntArray
from solver.inertia_relief.reduced import Single

#: Samples between two coarse ones, a power of two.
STEP = 16
#: Times that an interval can be halved.
LEVELS = 4
#: Covers the rounding of single precision in comparing a bound with a value.
_MARGIN = np.float32(1.0001)
_ZERO = np.float32(0.0)
_FAST = {"contract", "reassoc", "nsz"}


@numba.njit(cache=True)
def _shell_square(s: Single) -> float:  # pragma: no cover - compiled
    """Square of von Mises stress, the larger face, from six rows."""
    bottom = s[0] * s[0] + s[1] * s[1] + s[2] * s[2]
    top = s[3] * s[3] + s[4] * s[4] + s[5] * s[5]
    return bottom if bottom > top else top


@numba.njit(cache=True)
def _beam_square(s: Single, points: Single) -> float:  # pragma: no cover - compiled
    """Square of von Mises stress, the largest of eight points, from five rows and torsion."""
    best = _ZERO
    for i in range(points.shape[0]):
        normal = (
            points[i, 0] * s[0]
            + points[i, 1] * s[1]
            + points[i, 2] * s[2]
            + points[i, 3] * s[3]
            + points[i, 4] * s[4]
        )
        square = normal * normal
        best = square if square > best else best
    return best + s[5] * s[5]


@numba.njit(cache=True, fastmath=_FAST)
def _evaluate(rows: Single, amplitudes: Single, out: Single) -> None:  # pragma: no cover
    """Six rows of one element at one sample."""
    for row in range(6):
        total = _ZERO
        for k in range(len(amplitudes)):
            total += rows[row, k] * amplitudes[k]
        out[row] = total


@numba.njit(cache=True, fastmath=_FAST)
def _norms(
    rows: Single, points: Single, blocks: IntArray, out: Single
) -> None:  # pragma: no cover - compiled
    """Largest stress of one element for unit norm in each block of directions.

    Within a block the squares add up point by point, so the larger of the points' sums bounds it.
    """
    shell = points.shape[0] == 0
    for b in range(len(blocks) - 1):
        best = _ZERO
        if shell:
            for face in range(2):
                total = _ZERO
                for row in range(3 * face, 3 * face + 3):
                    for k in range(blocks[b], blocks[b + 1]):
                        total += rows[row, k] * rows[row, k]
                best = total if total > best else best
        else:
            for i in range(points.shape[0]):
                total = _ZERO
                for k in range(blocks[b], blocks[b + 1]):
                    normal = _ZERO
                    for row in range(5):
                        normal += points[i, row] * rows[row, k]
                    total += normal * normal + rows[5, k] * rows[5, k]
                best = total if total > best else best
        out[b] = math.sqrt(best)


@numba.njit(cache=True, fastmath={"contract"})
def search_block(
    rows: Single,
    coarse_rows: Single,
    points: Single,
    samples: Single,
    blocks: IntArray,
    deviation: Single,
    stress: Array,
    sample: IntArray,
) -> int:  # pragma: no cover - compiled
    """Find the peak of every element of a block; return how many samples were evaluated.

    Parameters
    ----------
    rows : (n, 6, r) array
        Stress rows in the plan's directions [Pa].
    coarse_rows : (n, 6, ni + 1) array
        The rows at the coarse samples [Pa].
    points : (n, 8, 5) array
        Normal stress of a beam's points from its first five rows; (n, 0, 5) for shells.
    samples : (ni STEP + 1, r) array
        Amplitudes at every sample.
    blocks : (nb + 1,) array
        Borders of the blocks of directions.
    deviation : (LEVELS, ni STEP / 2, nb) array
        Largest deviation from straight lines of each block: in every interval, in its halves,
        and so on down to two samples.
    stress, sample : (n,) arrays
        Filled with peak and sample.
    """
    count, _, coarse_count = coarse_rows.shape
    values = np.empty(coarse_count, dtype=np.float32)
    bounds = np.empty(coarse_count, dtype=np.float32)
    norms = np.empty(len(blocks) - 1, dtype=np.float32)
    exact = np.empty(6, dtype=np.float32)
    # intervals still to be looked at: level, index, stress at both ends
    pending = np.empty((LEVELS + 2, 2), dtype=np.int64)
    ends = np.empty((LEVELS + 2, 2), dtype=np.float32)
    evaluated = 0
    for e in range(count):
        for i in range(coarse_count):
            for row in range(6):
                exact[row] = coarse_rows[e, row, i]
            if points.shape[1] == 0:
                values[i] = math.sqrt(_shell_square(exact))
            else:
                values[i] = math.sqrt(_beam_square(exact, points[e]))
        _norms(rows[e], points[e], blocks, norms)
        best, where = values[0], 0
        for i in range(1, coarse_count):
            if values[i] > best:
                best, where = values[i], i * STEP
        first = 0
        for i in range(coarse_count - 1):
            total = _ZERO
            for b in range(len(norms)):
                total += norms[b] * deviation[0, i, b]
            total += values[i] if values[i] > values[i + 1] else values[i + 1]
            bounds[i] = total * _MARGIN
            if bounds[i] > bounds[first]:
                first = i
        for turn in range(-1, coarse_count - 1):  # the most promising interval comes first
            i = first if turn < 0 else turn
            if bounds[i] <= best or turn == first:
                continue
            depth = 1
            pending[0, 0], pending[0, 1] = 0, i
            ends[0, 0], ends[0, 1] = values[i], values[i + 1]
            while depth > 0:
                depth -= 1
                level, index = pending[depth, 0], pending[depth, 1]
                left, right = ends[depth, 0], ends[depth, 1]
                total = left if left > right else right
                for b in range(len(norms)):
                    total += norms[b] * deviation[level, index, b]
                if total * _MARGIN <= best:
                    continue
                width = STEP >> level
                middle = index * width + (width >> 1)
                _evaluate(rows[e], samples[middle], exact)
                evaluated += 1
                if points.shape[1] == 0:
                    value = math.sqrt(_shell_square(exact))
                else:
                    value = math.sqrt(_beam_square(exact, points[e]))
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
