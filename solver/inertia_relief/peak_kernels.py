"""Compiled inner loops of the peak search: bounds, and exact evaluation where they do not suffice.

Stress rows of an element stay in the first-level cache with the amplitudes of one interval;
directions are summed in vector registers.
"""

import math

import numba
import numpy as np

from solver.arrays import Array, IntArray
from solver.inertia_relief.reduced import Single

#: Samples between two coarse ones.
STEP = 16
#: Covers the rounding of single precision in comparing a bound with a value.
_MARGIN = np.float32(1.0001)
_ZERO = np.float32(0.0)


@numba.njit(cache=True, fastmath={"contract", "reassoc", "nsz"})
def _norms(rows: Single, shell: bool, blocks: IntArray, out: Single) -> None:  # pragma: no cover
    """Largest stress of one element for unit norm in each block of directions."""
    for b in range(len(blocks) - 1):
        best = _ZERO
        if shell:
            for face in range(2):
                total = _ZERO
                for row in range(3 * face, 3 * face + 3):
                    for k in range(blocks[b], blocks[b + 1]):
                        total += rows[row, k] * rows[row, k]
                best = max(best, total)
        else:
            shear = _ZERO
            for k in range(blocks[b], blocks[b + 1]):
                shear += rows[8, k] * rows[8, k]
            for row in range(8):
                total = shear
                for k in range(blocks[b], blocks[b + 1]):
                    total += rows[row, k] * rows[row, k]
                best = max(best, total)
        out[b] = math.sqrt(best)


@numba.njit(cache=True)
def _measures(rows: Single, shell: bool, count: int, out: Single) -> None:  # pragma: no cover
    """Von Mises stress from the rows (6 or 9, count) of one element."""
    if shell:
        for j in range(count):
            bottom = rows[0, j] * rows[0, j] + rows[1, j] * rows[1, j] + rows[2, j] * rows[2, j]
            top = rows[3, j] * rows[3, j] + rows[4, j] * rows[4, j] + rows[5, j] * rows[5, j]
            out[j] = math.sqrt(bottom if bottom > top else top)
    else:
        for j in range(count):
            out[j] = rows[0, j] * rows[0, j]
        for row in range(1, 8):
            for j in range(count):
                square = rows[row, j] * rows[row, j]
                out[j] = square if square > out[j] else out[j]
        for j in range(count):
            out[j] = math.sqrt(out[j] + rows[8, j] * rows[8, j])


@numba.njit(cache=True, fastmath={"contract", "reassoc", "nsz"})
def _evaluate(rows: Single, amplitudes: Single, out: Single) -> None:  # pragma: no cover
    """Rows of one element at the samples of one interval, (R, r) times (STEP, r)."""
    for row in range(rows.shape[0]):
        for j in range(STEP):
            total = _ZERO
            for k in range(rows.shape[1]):
                total += rows[row, k] * amplitudes[j, k]
            out[row, j] = total


@numba.njit(cache=True)
def search_block(
    rows: Single,
    coarse_rows: Single,
    shell: bool,
    amplitudes: Single,
    blocks: IntArray,
    deviation: Single,
    stress: Array,
    sample: IntArray,
) -> int:  # pragma: no cover - compiled
    """Find the peak of every element of a block; return how many intervals were evaluated.

    Parameters
    ----------
    rows : (n, R, r) array
        Stress rows in the plan's directions, R 6 for shells, 9 for beams [Pa].
    coarse_rows : (n, R, ni + 1) array
        The rows at the coarse samples [Pa].
    amplitudes : (ni, STEP, r) array
        Samples of every interval, its left end first.
    blocks : (nb + 1,) array
        Borders of the blocks of directions.
    deviation : (nb, ni) array
        Largest deviation from straight lines of each block in each interval.
    stress, sample : (n,) arrays
        Filled with peak and sample.
    """
    count, height, _ = rows.shape
    intervals = amplitudes.shape[0]
    values = np.empty(intervals + 1, dtype=np.float32)
    bounds = np.empty(intervals, dtype=np.float32)
    norms = np.empty(len(blocks) - 1, dtype=np.float32)
    exact = np.empty((height, STEP), dtype=np.float32)
    inner = np.empty(STEP, dtype=np.float32)
    evaluated = 0
    for e in range(count):
        _measures(coarse_rows[e], shell, intervals + 1, values)
        _norms(rows[e], shell, blocks, norms)
        best, where = values[0], 0
        for i in range(1, intervals + 1):
            if values[i] > best:
                best, where = values[i], i * STEP
        for i in range(intervals):
            bounds[i] = _ZERO
        for b in range(len(norms)):
            for i in range(intervals):
                bounds[i] += norms[b] * deviation[b, i]
        highest = 0
        for i in range(intervals):
            bounds[i] = (bounds[i] + max(values[i], values[i + 1])) * _MARGIN
            if bounds[i] > bounds[highest]:
                highest = i
        for turn in range(-1, intervals):
            i = highest if turn < 0 else turn
            if bounds[i] <= best or (turn == highest):
                continue
            evaluated += 1
            _evaluate(rows[e], amplitudes[i], exact)
            _measures(exact, shell, STEP, inner)
            for j in range(STEP):
                if inner[j] > best:
                    best, where = inner[j], i * STEP + j
        stress[e] = best
        sample[e] = where
    return evaluated
