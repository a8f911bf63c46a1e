"""Full-order peaks in the limit of small steps, and how far from it they may still be.

The same landings are integrated at several step sizes and their displacements are combined sample
by sample, before any stress is taken from them.  Combined peaks would not do: a peak is the
largest of many samples, and with the step it jumps from one cycle of a vibration to another.

The combination leaves out the powers of the step that as many solutions can tell apart.  Newmark's
average acceleration has even powers only: it is symmetric in time.  By how much the combination of
all but the longest steps differs is the estimate of its error.

Sources: Richardson, "The deferred approach to the limit", 1927; Hairer, Lubich and Wanner,
"Geometric Numerical Integration", 2006, section V.2 (even powers).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Array
from solver.inertia_relief.accumulate import PeakAccumulator
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.free_body import FreeBody
from solver.inertia_relief.full_order import BlockConsumer, BodyLoads, integrate_together
from solver.progress import Progress, silent

if TYPE_CHECKING:
    from solver.fe.stress import StressRecovery


@dataclass(frozen=True, slots=True)
class ConvergedPeaks:
    """Peaks of landings of one loading."""

    stress: Array  #: (landings, ne) in the limit [Pa]
    error: Array  #: (landings, ne) change by the longest steps' solution, relative to the peak


def limit_weights(substeps: Sequence[int]) -> Array:
    """Weights (k,) of solutions with so many steps in a sample, for their limit of small steps.

    Lagrange's polynomial in the square of the step, at zero.
    """
    squares = 1.0 / np.asarray(substeps, dtype=np.float64) ** 2
    weights = np.ones(len(squares))
    for i, square in enumerate(squares):
        others = np.delete(squares, i)
        weights[i] = np.prod(others / (others - square))
    return weights


def converged_peaks(
    body: FreeBody,
    landings: Sequence[BodyLoads],
    damping: RayleighDamping,
    recovery: "StressRecovery",
    substeps: Sequence[int],
    tolerance: float,
    progress: Progress = silent,
) -> ConvergedPeaks:
    """Integrate at every step size, combine, and find the peaks at the samples of the loads.

    Parameters
    ----------
    substeps : sequence of int
        Steps between two samples, ascending, three or more.
    tolerance : float
        See `integrate_full_order`.

    Notes
    -----
    Two sums of histories are kept whole: 16 bytes a freedom, sample and landing.
    """
    weights = np.stack([limit_weights(substeps), np.append(0.0, limit_weights(substeps[1:]))])
    shape = (2, len(body.rigid_modes), len(landings[0].time))
    sums = [np.zeros(shape) for _ in landings]
    peaks = [(PeakAccumulator(recovery), PeakAccumulator(recovery)) for _ in landings]

    def consumer(landing: int, order: int) -> BlockConsumer:
        is_last = order == len(substeps) - 1

        def consume(first: int, displacements: Array) -> None:
            part = slice(first, first + displacements.shape[1])
            for history, weight, found in zip(
                sums[landing], weights[:, order], peaks[landing], strict=True
            ):
                history[:, part] += weight * displacements
                if is_last:
                    found(first, history[:, part])

        return consume

    for order, count in enumerate(substeps):
        integrate_together(
            body,
            landings,
            damping,
            [consumer(landing, order) for landing in range(len(landings))],
            count,
            tolerance,
            progress=progress,
        )
    limit, other = (np.stack([each[k].stress for each in peaks]) for k in range(2))
    return ConvergedPeaks(limit, np.abs(other / np.where(limit > 0.0, limit, np.inf) - 1))
