"""Every element's largest von Mises stress over a whole landing, and when.

Von Mises stress is a norm of linear rows A of the coordinates z.  Blocks of elements share a few
patterns p, so that A z = S p + (what the patterns leave out, bounded by groups of coordinates).

1. At knots in time every element's stress is estimated with the leading patterns; other patterns
   can add their norm.  Between two knots the patterns are a straight line plus a deviation, so the
   stress is at most the larger end value plus what the deviation can cause, group by group.
2. In intervals whose bound reaches what is certain already, all patterns estimate every sample.
3. Samples whose estimate, plus what the patterns leave out, can still be the peak are evaluated
   with the exact rows.

The result is that of evaluating every sample, to the rounding of single precision.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array, IntArray, Single
from solver.inertia_relief.peak_kernels import evaluate_candidates, gather_candidates
from solver.inertia_relief.peak_patterns import fill_patterns
from solver.inertia_relief.peak_plan import plan_search
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.reduced_stress import BLOCK, PATTERN_GROUP, group_edges
from solver.inertia_relief.response import ReducedResponse


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
    plan = plan_search(response.coordinates.T / model.stress.scale)
    knots, intervals = len(plan.knots), len(plan.knots) - 1
    # fresh pages for every block would cost as much as what is written on them
    room = _Room()
    stress = np.zeros(count)
    sample = np.zeros(count, dtype=np.int64)
    starts = np.empty(BLOCK + 1, dtype=np.int64)
    # a knot may be looked at from either side
    candidates = np.empty(BLOCK * (len(plan.coordinates) + knots), dtype=np.int64)
    reach = np.empty(len(candidates), dtype=np.float32)
    evaluated = first = 0
    for block in model.stress.blocks():
        height, patterns = block.shares.shape
        size, last = len(block.rows), first + len(block.rows)
        edges = group_edges(patterns, PATTERN_GROUP)
        groups, leading = len(edges) - 1, int(np.searchsorted(edges, block.leading))
        at_grid = room("grid", len(plan.at_grid), patterns)
        np.matmul(plan.at_grid[:, -block.patterns.shape[1] :], block.patterns.T, out=at_grid)
        history = room("history", len(plan.coordinates), patterns)
        at_knots = room("at knots", knots, block.leading)
        rise = room("rise", intervals, groups)
        others = room("others", knots, groups - leading)
        fill_patterns(
            at_grid,
            plan.support,
            plan.weights,
            plan.knots,
            edges,
            leading,
            history,
            at_knots,
            rise,
            others,
        )
        values = room("values", height, knots)
        np.matmul(block.shares[:, : block.leading], at_knots.T, out=values)
        norms = block.pattern_norms[:, :groups]
        gather_candidates(
            block.points,
            block.shares.reshape(size, 6, patterns),
            block.rest_norms,
            values.reshape(size, 6, knots),
            np.matmul(norms[:, leading:], others.T, out=room("others at knots", size, knots)),
            np.matmul(norms, rise.T, out=room("rises", size, intervals)),
            np.matmul(block.rest_norms, plan.largest, out=room("beside", size, intervals)),
            plan.norms,
            history,
            plan.knots,
            starts,
            candidates,
            reach,
        )
        evaluated += evaluate_candidates(
            block.rows,
            block.points,
            plan.coordinates,
            starts,
            candidates,
            reach,
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


class _Room:
    """Memory for arrays of a block, kept for the next block's."""

    def __init__(self) -> None:
        self._pages: dict[str, Single] = {}

    def __call__(self, name: str, height: int, width: int) -> Single:
        """Return an array (height, width) with anything in it."""
        page = self._pages.get(name)
        if page is None or page.size < height * width:
            page = self._pages[name] = np.empty(2 * height * width, dtype=np.float32)
        return page[: height * width].reshape(height, width)
