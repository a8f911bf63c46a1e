"""What each method says of one recording; numbers only, whoever calls judges them.

All methods see the same recording.  The rules of today's practice are given the true instant of
the contact, which they would have to find; ours are given the window and nothing else.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from solver.assess import AssessmentModel, assess_landing
from solver.assessment import RuleStatus, TouchdownRecord, Verdict
from solver.assimilation.assimilate import Assimilation
from solver.assimilation.parameters import GAS_PRESSURE, SERVICE_PARAMETERS
from solver.errors import SolverError
from solver.flight_data.geometry import Installation, geometry_on_gears
from solver.flight_data.parameter import Parameter
from solver.flight_data.window import Window
from solver.recorded import RecordedContact, RecordedPeak
from solver.verdict.judge import SEVERITY
from solver.verdict.rule_findings import apply_rule
from verification.judging.accidents import largest_utilisation
from verification.judging.flight import FlownLanding
from verification.judging.given_truth import is_near_limit, uses_by_knowledge
from verification.judging.reading import Reading, read_window, recorded_mass
from verification.judging.use_of_limits import UseOfLimits

#: Use of a limit below or above which, by truth and by the estimate, the long methods are left out.
CLEARLY_SOUND, CLEARLY_HARD = 0.6, 1.8
#: Of those landings every so many is given to the long methods all the same.
CHECKED = 5

#: Share of the limit where the rule asks for an inspection whatever was recorded.
_BEYOND_THE_RULE = 9.0

#: Of a measured coefficient of friction.
FRICTION_SD = 0.03

#: Least span of the difference of radio altitude [s].
_NEARLY_A_SECOND = 0.95

#: About the contact in which a rule looks for the recorded peak [s].
_PEAK_SPAN = (-0.5, 6.0)


@dataclass(frozen=True, slots=True)
class Recorder:
    """A recorder by its frame, and the rate of its normal acceleration."""

    frame: str  #: name of a packaged frame
    rate: float  #: [Hz]

    @property
    def name(self) -> str:
        """How tables call it."""
        return f"{self.rate:g} Hz"


@dataclass(frozen=True, slots=True)
class RuleAnswers:
    """Today's practice."""

    load_factor_share: float  #: recorded increment over the rule's limiting increment
    is_over_load_factor: bool
    sink_difference: float  #: of radio altitude over the last second [m/s]


@dataclass(frozen=True, slots=True)
class Answers:
    """One landing's truth and what the methods made of its recording."""

    number: int
    kind: str
    weight: float
    rate: float  #: of the recorder's normal acceleration [Hz]
    sink_rate: float  #: true, at the centre of gravity and first contact [m/s]
    utilisation: float  #: true
    load_factor_share: float
    is_over_load_factor: bool
    sink_difference: float
    undetermined: str  #: why the window carries no verdict, or ""
    contacts: int  #: found
    sink_estimate: float | None = None  #: at the first contact [m/s]
    estimate: float | None = None  #: use of a limit by the smoother's state
    is_held: bool = True  #: verdict by the estimate is INSPECT or more
    is_complete: bool = False  #: the long methods were run
    sink_corrected: float | None = None  #: after assimilation [m/s]
    corrected: float | None = None  #: use of a limit by the state after assimilation
    is_unexplained: bool = False  #: the recorded response cannot be explained
    probability: float | None = None  #: that a limit is exceeded, by state and covariance after it
    probability_on_runway: float | None = None  #: the same where the runway's friction is known
    is_unexplained_on_runway: bool = False
    #: Near the limit, use of a limit by what is known (`verification.judging.knowledge`).
    knowledge: dict[str, float] = field(default_factory=dict)
    #: Deviation of what the aircraft was like after assimilation over that before, by parameter.
    learned: dict[str, float] = field(default_factory=dict)


def believed_installation(model: AssessmentModel) -> Installation:
    """Where the sensors are believed to be."""
    airframe = model.airframe
    aircraft = airframe.landing_aircraft(airframe.loading_for().factors)
    geometry = geometry_on_gears(
        aircraft.gears, aircraft.total_centre_of_gravity, aircraft.total_mass
    )
    return geometry.installation


