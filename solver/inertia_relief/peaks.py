"""Every element's largest von Mises stress over a whole landing, and when.

Every element is evaluated at a coarse set of samples.  Between two samples the coordinates are a
straight line plus a deviation d(t); von Mises stress is a norm of linear rows A, so it cannot
exceed the larger end value plus ``sum_k |A_k| max |d_k(t)|``, where k counts the principal
directions of the deviation and, last, all that they leave out.  Intervals whose bound reaches the
element's best value so far are halved; in their middle the line and the principal directions are
evaluated, and all coordinates where these and the bound of the rest reach the best value.  The
result is that of evaluating every sample, to the rounding of single precision.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array, IntArray
from solver.inertia_relief.peak_kernels import LEVELS, STEP, search_block
from solver.inertia_relief.reduced import ReducedModel, Single
from solver.inertia_relief.response import ReducedResponse

#: Elements evaluated together, so that their stresses stay in the second-level cache.
ELEMENT_BLOCK = 256
#: Principal directions of deviation.
LEADING_DIRECTIONS = 64
#: Directions that are sought at random beyond those, to find those well.
OVERSAMPLING = 16
#: Covers the rounding of the difference of squares that gives what the directions leave out.
_ROUNDING = np.float32(1e-3)


@dataclass(frozen=True, slots=True)
class StressPeaks:
    """Peak of every element, in the solver's element order."""

    stress: Array  #: (ne,) von Mises [Pa]
    sample: IntArray  #: (ne,) index of the sample
    time: Array  #: (ne,) [s]
    evaluated: float  #: share of all elements' samples that had to be evaluated


@dataclass(frozen=True, slots=True)
class SearchPlan:
    """What bounds every element alike; ni intervals between coarse samples."""

    coordinates: Single  #: (ni STEP + 1, m) at every sample
    coarse: Single  #: (m, ni + 1) at the coarse samples
    directions: Single  #: (m, k) orthonormal, leading directions of deviation
    deviation: Single  #: (ni STEP, k) see `search_block`
    rest: Single  #: (ni STEP,)
    coarse_largest: Single  #: (k + 1, ni)
    largest: Single  #: (LEVELS, ni STEP / 2, k + 1)


def plan_search(coordinates: Array) -> SearchPlan:
    """Prepare the search in a history (m, nt); the last interval is filled with its last sample."""
    size, count = coordinates.shape
    intervals = max(1, -(-(count - 1) // STEP))
    at = np.minimum(np.arange(intervals * STEP + 1), count - 1)
    padded: Single = coordinates[:, at].astype(np.float32)
    deviation = _deviation(padded, STEP)
    directions = _principal(deviation, min(size, LEADING_DIRECTIONS))
    along, rest = _split(deviation, directions)
    largest = np.zeros((LEVELS, intervals * STEP // 2, len(along) + 1), dtype=np.float32)
    for level in range(LEVELS):
        step = STEP >> level
        parts = (along, rest) if level == 0 else _split(_deviation(padded, step), directions)
        found = np.abs(np.vstack(parts)).reshape(len(along) + 1, -1, step).max(axis=2)
        largest[level, : found.shape[1]] = found.T
    return SearchPlan(
        np.ascontiguousarray(padded.T),
        np.ascontiguousarray(padded[:, ::STEP]),
        np.ascontiguousarray(directions),
        np.ascontiguousarray(along.T),
        rest,
        np.ascontiguousarray(largest[0, :intervals].T),
        largest,
    )


def _split(deviation: Single, directions: Single) -> tuple[Single, Single]:
    """Deviation (m, n) along the directions, (k, n), and the norm of the rest, (n,)."""
    along: Single = directions.T @ deviation
    squares = np.einsum("ij,ij->j", deviation, deviation)
    left = np.maximum(squares - np.einsum("ij,ij->j", along, along), 0.0)
    rest: Single = np.sqrt(left + _ROUNDING**2 * squares)
    return along, rest


def _deviation(coordinates: Single, step: int) -> Single:
    """Distance (m, n step) of (m, n step + 1) from straight lines between every step-th one."""
    ends = coordinates[:, ::step]
    share = (np.arange(step) / step).astype(np.float32)
    lines = ends[:, :-1, None] + (ends[:, 1:] - ends[:, :-1])[:, :, None] * share
    deviation: Single = coordinates[:, :-1] - lines.reshape(len(ends), -1)
    return deviation


def _principal(history: Single, count: int) -> Single:
    """Orthonormal directions (m, count) that carry most of a history (m, nt).

    Randomised subspace iteration (Halko, Martinsson and Tropp, 2011, algorithm 4.4); any
    orthonormal directions serve, good ones leave less to do.
    """
    width = min(history.shape[0], count + OVERSAMPLING)
    sketch = np.random.default_rng(1).standard_normal((history.shape[1], width), dtype=np.float32)
    basis = np.linalg.qr(history @ sketch)[0]
    basis = np.linalg.qr(history @ (history.T @ basis))[0]
    projected = basis.T @ history
    directions = np.linalg.eigh((projected @ projected.T).astype(np.float64))[1]
    leading: Single = basis @ directions[:, ::-1][:, :count].astype(np.float32)
    return leading


def find_peaks(model: ReducedModel, response: ReducedResponse) -> StressPeaks:
    """Find the peak of every element over all samples of a response."""
    plan = plan_search(response.coordinates)
    stress = np.zeros(model.element_count)
    sample = np.zeros(model.element_count, dtype=np.int64)
    evaluated, first = model.element_count * plan.coarse.shape[1], 0
    no_points = np.zeros((len(model.shell_stress), 0, 5), dtype=np.float32)
    for operator, total, points in (
        (model.shell_stress, model.shell_squares, no_points),
        (model.beam_stress, model.beam_squares, model.beam_points),
    ):
        for start in range(0, len(operator), ELEMENT_BLOCK):
            block = slice(start, start + ELEMENT_BLOCK)
            part = np.asarray(operator[block])
            rows = part.reshape(-1, part.shape[2])
            coarse: Single = rows @ plan.coarse
            leading: Single = rows @ plan.directions
            stop = first + len(part)
            evaluated += search_block(
                part,
                np.asarray(total[block]),
                np.asarray(points[block]),
                coarse.reshape(len(part), 6, -1),
                leading.reshape(len(part), 6, -1),
                plan.coordinates,
                plan.deviation,
                plan.rest,
                plan.coarse_largest,
                plan.largest,
                stress[first:stop],
                sample[first:stop],
            )
            first = stop
    sample = np.minimum(sample, len(response.time) - 1)
    return StressPeaks(
        stress=stress,
        sample=sample,
        time=response.time[sample],
        evaluated=evaluated / max(1, model.element_count * len(response.time)),
    )
