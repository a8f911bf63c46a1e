"""Whether samples of a landing exceed a limit, and where.

Every sample is a whole landing: simulated with its own state, lift, gears and friction, its loads
put on the watched elements of the airframe with its own loading.  Steps are twice those of the
assessment and the W terms are left out (`solver.probability.watched_stress`); what that changes is
known for the landing as recorded, element by element and gear by gear, and taken off every sample.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from solver.aircraft.assessed_airframe import AssessedAirframe
from solver.aircraft.loading import Loading
from solver.arrays import Array, IntArray
from solver.assessment import TouchdownRecord
from solver.errors import SimulationDivergedError
from solver.inertia_relief.loading import ReducedLoading, assemble
from solver.inertia_relief.loads import LandingLoads, landing_loads
from solver.inertia_relief.reduced import ReducedModel
from solver.landing.aircraft import LandingAircraft
from solver.landing.batch import simulate_landings
from solver.landing.history import LandingHistory
from solver.landing.sequence import passage
from solver.landing.simulate import SimulationOptions
from solver.probability.corner import corners
from solver.probability.loadings import CENTRE, loading_points
from solver.probability.variables import LandingVariables, Sample
from solver.probability.watched_stress import WatchedRows, WatchedStress, watch, watched_stress
from solver.verdict.gear_loads import gear_loads

#: Of every sample: twice the steps of the assessment, and as long as a hop and its landing last.
#: Nobody steers the simulated aircraft; later it turns away by what yaw and drift a sample gave it,
#: and the side loads of that are none of the touchdown's.
SAMPLE_OPTIONS = SimulationOptions(output_interval=2e-3, time_limit=2.5)
#: Largest share by which the samples' coarser path may be put right.
LARGEST_CORRECTION = 0.01


@dataclass(frozen=True, slots=True)
class Utilisations:
    """Peak over limit in some samples, the largest of the contacts; inf: not to be simulated."""

    airframe: Array  #: (samples, n) of the watched elements, by their strength in each sample
    gears: Array  #: (samples, n_gears) ground loads over their design limits

    @property
    def largest(self) -> Array:
        """Of anything in each sample (samples,)."""
        return np.asarray(np.maximum(self.airframe.max(axis=1), self.gears.max(axis=1)))


@dataclass(frozen=True, slots=True)
class Nominal:
    """The landing as recorded, assessed in full."""

    record: TouchdownRecord
    loading: Loading
    reduced: ReducedLoading
    histories: Sequence[LandingHistory]  #: one for each contact
    stress: Array  #: (contacts, ne) peaks [Pa]


class LandingSampler:
    """Samples of one landing of one aircraft."""

    def __init__(
        self,
        airframe: AssessedAirframe,
        model: ReducedModel,
        nominal: Nominal,
        threads: int | None = None,
    ) -> None:
        self.airframe = airframe
        self.nominal = nominal
        self.variables = LandingVariables(airframe, nominal.record)
        self._model = model
        self._threads = threads
        self._points = loading_points(airframe, nominal.record, nominal.loading)
        # Every sample's wheels turn as those of the landing as recorded: they follow the runway.
        befores = [None, *nominal.histories[:-1]]
        self._passages = [
            passage(nominal.record.contacts, number, before)
            for number, before in enumerate(befores)
        ]

    @cached_property
    def _aircraft(self) -> list[LandingAircraft]:
        friction = self.nominal.record.runway_friction
        return [
            self.airframe.landing_aircraft(factors, friction) for factors in self._points.factors
        ]

    def simulate(
        self,
        samples: Sequence[Sample],
        contacts: Sequence[int],
        keep: Callable[[int, int, LandingHistory], Array],
        point: int | None = None,
    ) -> list[list[Array | SimulationDivergedError]]:
        """Simulate some contacts of every sample; one list for each sample.

        Parameters
        ----------
        keep : callable
            Takes the places of sample and contact, and the history.
        point : int, optional
            Loading point of all samples, in place of their own.
        """
        landings = [
            (
                sample.aircraft(self._aircraft[sample.point if point is None else point]),
                sample.contacts[number],
            )
            for sample in samples
            for number in contacts
        ]
        width = len(contacts)
        passages = [self._passages[number] for number in contacts] * len(samples)
        kept = simulate_landings(
            landings,
            lambda place, history: keep(place // width, contacts[place % width], history),
            SAMPLE_OPTIONS,
            self._threads,
            passages,
        )
        return [kept[first : first + width] for first in range(0, len(kept), width)]

    def loading_at(self, point: int) -> ReducedLoading:
        """Modes of one of the loading points."""
        if point == CENTRE:
            return self.nominal.reduced
        return assemble(self._model, self._points.factors[point])

    def corners(self, number: int, *, mirrored: bool = False) -> list[Array]:
        """List a contact's corners as standard normal variables (count,), stress first."""
        contact = self.nominal.record.contacts[number]
        return list(corners(self.variables, contact, number, mirrored=mirrored))

    def watch(self, elements: IntArray, contacts: Sequence[int]) -> "WatchedLanding":
        """Prepare the stress of some elements in samples of some contacts."""
        return WatchedLanding(self, elements, contacts)


