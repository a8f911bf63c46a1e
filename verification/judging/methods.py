"""What each method says of one recording; numbers only, whoever calls judges them.

All methods see the same recording.  The rules of today's practice are given the true instant of
the contact, which they would have to find; ours are given the window and nothing else.
"""

from dataclasses import dataclass, replace

import numpy as np

from solver.assess import AssessmentModel, assess_landing
from solver.assessment import RuleStatus, TouchdownRecord, Verdict
from solver.assimilation.assimilate import FOLLOWING, Assimilation, assimilate, contact_of
from solver.assimilation.parameters import ServiceScatter
from solver.errors import SolverError
from solver.flight_data.contacts import ContactKind
from solver.flight_data.geometry import Geometry, Installation, geometry_on_gears
from solver.flight_data.parameter import Parameter
from solver.flight_data.reconstruction import reconstruct
from solver.flight_data.window import Window
from solver.landing.aircraft import LandingAircraft
from solver.recorded import RecordedContact, RecordedPeak
from solver.verdict.judge import SEVERITY
from solver.verdict.rule_findings import apply_rule
from verification.judging.accidents import largest_utilisation
from verification.judging.flight import FlownLanding, utilisation_of

#: Use of a limit below or above which, by truth and by the estimate, the long methods are left out.
CLEARLY_SOUND, CLEARLY_HARD = 0.6, 1.8
#: Of those landings every so many is given to the long methods all the same.
CHECKED = 5

#: Of a recorded gross mass, relative (the computed mass of an airliner is good to about 1 %).
MASS_DEVIATION = 0.01

#: Share of the limit where the rule asks for an inspection whatever was recorded.
_BEYOND_THE_RULE = 9.0

#: Least span of the difference of radio altitude [s].
_NEARLY_A_SECOND = 0.95

#: About the contact in which a rule looks for the recorded peak [s].
_PEAK_SPAN = (-0.5, 6.0)


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
    with_true_state: float | None = None  #: true contact, aircraft as defined, recorded mass
    with_true_aircraft: float | None = None  #: state after assimilation, aircraft as it was


def believed_installation(model: AssessmentModel) -> Installation:
    """Where the sensors are believed to be."""
    airframe = model.airframe
    aircraft = airframe.landing_aircraft(airframe.loading_for().factors)
    geometry = geometry_on_gears(
        aircraft.gears, aircraft.total_centre_of_gravity, aircraft.total_mass
    )
    return geometry.installation


def answer(
    model: AssessmentModel, flown: FlownLanding, installation: Installation, rate: float
) -> Answers:
    """Give a recording to every method.

    Parameters
    ----------
    model : AssessmentModel
    flown : FlownLanding
    installation : Installation
        Where the sensors are believed to be.
    rate : float
        Of the recorder's normal acceleration [Hz].
    """
    drawn, window = flown.drawn, flown.window
    rules = rule_answers(model, window)
    answers = Answers(
        number=drawn.number,
        kind=drawn.kind,
        weight=drawn.weight,
        rate=rate,
        sink_rate=flown.contact.sink_rate,
        utilisation=flown.utilisation,
        load_factor_share=rules.load_factor_share,
        is_over_load_factor=rules.is_over_load_factor,
        sink_difference=rules.sink_difference,
        undetermined="",
        contacts=0,
    )
    mass = recorded_mass(model, window)
    loading = model.airframe.loading_for(mass)
    aircraft = model.airframe.landing_aircraft(loading.factors)
    geometry = _geometry(model, aircraft, installation)
    found = reconstruct(window, geometry)
    if not found.contacts:
        return replace(answers, undetermined=found.cannot_tell[0].code)
    landed = [each for each in found.contacts if each.kind not in FOLLOWING]
    record = TouchdownRecord(
        model.name,
        tuple(contact_of(each, landed[0].time) for each in landed),
        mass=mass,
        mass_deviation=MASS_DEVIATION * mass,
        centre_of_gravity_deviation=geometry.centre_of_gravity_sd,
        recorded=tuple(
            RecordedContact(nose_first=each.kind is ContactKind.NOSE_FIRST, simulated=place)
            for place, each in enumerate(landed)
        ),
    )
    try:
        assessment = assess_landing(model, record)
        answers = replace(
            answers,
            contacts=len(landed),
            sink_estimate=record.contacts[0].sink_rate,
            estimate=largest_utilisation(assessment),
            is_held=SEVERITY[assessment.verdict] >= SEVERITY[Verdict.INSPECT],
        )
        used = (answers.utilisation, largest_utilisation(assessment))
        is_clear = max(used) < CLEARLY_SOUND or min(used) > CLEARLY_HARD
        if is_clear and drawn.number % CHECKED:
            return answers
        scatter = ServiceScatter.stated(model.airframe.definition.scatter)
        updated = assimilate(window, found, aircraft, geometry, scatter=scatter)
        return _with_assimilation(model, flown, answers, record, updated)
    except SolverError as error:
        return replace(answers, undetermined=type(error).__name__)


def _with_assimilation(
    model: AssessmentModel,
    flown: FlownLanding,
    answers: Answers,
    record: TouchdownRecord,
    updated: Assimilation,
) -> Answers:
    """Add what the recorded response makes of it, and what better knowledge would."""
    contacts = updated.contacts
    assessment = assess_landing(
        model, replace(record, contacts=contacts, uncertainties=updated.uncertainties)
    )
    believed = replace(flown.contact, lift=flown.drawn.contact.lift)
    true_state = assess_landing(model, replace(record, contacts=(believed,)))
    return replace(
        answers,
        is_complete=True,
        sink_corrected=contacts[0].sink_rate,
        corrected=largest_utilisation(assessment),
        is_unexplained=bool(updated.unexplained),
        probability=assessment.probability_limit_exceeded,
        with_true_state=largest_utilisation(true_state),
        with_true_aircraft=utilisation_of(model, flown.aircraft, flown.fills, contacts),
    )


def recorded_mass(model: AssessmentModel, window: Window) -> float:
    """Gross mass of the window, or the largest landing mass where it shows none [kg]."""
    channel = window.first(Parameter.GROSS_MASS)
    if channel is None:
        return model.airframe.definition.masses.maximum_landing
    return float(np.median(channel.value))


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


def _geometry(
    model: AssessmentModel, aircraft: LandingAircraft, installation: Installation
) -> Geometry:
    reference = model.airframe.definition.reference
    forward, aft = reference.forward_centre_of_gravity, reference.aft_centre_of_gravity
    return geometry_on_gears(
        aircraft.gears,
        aircraft.total_centre_of_gravity,
        aircraft.total_mass,
        installation,
        # Anywhere in the allowed range: uniform, variance (aft - forward)^2 / 12.
        centre_of_gravity_sd=(aft - forward) / np.sqrt(12.0),
    )
