"""Probability that a landing exceeded a limit, as cheaply as it can be told.

1. Contacts whose pessimistic corners (`solver.probability.corner`) stay below every limit are
   settled, and if all are, the probability is reported as zero with the bound that this leaves.
2. The others are sampled.  The first replicate of `FIRST` samples settles it if every limit lies
   far above all of them: of any unimodal distribution at most 4 / (9 (1 + k^2)) lies beyond k
   standard deviations (Vysochanskij and Petunin, "Justification of the 3 sigma rule for unimodal
   distributions", Theory of Probability and Mathematical Statistics 21, 1980, one tail).
3. If not, `REPLICATES` of that size are taken together.

All samples of a landing vary its contacts together.  It exceeds if any watched element or gear does
in any contact.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from solver.aircraft.airframe import Airframe
from solver.arrays import Array, IntArray
from solver.assessment import HotSpot, LimitProbability, ProbabilityBasis
from solver.errors import SimulationDivergedError
from solver.inertia_relief.loads import landing_loads
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.response import landing_response
from solver.landing.history import LandingHistory
from solver.probability.corner import BOUND, CLEAR_UTILISATION, corners
from solver.probability.estimate import estimate
from solver.probability.exceedance import (
    LandingSampler,
    Nominal,
    Utilisations,
    WatchedLanding,
    gear_utilisations,
)
from solver.probability.loadings import CENTRE
from solver.probability.normals import seed_of, sobol_normals

#: Samples of a replicate, and replicates.
FIRST, REPLICATES = 32, 8
#: Largest probability at which the first replicate settles the matter.
SETTLED = 0.02
#: Share of the most used element's utilisation from which an element is watched, and what that
#: utilisation counts at most: in a hard landing many exceed.
WATCHED_SHARE, WATCHED_CEILING = 0.7, 1.1
#: Elements that are watched at most, the most used ones.
WATCHED_LIMIT = 256


@dataclass(frozen=True, slots=True)
class Exceedance:
    """Answer for the landing and for every zone that was watched."""

    landing: LimitProbability
    zones: dict[int, tuple[float, float]]  #: index to probability and its standard error

    def of_spots(self, airframe: Airframe, spots: Sequence[HotSpot]) -> tuple[HotSpot, ...]:
        """Hot spots with the probability of their zones; zero where none was worth watching."""
        names = {zone.name: index for index, zone in enumerate(airframe.definition.zones)}
        unwatched = (0.0, self.landing.standard_error)
        found = (self.zones.get(names[spot.zone], unwatched) for spot in spots)
        return tuple(
            replace(spot, probability_limit_exceeded=value, probability_standard_error=error)
            for spot, (value, error) in zip(spots, found, strict=True)
        )


def limit_probability(
    airframe: Airframe, model: ReducedModel, nominal: Nominal, threads: int | None = None
) -> Exceedance:
    """Propagate a record's uncertainty and the aircraft's scatter.

    Parameters
    ----------
    airframe : Airframe
    model : ReducedModel
    nominal : Nominal
        The landing as recorded; its record says how well each contact is known.
    threads : int, optional
        All available cores by default.

    Raises
    ------
    RecordError
        There is not one uncertainty for each contact.
    """
    sampler = LandingSampler(airframe, model, nominal, threads)
    numbers = range(len(nominal.record.contacts))
    tried = [_corner_peaks(sampler, number) for number in numbers]
    open_contacts = [
        number
        for number, (stress, gear) in zip(numbers, tried, strict=True)
        if max(gear, float((stress / airframe.allowables).max())) >= CLEAR_UTILISATION
    ]
    if not open_contacts:
        bound = min(1.0, BOUND * len(numbers))
        return Exceedance(
            LimitProbability(0.0, bound, 0.0, bound, 2 * len(numbers), 0, ProbabilityBasis.CORNERS),
            {},
        )
    designs = [nominal.stress[open_contacts].max(axis=0)]
    for number in open_contacts:
        designs += [tried[number][0], _corner_peaks(sampler, number, mirrored=True)[0]]
    elements = chosen_elements([design / airframe.allowables for design in designs])
    return _sampled(sampler, sampler.watch(elements, open_contacts))


def _corner_peaks(
    sampler: LandingSampler, number: int, *, mirrored: bool = False
) -> tuple[Array, float]:
    """Peaks (ne,) of every element [Pa] and the gears' largest utilisation in a contact's corners.

    A corner that cannot be simulated is taken for one that exceeds everything.
    """
    contact = sampler.nominal.record.contacts[number]
    both = corners(sampler.variables, contact, number, mirrored=mirrored)
    samples = [sampler.variables.sample(normals) for normals in both]
    airframe, reduced = sampler.airframe, sampler.nominal.reduced

    def keep(place: int, _: int, history: LandingHistory) -> Array:
        response = landing_response(reduced, landing_loads(airframe, history))
        strength = samples[place].zone_strength[airframe.element_zone]
        peaks = find_peaks(reduced.model, response).stress / strength
        return np.append(peaks, gear_utilisations(airframe, history).max())

    found = [
        each
        for (each,) in sampler.simulate(samples, [number], keep, point=CENTRE)
        if not isinstance(each, SimulationDivergedError)
    ]
    if len(found) < len(samples):
        return np.full(len(airframe.allowables), np.inf), np.inf
    largest = np.max(found, axis=0)
    return largest[:-1], float(largest[-1])


def chosen_elements(utilisations: Sequence[Array]) -> IntArray:
    """Elements worth watching, from the utilisations (ne,) of the landing and its corners.

    Those that reach `WATCHED_SHARE` of the most used one's in any of them: an element that stays
    that far below another in all of them does not exceed its limit before the other does.
    """
    score = np.zeros(len(utilisations[0]))
    for utilisation in utilisations:
        if np.all(np.isfinite(utilisation)):
            score = np.maximum(score, utilisation / min(utilisation.max(), WATCHED_CEILING))
    order = np.argsort(-score, kind="stable")[:WATCHED_LIMIT]
    return np.sort(order[score[order] >= WATCHED_SHARE])


def _sampled(sampler: LandingSampler, watched: WatchedLanding) -> Exceedance:
    variables = sampler.variables
    seed = seed_of(repr(sampler.nominal.record))
    normals = sobol_normals(variables.count, REPLICATES, FIRST, seed)
    first = watched.utilisations([variables.sample(row) for row in normals[0]])
    beyond = _unimodal_bound(first.largest)
    if beyond <= SETTLED:
        return Exceedance(
            LimitProbability(0.0, beyond, 0.0, beyond, FIRST, 0, ProbabilityBasis.FIRST_SAMPLES),
            {},
        )
    others = normals[1:].reshape(-1, variables.count)
    rest = watched.utilisations([variables.sample(row) for row in others])
    return _estimated(watched, [first, rest])


def _unimodal_bound(largest: Array) -> float:
    """Largest probability beyond 1 of a unimodal distribution with these samples' moments."""
    if not largest.max() < CLEAR_UTILISATION:
        return 1.0
    deviations = (1.0 - largest.mean()) / max(float(largest.std(ddof=1)), 1e-12)
    return float(4.0 / (9.0 * (1.0 + deviations**2)))


def _estimated(watched: WatchedLanding, parts: Sequence[Utilisations]) -> Exceedance:
    airframe = np.concatenate([part.airframe for part in parts]) > 1.0
    largest = np.concatenate([part.largest for part in parts])
    shape = (REPLICATES, FIRST)
    whole = estimate((largest > 1.0).reshape(shape))
    zones = {}
    for zone in np.unique(watched.zones).tolist():
        found = estimate(airframe[:, watched.zones == zone].any(axis=1).reshape(shape))
        zones[zone] = (found.probability, found.standard_error)
    return Exceedance(
        LimitProbability(
            probability=whole.probability,
            standard_error=whole.standard_error,
            lower=whole.lower,
            upper=whole.upper,
            samples=len(largest),
            failed=int(np.isinf(largest).sum()),
            basis=ProbabilityBasis.SAMPLES,
        ),
        zones,
    )
