"""Every element's largest von Mises stress over a whole landing, and when.

Every element is looked at in knots, with stress rows compressed by blocks of elements.  Between
two knots the coordinates are a straight line plus a deviation d(t); von Mises stress is a norm of
linear rows A, so it cannot exceed the larger end value plus ``sum_k |A_k| max |d_k(t)|``, where k
counts the principal directions of the deviation and, last, all that they leave out.  Intervals
whose bound reaches the element's best value so far are halved.  What the compression leaves out
widens every bound, and whatever can still be the peak is evaluated with the exact rows.  The
result is that of evaluating every sample, to the rounding of single precision.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array, IntArray, Single
from solver.inertia_relief.peak_kernels import search_block
from solver.inertia_relief.peak_plan import SearchPlan, plan_search
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.reduced_stress import BLOCK
from solver.inertia_relief.response import ReducedResponse

#: Covers the rounding of the difference of squares that gives what the patterns leave out.
_ROUNDING = 1e-3


@dataclass(frozen=True, slots=True)
class StressPeaks:
    """Peak of every element, in the solver's element order."""

    stress: Array  #: (ne,) von Mises [Pa]
    sample: IntArray  #: (ne,) index of the sample
    time: Array  #: (ne,) [s]
    evaluated: float  #: share of all elements' samples that were evaluated exactly


def find_peaks(model: ReducedModel, response: ReducedResponse) -> StressPeaks:
    """Find the peak of every element over all samples of a response."""
    count = model.stress.element_count
    plan = plan_search(response.coordinates.T / model.stress.scale, model.stress.spread)
    columns, knots = np.hstack([plan.at_knots, plan.directions]), len(plan.knots)
    patterns: Single = model.stress.patterns @ columns
    # fresh pages for every block would cost as much as what is written on them
    at_knots = np.empty(6 * BLOCK * knots, dtype=np.float32)
    leading = np.empty(6 * BLOCK * (columns.shape[1] - knots), dtype=np.float32)
    stress = np.zeros(count)
    sample = np.zeros(count, dtype=np.int64)
    evaluated = first = 0
    for block in model.stress.blocks():
        found = patterns[block.patterns]
        height = len(block.shares)
        values = at_knots[: height * knots].reshape(height, knots)
        np.matmul(block.shares, found[:, :knots], out=values)
        slopes = leading[: height * plan.directions.shape[1]].reshape(height, -1)
        np.matmul(block.shares, found[:, knots:], out=slopes)
        beside = _beside_patterns(plan, found)
        last = first + len(block.rows)
        evaluated += search_block(
            block.rows,
            block.points,
            block.squares,
            block.dropped,
            beside,
            np.maximum(beside[:-1], beside[1:]) + plan.spread_deviation,
            values.reshape(len(block.rows), 6, -1),
            slopes.reshape(len(block.rows), 6, -1),
            plan.coordinates,
            plan.knots,
            plan.knot_deviation,
            plan.deviation,
            plan.rest,
            plan.largest,
            stress[first:last],
            sample[first:last],
        )
        first = last
    sample = np.minimum(sample, len(response.time) - 1)
    return StressPeaks(
        stress=stress,
        sample=sample,
        time=response.time[sample],
        evaluated=evaluated / max(1, count * len(response.time)),
    )


def _beside_patterns(plan: SearchPlan, patterns: Single) -> Single:
    """Norm (ni + 1,) of coordinates / spread at the knots, beside a block's patterns (r, ...)."""
    inside = np.square(patterns[:, : len(plan.knots)]).sum(axis=0)
    squares = plan.spread_norms**2
    beside: Single = np.sqrt(np.maximum(squares - inside, 0.0) + _ROUNDING**2 * squares)
    return beside
