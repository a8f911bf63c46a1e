"""Every element's largest von Mises stress over a whole landing, and when.

The history is compressed to its numerical rank, then every element is evaluated at a coarse set of
samples only.  Between two coarse samples the coordinates are a straight line plus a deviation d(t).
Von Mises stress is a norm of linear rows A, so it cannot exceed the larger end value plus
``sum_b |A_b| max |d_b(t)|`` over blocks b of directions.  Only intervals whose bound reaches the
element's best value so far are evaluated sample by sample.  The result is that of evaluating every
sample, to the rounding of single precision.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array, IntArray
from solver.inertia_relief.compression import CompressedHistory, compress
from solver.inertia_relief.peak_kernels import STEP, search_block
from solver.inertia_relief.reduced import ReducedModel, Single
from solver.inertia_relief.response import ReducedResponse

#: Share of the history, in strain-energy norm, that compression may drop at any sample.
COMPRESSION_TOLERANCE = 1e-4
#: Elements evaluated together, so that their stresses stay in the second-level cache.
ELEMENT_BLOCK = 256
#: Directions of deviation that are bounded one by one; the others in blocks.
SINGLE_DIRECTIONS = 12
BLOCK_COUNT = 6
#: Single-precision numbers in a vector register.
LANES = 16


@dataclass(frozen=True, slots=True)
class StressPeaks:
    """Peak of every element, in the solver's element order."""

    stress: Array  #: (ne,) von Mises [Pa]
    sample: IntArray  #: (ne,) index of the sample
    time: Array  #: (ne,) [s]
    rank: int  #: vectors that carried the history
    dropped: float  #: what compression left out, relative to the largest sample
    evaluated: float  #: share of the intervals of all elements that had to be evaluated


@dataclass(frozen=True, slots=True)
class SearchPlan:
    """What bounds every element alike: coarse samples and deviations from straight lines."""

    directions: Single  #: (m, r) most deviating first
    amplitudes: Single  #: (ni, STEP, r) samples of every interval, its left end first
    coarse: Single  #: (r, ni + 1) amplitudes at the coarse samples
    blocks: IntArray  #: (nb + 1,) borders of the blocks of directions
    deviation: Single  #: (nb, ni) largest deviation of each block in each interval


def plan_search(history: CompressedHistory) -> SearchPlan:
    """Turn the directions so that the deviation from straight lines is concentrated in few.

    The rank is padded with zeros to whole vector registers, the last interval with the last sample.
    """
    rank, count = history.amplitudes.shape
    intervals = max(1, -(-(count - 1) // STEP))
    padded = history.amplitudes[:, np.minimum(np.arange(intervals * STEP + 1), count - 1)]
    deviation = _deviation(padded)
    flat = deviation.reshape(rank, -1)
    turn = np.linalg.eigh(flat @ flat.T)[1][:, ::-1]
    turned = np.zeros((-(-rank // LANES) * LANES, padded.shape[1]))
    turned[:rank] = turn.T @ padded
    deviation = _deviation(turned)
    single = min(len(turned), SINGLE_DIRECTIONS)
    rest = np.linspace(single, len(turned), BLOCK_COUNT + 1).astype(np.int64)
    blocks = np.unique(np.concatenate([np.arange(single + 1), rest]))
    squares = np.add.reduceat(deviation * deviation, blocks[:-1], axis=0)
    directions = np.zeros((len(history.directions), len(turned)), dtype=np.float32)
    directions[:, :rank] = history.directions @ turn
    samples = turned[:, :-1].reshape(-1, intervals, STEP)
    return SearchPlan(
        directions,
        np.ascontiguousarray(samples.transpose(1, 2, 0), dtype=np.float32),
        np.ascontiguousarray(turned[:, ::STEP], dtype=np.float32),
        blocks,
        np.sqrt(squares.max(axis=2)).astype(np.float32),
    )


def _deviation(amplitudes: Array) -> Array:
    """Distance (r, ni, STEP) of (r, ni STEP + 1) from the straight lines between coarse ones."""
    coarse = amplitudes[:, ::STEP]
    share = np.arange(STEP) / STEP
    lines = coarse[:, :-1, None] * (1 - share) + coarse[:, 1:, None] * share
    deviation: Array = amplitudes[:, :-1].reshape(len(coarse), -1, STEP) - lines
    return deviation


def find_peaks(
    model: ReducedModel, response: ReducedResponse, tolerance: float = COMPRESSION_TOLERANCE
) -> StressPeaks:
    """Find the peak of every element over all samples of a response.

    Parameters
    ----------
    tolerance : float
        See `compress`.
    """
    history = compress(response.coordinates, tolerance)
    plan = plan_search(history)
    stress = np.zeros(model.element_count)
    sample = np.zeros(model.element_count, dtype=np.int64)
    evaluated, first = 0, 0
    for operator in (model.shell_stress, model.beam_stress):
        height = operator.shape[1]
        for start in range(0, len(operator), ELEMENT_BLOCK):
            part = operator[start : start + ELEMENT_BLOCK]
            rows: Single = part.reshape(-1, part.shape[2]) @ plan.directions
            coarse: Single = rows @ plan.coarse
            stop = first + len(part)
            evaluated += search_block(
                rows.reshape(len(part), height, -1),
                coarse.reshape(len(part), height, -1),
                height == model.shell_stress.shape[1],
                plan.amplitudes,
                plan.blocks,
                plan.deviation,
                stress[first:stop],
                sample[first:stop],
            )
            first = stop
    sample = np.minimum(sample, len(response.time) - 1)
    intervals = max(1, model.element_count * len(plan.amplitudes))
    return StressPeaks(
        stress=stress,
        sample=sample,
        time=response.time[sample],
        rank=history.amplitudes.shape[0],
        dropped=history.dropped / history.largest if history.largest else 0.0,
        evaluated=evaluated / intervals,
    )