class WatchedLanding:
    """Stress of watched elements in every sample of some contacts of a landing."""

    def __init__(
        self, sampler: LandingSampler, elements: IntArray, contacts: Sequence[int]
    ) -> None:
        airframe, nominal = sampler.airframe, sampler.nominal
        self.sampler = sampler
        self.contacts = tuple(contacts)
        self.rows: WatchedRows = watch(nominal.reduced.model, elements)
        self.allowables = airframe.allowables[self.rows.elements]
        self.zones = airframe.element_zone[self.rows.elements]
        loads: dict[int, LandingLoads] = {}
        gears: dict[int, Array] = {}
        self._examples: list[LandingLoads] = []

        def keep(place: int, number: int, history: LandingHistory) -> Array:
            example = landing_loads(airframe, history)
            self._examples.append(example)
            if place == 0:
                loads[number], gears[number] = example, gear_utilisations(airframe, history)
            return example.time

        for number in self.contacts:
            # A level landing's own motion would say that nothing unsymmetrical matters.
            far = [sampler.variables.sample(z) for z in sampler.corners(number)]
            recorded = Sample.as_recorded(nominal.record.contacts, airframe.definition)
            sampler.simulate([recorded, *far], [number], keep, point=CENTRE)
        used = nominal.stress[:, self.rows.elements] / self.allowables
        self._largest = float(used[list(self.contacts)].max())
        self._stress = {CENTRE: self._at(nominal.reduced)}
        self._corrections: dict[int, tuple[Array, Array]] = {}
        for number, example in loads.items():
            full = nominal.stress[number, self.rows.elements]
            self._corrections[number] = (
                _correction(full, self._stress[CENTRE].peaks(example)),
                _correction(gear_utilisations(airframe, nominal.histories[number]), gears[number]),
            )

    def _at(self, loading: ReducedLoading) -> WatchedStress:
        return watched_stress(loading, self.rows, self.allowables, self._examples, self._largest)

    def utilisations(self, samples: Sequence[Sample]) -> Utilisations:
        """Simulate samples and search their peaks."""
        for point in sorted({sample.point for sample in samples} - set(self._stress)):
            self._stress[point] = self._at(self.sampler.loading_at(point))

        airframe = self.sampler.airframe

        def keep(place: int, number: int, history: LandingHistory) -> Array:
            sample = samples[place]
            loads = landing_loads(airframe, history)
            stress = self._stress[sample.point].peaks(loads, sample.structural_damping)
            by_element, by_gear = self._corrections[number]
            strength = self.allowables * sample.zone_strength[self.zones]
            gears = gear_utilisations(airframe, history) * by_gear
            return np.concatenate([stress * by_element / strength, gears])

        count = len(self.allowables)
        found = np.empty((len(samples), count + len(airframe.definition.gears)))
        for row, by_contact in zip(
            found, self.sampler.simulate(samples, self.contacts, keep), strict=True
        ):
            # What cannot be simulated is never taken for harmless.
            row[:] = np.max(
                [
                    np.full(len(row), np.inf) if isinstance(each, SimulationDivergedError) else each
                    for each in by_contact
                ],
                axis=0,
            )
        return Utilisations(found[:, :count], found[:, count:])


def gear_utilisations(airframe: AssessedAirframe, history: LandingHistory) -> Array:
    """Largest ground load of each gear over its design limit (n_gears,)."""
    loads = gear_loads(airframe.definition.gears, history, 0)
    return np.array([load.utilisation for load in loads])


def _correction(full: Array, coarse: Array) -> Array:
    """Factors from the samples' path to the full one."""
    ratio = np.divide(full, coarse, out=np.ones_like(full), where=coarse > 0.0)
    return np.clip(ratio, 1.0 - LARGEST_CORRECTION, 1.0 + LARGEST_CORRECTION)