def answer(
    use: UseOfLimits,
    flown: FlownLanding,
    installation: Installation,
    recorders: Sequence[Recorder],
    own: int,
) -> Answers:
    """Give a recording to every method.

    Parameters
    ----------
    use : UseOfLimits
    flown : FlownLanding
    installation : Installation
        Where the sensors are believed to be.
    recorders : sequence of Recorder
        Of the landing's windows.
    own : int
        The one that the methods see; the others say what a better one would have told.
    """
    model, drawn, window = use.model, flown.drawn, flown.windows[own]
    rules = rule_answers(model, window)
    answers = Answers(
        number=drawn.number,
        kind=drawn.kind,
        weight=drawn.weight,
        rate=recorders[own].rate,
        sink_rate=flown.contact.sink_rate,
        utilisation=flown.utilisation,
        load_factor_share=rules.load_factor_share,
        is_over_load_factor=rules.is_over_load_factor,
        sink_difference=rules.sink_difference,
        undetermined="",
        contacts=0,
    )
    reading = read_window(model, window, installation)
    if reading.is_silent:
        return replace(answers, undetermined=reading.found.cannot_tell[0].code)
    record = reading.record(model)
    try:
        assessment = assess_landing(model, record)
        answers = replace(
            answers,
            contacts=len(record.contacts),
            sink_estimate=record.contacts[0].sink_rate,
            estimate=largest_utilisation(assessment),
            is_held=SEVERITY[assessment.verdict] >= SEVERITY[Verdict.INSPECT],
        )
        used = (answers.utilisation, largest_utilisation(assessment))
        is_clear = max(used) < CLEARLY_SOUND or min(used) > CLEARLY_HARD
        if is_clear and drawn.number % CHECKED:
            return answers
        updated = reading.assimilated(model)
        answers = _with_assimilation(model, answers, record, updated)
        answers = _with_friction(model, answers, reading, flown)
        if is_near_limit(flown.utilisation):
            readings = {}
            for place, recorder in enumerate(recorders):
                each, after = reading, updated
                if place != own:
                    each = read_window(model, flown.windows[place], installation)
                    if each.is_silent:
                        continue
                    after = each.assimilated(model)
                readings[recorder.name] = (each, after)
            answers = replace(answers, knowledge=uses_by_knowledge(use, flown, readings))
    except SolverError as error:
        return replace(answers, undetermined=type(error).__name__)
    return answers


def _with_assimilation(
    model: AssessmentModel, answers: Answers, record: TouchdownRecord, updated: Assimilation
) -> Answers:
    """Add what the recorded response makes of it."""
    contacts = updated.contacts
    assessment = assess_landing(
        model, replace(record, contacts=contacts, uncertainties=updated.uncertainties)
    )
    return replace(
        answers,
        is_complete=True,
        sink_corrected=contacts[0].sink_rate,
        corrected=largest_utilisation(assessment),
        is_unexplained=bool(updated.unexplained),
        probability=assessment.probability_limit_exceeded,
        learned=_learned(updated),
    )


def _with_friction(
    model: AssessmentModel, answers: Answers, reading: Reading, flown: FlownLanding
) -> Answers:
    """Add what is made of the recording where the runway's friction was measured."""
    true = flown.aircraft.gears[0].tyre.maximum_friction
    error = np.random.default_rng([flown.drawn.seed, 1]).standard_normal()
    measured = max(true + FRICTION_SD * float(error), FRICTION_SD)
    updated = reading.assimilated(model, (measured, FRICTION_SD))
    record = replace(
        reading.record(model),
        contacts=updated.contacts,
        uncertainties=updated.uncertainties,
        runway_friction=measured,
        runway_friction_deviation=FRICTION_SD,
    )
    assessment = assess_landing(model, record)
    return replace(
        answers,
        probability_on_runway=assessment.probability_limit_exceeded,
        is_unexplained_on_runway=bool(updated.unexplained),
    )


def _learned(updated: Assimilation) -> dict[str, float]:
    """Deviation of each parameter of the aircraft after its response over that before."""
    first = updated.updates[0]
    if first.corrected is None or not first.is_corrected:
        return {}
    return {
        each.name: each.posterior_sd / each.prior_sd
        for each in first.corrected.parameters
        if each.name in SERVICE_PARAMETERS or each.name.startswith(GAS_PRESSURE)
    }


def rule_answers(model: AssessmentModel, window: Window) -> RuleAnswers:
    """Hold a recording against the maker's load factor and the design sink rate.

    Raises
    ------
    ValueError
        The window has no normal acceleration or radio altitude, or the aircraft no rule.
    """
    normal = window.first(Parameter.NORMAL_ACCELERATION)
    roll = window.first(Parameter.ROLL)
    if normal is None or roll is None or model.makers_rule is None:
        raise ValueError("the load-factor rule needs normal acceleration, roll and a maker's rule")
    inside = (normal.time > _PEAK_SPAN[0]) & (normal.time < _PEAK_SPAN[1])
    peak = float(normal.value[inside].max())
    contact = RecordedContact(
        normal_load_factor=RecordedPeak(peak, normal.rate),
        roll=float(np.interp(0.0, roll.time, roll.value)),
        nose_first=False,
    )
    record = TouchdownRecord(model.name, (), mass=recorded_mass(model, window), recorded=(contact,))
    verdict = apply_rule(model.makers_rule, model.airframe.definition, record)
    finding = next(f for f in verdict.findings if f.criterion == "normal load factor")
    limit = finding.limit or 0.0
    return RuleAnswers(
        load_factor_share=(peak - 1.0) / (limit - 1.0) if limit > 1.0 else _BEYOND_THE_RULE,
        is_over_load_factor=finding.status is RuleStatus.EXCEEDED,
        sink_difference=_differenced(window),
    )


def _differenced(window: Window) -> float:
    """Fall of the radio altitude over the last second before the contact [m/s]."""
    samples = np.array(
        sorted(
            (time, value)
            for channel in window.of(Parameter.RADIO_ALTITUDE)
            for time, value in zip(channel.time, channel.value, strict=True)
            if time <= 0.0
        )
    )
    last = samples[-1]
    before = samples[samples[:, 0] <= last[0] - _NEARLY_A_SECOND][-1]
    return float((before[1] - last[1]) / (last[0] - before[0]))
