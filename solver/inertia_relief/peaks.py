"""Every element's largest von Mises stress over a whole landing, and when.

Von Mises stress is a norm of linear rows A of the coordinates z.  Blocks of elements share a few
patterns p, so that A z = S p + (what the patterns leave out, bounded by groups of coordinates).

1. At knots in time every element's stress is estimated with the leading patterns; other patterns
   can add their norm.  Between two knots the patterns are a straight line plus a deviation, so the
   stress is at most the larger end value plus what the deviation can cause, group by group.
2. In intervals whose bound reaches what is certain already, all patterns estimate every sample.
3. Samples whose estimate, plus what the patterns leave out, can still be the peak are evaluated
   with the exact rows.

Elements that cannot exceed what the caller calls their floor are left out as early as a bound
allows: all at once for the whole landing, interval by interval, or sample by sample.

The result is that of evaluating every sample, to the rounding of single precision.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from solver.arrays import Array, BoolArray, IntArray, Single
from solver.errors import ModelError
from solver.inertia_relief.peak_kernels import evaluate_candidates, gather_candidates
from solver.inertia_relief.peak_patterns import fill_patterns
from solver.inertia_relief.peak_plan import SearchPlan, plan_search
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.reduced_stress import BLOCK, PATTERN_GROUP, StressBlock, group_edges
from solver.inertia_relief.response import ReducedResponse

#: Landings that go through a block of elements before the next one is read.
LANDINGS_AT_ONCE = 16
#: Covers the rounding of single precision in comparing a bound with a floor.
_MARGIN = np.float32(1.0001)
#: A block is cut down to the elements that can exceed their floors if these are fewer than this.
_WORTH_CUTTING = 0.8


@dataclass(frozen=True, slots=True)
class StressPeaks:
    """Peak of every element, in the solver's element order.

    Of an element that does not exceed its floor nothing else is known: its stress is the floor.
    """

    stress: Array  #: (ne,) von Mises [Pa]
    sample: IntArray  #: (ne,) index of the sample, -1 below the floor
    time: Array  #: (ne,) not a number below the floor [s]
    below_floor: BoolArray  #: (ne,) whether the stress is only known to be at most the given one
    evaluated: float  #: share of all elements' samples that were evaluated exactly


def find_peaks(
    model: ReducedModel,
    response: ReducedResponse,
    floor: ArrayLike = 0.0,
) -> StressPeaks:
    """Find the peak of every element over all samples of a response.

    Parameters
    ----------
    floor : float or (ne,) array
        Stress up to which nobody cares how high an element's peak is [Pa].

    Raises
    ------
    ModelError
        Floors of another shape than the elements', or negative ones.
    """
    return find_peaks_together(model, [response], floor)[0]


def find_peaks_together(
    model: ReducedModel,
    responses: Sequence[ReducedResponse],
    floor: ArrayLike = 0.0,
) -> list[StressPeaks]:
    """Find the peaks of several landings, each as `find_peaks` does.

    Every block of elements is read once for `LANDINGS_AT_ONCE` of them.
    """
    count = model.stress.element_count
    floors = np.asarray(floor, dtype=np.float64)
    if floors.shape not in ((), (count,)):
        raise ModelError(f"floor must be one stress or {count}, got shape {floors.shape}")
    if not np.all(floors >= 0.0):
        raise ModelError(f"floor must not be negative, got {floors.min():g} Pa")
    floors = np.ascontiguousarray(np.broadcast_to(floors, count))
    found: list[StressPeaks] = []
    # fresh pages for every block would cost as much as what is written on them
    room = _Room()
    for first in range(0, len(responses), LANDINGS_AT_ONCE):
        searches = [
            _Search(model, response, floors, room)
            for response in responses[first : first + LANDINGS_AT_ONCE]
        ]
        element = 0
        for block in model.stress.blocks():
            for search in searches:
                search.look_at(block, element)
            element += len(block.rows)
        found += [search.peaks() for search in searches]
    return found


class _Search:
    """The search in one landing, block after block."""

    def __init__(
        self,
        model: ReducedModel,
        response: ReducedResponse,
        floors: Array,
        room: "_Room",
    ) -> None:
        self._plan: SearchPlan = plan_search(response.coordinates.T / model.stress.scale)
        self._time = response.time
        self._floors = floors
        self._single_floors = floors.astype(np.float32)
        self._room = room
        self._stress = np.zeros(len(floors))
        self._sample = np.full(len(floors), -1, dtype=np.int64)
        self._starts = np.empty(BLOCK + 1, dtype=np.int64)
        # a knot may be looked at from either side
        most = BLOCK * (len(self._plan.coordinates) + len(self._plan.knots))
        self._candidates = room.samples("candidates", most)
        self._reach = room("reach", 1, most)[0]
        self._evaluated = 0

    def look_at(self, block: StressBlock, first: int) -> None:
        """Find the peaks of a block whose first element is ``first``."""
        part = slice(first, first + len(block.rows))
        elements, plan, small, start = np.arange(len(block.rows)), self._plan, block, 0
        if self._single_floors[part].any():
            possible = self._possible(block, self._single_floors[part])
            if not possible.any():
                return
            intervals = np.flatnonzero(possible.any(axis=0))
            start = int(plan.knots[intervals[0]])
            plan = plan.window(int(intervals[0]), int(intervals[-1]) + 1)
            some = np.flatnonzero(possible.any(axis=1))
            if len(some) < _WORTH_CUTTING * len(block.rows):
                elements, small = some, block.compressed_part(some)
        floors = self._single_floors[part][elements]
        self._gather(plan, small, floors)
        sample = self._sample[part]
        self._evaluated += evaluate_candidates(
            block.rows.numbers,
            block.rows.step,
            block.points,
            elements,
            plan.coordinates,
            self._starts,
            self._candidates,
            self._reach,
            floors,
            self._stress[part],
            sample,
        )
        sample[sample >= 0] += start

    def peaks(self) -> StressPeaks:
        """Return what was found in all blocks."""
        below = (self._stress <= self._floors) & (self._floors > 0.0)
        sample = np.where(below, -1, np.clip(self._sample, 0, len(self._time) - 1))
        return StressPeaks(
            stress=np.where(below, self._floors, self._stress),
            sample=sample,
            time=np.where(below, np.nan, self._time[sample]),
            below_floor=below,
            evaluated=self._evaluated / max(1, len(self._stress) * len(self._time)),
        )

    def _possible(self, block: StressBlock, floors: Single) -> BoolArray:
        """Whether each element can exceed its floor in each interval, (n, ni)."""
        groups = block.rest_norms.shape[1] // 2
        # what the patterns leave out and what they hold, of coordinates as far as they move there
        norms = block.rest_norms[:, :groups] + block.rest_norms[:, groups:]
        bounds = norms @ self._plan.largest[:groups] * _MARGIN
        possible: BoolArray = ~(bounds <= floors[:, None])  # also if it is not a number
        return possible

    def _gather(self, plan: SearchPlan, block: StressBlock, floors: Single) -> None:
        """Gather samples that can be peaks of a block, see `gather_candidates`."""
        room = self._room
        knots, intervals = len(plan.knots), len(plan.knots) - 1
        size, patterns = len(floors), block.shares.shape[1]
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
        values = room("values", 6 * size, knots)
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
            floors,
            self._starts,
            self._candidates,
            self._reach,
        )


class _Room:
    """Memory for arrays of a block, kept for the next block's."""

    def __init__(self) -> None:
        self._pages: dict[str, Single] = {}
        self._samples: dict[str, IntArray] = {}

    def __call__(self, name: str, height: int, width: int) -> Single:
        """Return an array (height, width) with anything in it."""
        page = self._pages.get(name)
        if page is None or page.size < height * width:
            page = self._pages[name] = np.empty(2 * height * width, dtype=np.float32)
        return page[: height * width].reshape(height, width)

    def samples(self, name: str, length: int) -> IntArray:
        """Return an array (length,) of sample numbers with anything in it."""
        page = self._samples.get(name)
        if page is None or page.size < length:
            page = self._samples[name] = np.empty(length, dtype=np.int64)
        return page[:length]
