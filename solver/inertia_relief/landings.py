"""From loads to every element's peak: one landing, or many of one loading that share its modes.

Both go the same way, landing by landing; many at once find the modes of their loading once, and
read every block of stress once for several of them.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice

from numpy.typing import ArrayLike

from solver.arrays import Array
from solver.inertia_relief.loading import ReducedLoading, assemble
from solver.inertia_relief.loads import LandingLoads
from solver.inertia_relief.peaks import LANDINGS_AT_ONCE, StressPeaks, find_peaks_together
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.response import landing_response


@dataclass(frozen=True, slots=True)
class LandingPeaks:
    """Peaks of one landing."""

    peaks: StressPeaks
    equilibrium_residual: float  #: see `solver.inertia_relief.loads.equilibrium_residual`


def landing_peaks(
    model: ReducedModel, factors: Array, loads: LandingLoads, floor: ArrayLike = 0.0
) -> LandingPeaks:
    """Peaks of one landing; see `peaks_of_landings`."""
    return next(peaks_of_landings(assemble(model, factors), [loads], floor))


def peaks_of_landings(
    loading: ReducedLoading, landings: Iterable[LandingLoads], floor: ArrayLike = 0.0
) -> Iterator[LandingPeaks]:
    """Peaks of landings of one loading, in their order.

    Landings are taken from the iterable `LANDINGS_AT_ONCE` at a time, so that there may be any
    number of them.

    Parameters
    ----------
    floor : float or (ne,) array
        See `solver.inertia_relief.peaks.find_peaks`.

    Raises
    ------
    EquilibriumError, ModelError
        See `landing_response` and `find_peaks`.
    """
    waiting = iter(landings)
    while some := list(islice(waiting, LANDINGS_AT_ONCE)):
        responses = [landing_response(loading, loads) for loads in some]
        found = find_peaks_together(loading.model, responses, floor)
        for response, peaks in zip(responses, found, strict=True):
            yield LandingPeaks(peaks, response.equilibrium_residual)
