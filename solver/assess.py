"""The one public call: a touchdown record in, an assessment out.

Everything that depends on the aircraft alone is loaded once (`load_assessment_model`); a landing
then costs a simulation, a small integration and a search for peaks.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

import numpy as np

from solver import __version__
from solver.aircraft.airframe import load_airframe
from solver.aircraft.assessed_airframe import AssessedAirframe
from solver.aircraft.stored_airframe import load_stored_airframe, store_airframe
from solver.arrays import Array
from solver.assessment import (
    Assessment,
    GearLoad,
    HotSpot,
    PeakField,
    RuleVerdict,
    Timing,
    TouchdownRecord,
)
from solver.errors import RecordError
from solver.inertia_relief.build import reduced_model, stored_model
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import landing_loads
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.response import landing_response
from solver.landing.compilation import compile_kernels as compile_landing
from solver.landing.history import LandingHistory
from solver.landing.sequence import simulate_contacts, until_next
from solver.probability.compilation import compile_kernels as compile_samples
from solver.probability.exceedance import Nominal
from solver.probability.limit_probability import limit_probability
from solver.progress import Progress, silent
from solver.verdict.action import combine
from solver.verdict.gear_loads import gear_loads
from solver.verdict.hot_spots import rank_hot_spots
from solver.verdict.judge import judge, severest
from solver.verdict.makers_rule import MakersRule
from solver.verdict.makers_rule_reader import load_makers_rule
from solver.verdict.rule_findings import apply_rule


@dataclass(frozen=True, slots=True)
class AssessmentModel:
    """An aircraft ready to be assessed."""

    airframe: AssessedAirframe
    reduced: ReducedModel
    makers_rule: MakersRule | None = None

    @property
    def name(self) -> str:
        """Name of the aircraft definition."""
        return self.airframe.definition.name

    @property
    def content_hash(self) -> str:
        """Hash of the aircraft's two files; with the program's version it fixes every answer."""
        return self.airframe.content_hash


def load_assessment_model(
    folder: Path, cache: Path | None, progress: Progress = silent
) -> AssessmentModel:
    """Read an aircraft folder and its reduced model, which is built on first use.

    Parameters
    ----------
    folder : Path
        Holds ``definition.toml`` and the bulk data it names.
    cache : Path, optional
        Folder of stored airframes and reduced models, which processes share; None builds in
        memory.

    Raises
    ------
    ModelError
        The folder cannot be used; says where and why.
    """
    airframe, reduced = None, None
    if cache is not None and (airframe := load_stored_airframe(folder, cache)) is not None:
        reduced = stored_model(airframe, cache)
    if airframe is None or reduced is None:
        whole = load_airframe(folder, progress)
        # Before the reduced model: a rule that cannot be read should not cost a minute first.
        rule = load_makers_rule(folder, whole.definition.makers_rule)
        reduced = reduced_model(whole, cache, progress=progress)
        airframe = whole if cache is None else store_airframe(whole, cache)
    else:
        rule = load_makers_rule(folder, airframe.definition.makers_rule)
    progress("compiling the kernels", 0.0)
    compile_landing()
    compile_samples()
    progress("compiling the kernels", 1.0)
    return AssessmentModel(airframe, reduced, rule)


def assess_landing(
    model: AssessmentModel,
    record: TouchdownRecord,
    progress: Progress = silent,
    *,
    probability_time_budget: float = math.inf,
) -> Assessment:
    """Simulate every contact of a landing, stress the airframe, and judge.

    Parameters
    ----------
    model : AssessmentModel
    record : TouchdownRecord
        With uncertainties of its contacts there is a probability, too.
    progress : Progress, optional
    probability_time_budget : float
        After which the probability is told from fewer samples [s].

    Raises
    ------
    RecordError
        The record asks for something outside the model (loading, attitude, speed).
    SimulationDivergedError
        A contact cannot be simulated.
    EquilibriumError
        The loads on the structure do not balance; a defect of the model, never of the landing.
    """
    if record.aircraft != model.name:
        raise RecordError(f"aircraft is {record.aircraft!r}, the model is {model.name!r}")
    start = perf_counter()
    airframe, definition = model.airframe, model.airframe.definition
    loading = airframe.loading_for(
        record.mass, record.centre_of_gravity, record.fuel, record.payload
    )
    aircraft = airframe.landing_aircraft(loading.factors, record.runway_friction)
    mass = aircraft.total_mass

    clock = _Clock()
    histories: list[LandingHistory] = []
    for history in simulate_contacts(aircraft, record.contacts):
        histories.append(history)
        progress("landing simulation", len(histories) / len(record.contacts))
    clock.lap("simulation")

    reduced = assemble(model.reduced, loading.factors)
    peaks = _PeakEnvelope(airframe)
    residual = 0.0
    stress = []
    for number, history in enumerate(histories):
        progress("airframe stress", number / len(histories))
        response = landing_response(reduced, landing_loads(airframe, history))
        residual = max(residual, response.equilibrium_residual)
        clock.lap("reduced_solution")
        found = find_peaks(model.reduced, response)
        peaks.add(number, found.stress, found.time)
        stress.append(found.stress)
        clock.lap("peak_search")

    field = peaks.field()
    loads = tuple(
        load
        for number, history in enumerate(histories)
        for load in gear_loads(definition.gears, history, number)
    )
    spots = rank_hot_spots(airframe, field) if histories else ()
    likelihood = None
    if histories and record.uncertainties:
        progress("probability", 0.0)
        nominal = Nominal(record, loading, reduced, histories, np.stack(stress))
        exceedance = limit_probability(
            airframe, model.reduced, nominal, time_budget=probability_time_budget
        )
        likelihood = exceedance.landing
        spots = exceedance.of_spots(airframe, spots)
        clock.lap("probability")
    reasons = judge(
        definition, record, mass, histories, loads, spots[0] if spots else None, likelihood
    )
    verdict = severest(reasons)
    rule = judge_by_rule(model, record, histories)
    action, difference = combine(verdict, rule)
    # With no contact to simulate nothing is known, and a zero would read as harmless.
    worst = max((spot.utilisation for spot in spots), default=math.nan)
    return Assessment(
        verdict=verdict,
        action=action,
        rule_difference=difference,
        makers_rule=rule,
        reasons=reasons,
        limit_probability=likelihood,
        driving_contact=_driving_contact(spots, loads),
        worst_utilisation=worst,
        worst_margin=math.inf if worst == 0.0 else 1.0 / worst - 1.0,
        hot_spots=spots,
        gear_loads=loads,
        peak_normal_load_factor=max(
            (float(h.normal_load_factor.max()) for h in histories), default=math.nan
        ),
        energy_error=max((h.energy.closure_error for h in histories), default=math.nan),
        equilibrium_residual=residual if histories else math.nan,
        notes=(*loading.notes, *_limits_of(record, histories)),
        model_hash=model.content_hash,
        program_version=__version__,
        timing=Timing(
            simulation=clock.seconds["simulation"],
            reduced_solution=clock.seconds["reduced_solution"],
            peak_search=clock.seconds["peak_search"],
            probability=clock.seconds["probability"],
            total=perf_counter() - start,
        ),
        peak_field=field if histories else None,
        histories=tuple(histories),
    )


def judge_by_rule(
    model: AssessmentModel, record: TouchdownRecord, histories: Sequence[LandingHistory] = ()
) -> RuleVerdict | None:
    """Hold a landing against the maker's rule alone; it needs no simulation, but gains by it."""
    if model.makers_rule is None:
        return None
    return apply_rule(model.makers_rule, model.airframe.definition, record, histories)


class _Clock:
    """Wall-clock seconds between laps, summed by name."""

    def __init__(self) -> None:
        steps = ("simulation", "reduced_solution", "peak_search", "probability")
        self.seconds = dict.fromkeys(steps, 0.0)
        self._last = perf_counter()

    def lap(self, name: str) -> None:
        now = perf_counter()
        self.seconds[name] += now - self._last
        self._last = now


class _PeakEnvelope:
    """Largest stress of every element over the contacts added so far."""

    def __init__(self, airframe: AssessedAirframe) -> None:
        self._airframe = airframe
        count = len(airframe.allowables)
        self._stress = np.zeros(count)
        self._time = np.zeros(count)
        self._contact = np.zeros(count, dtype=np.int64)

    def add(self, contact: int, stress: Array, time: Array) -> None:
        larger = stress > self._stress
        self._stress[larger] = stress[larger]
        self._time[larger] = time[larger]
        self._contact[larger] = contact

    def field(self) -> PeakField:
        return PeakField(
            element_identifiers=self._airframe.element_identifiers,
            stress=self._stress,
            utilisation=self._stress / self._airframe.allowables,
            time=self._time,
            contact=self._contact,
        )


def _driving_contact(spots: tuple[HotSpot, ...], loads: tuple[GearLoad, ...]) -> int | None:
    """Contact of whatever came closest to its limit, airframe or gear."""
    used = [(spot.utilisation, spot.contact) for spot in spots]
    used += [(load.utilisation, load.contact) for load in loads]
    return max(used, default=(0.0, None), key=lambda pair: pair[0])[1]


def _limits_of(record: TouchdownRecord, histories: list[LandingHistory]) -> list[str]:
    """Return what was assumed, and what this assessment cannot speak for."""
    notes = []
    for number, (contact, history) in enumerate(
        zip(record.contacts, histories, strict=True), start=1
    ):
        lift = contact.lift
        notes.append(
            f"contact {number}: lift {lift.model}, {lift.fraction:.2f} of the weight at contact"
            + (
                ""
                if lift.model == "held"
                else f", decaying after {lift.decay_start:.2f} s with a time constant of "
                f"{lift.decay_time:.2f} s to {lift.residual_fraction:.2f}"
            )
        )
        touched = {stay.gear for stay in history.contacts}
        notes += [
            f"contact {number}: {gear.name} did not touch within {history.time[-1]:.1f} s; its "
            "touchdown is not assessed"
            for gear in history.gears
            # What has not touched by the next contact is looked for there.
            if gear.name not in touched and math.isinf(until_next(record.contacts, number - 1))
        ]
    if record.runway_friction is not None:
        notes.append(f"runway friction {record.runway_friction:.2f}, as recorded")
    notes.append("not assessed: landing-gear internals, fatigue, pre-existing damage, repairs")
    return notes
