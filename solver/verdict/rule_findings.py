"""A landing held against its maker's rule, contact by contact."""

from collections.abc import Sequence

from solver.aircraft.definition import AircraftDefinition
from solver.assessment import RuleFinding, RuleStatus, RuleVerdict, TouchdownRecord, Verdict
from solver.landing.history import LandingHistory
from solver.recorded import RecordedContact
from solver.units import Dimension, from_si
from solver.verdict.judge import SEVERITY, is_overweight
from solver.verdict.limit_curve import ROUNDING
from solver.verdict.makers_rule import (
    DIMENSIONS,
    SI_UNITS,
    Criterion,
    MakersRule,
    Onset,
    Quantity,
    WeightClass,
)
from solver.verdict.rule_bounds import (
    Bounds,
    ContactState,
    argument_of,
    curve_span,
    limit_bounds,
)


def apply_rule(
    rule: MakersRule,
    definition: AircraftDefinition,
    record: TouchdownRecord,
    histories: Sequence[LandingHistory] = (),
) -> RuleVerdict:
    """Every criterion of a rule at every contact of a record.

    Parameters
    ----------
    rule : MakersRule
        The rule.
    definition : AircraftDefinition
        Gives the maximum landing mass.
    record : TouchdownRecord
        What was recorded; only its own mass counts, not one that was assumed for the simulation.
    histories : sequence of LandingHistory
        Of its simulated contacts, if there are any: they say which gear touched first where the
        gear switches do not.
    """
    contacts = record.recorded or tuple(
        RecordedContact(
            sink_rate=contact.sink_rate,
            roll=contact.roll,
            nose_first=False if contact.nose_wheel_down else None,
            simulated=index,
        )
        for index, contact in enumerate(record.contacts)
    )
    findings = tuple(
        _finding(criterion, index, contact, state)
        for index, contact in enumerate(contacts)
        for state in [_state(rule, definition, record.mass, contact, histories)]
        for criterion in rule.criteria
    )
    status, verdict = _overall(findings)
    return RuleVerdict(rule.name, rule.title, status, verdict, findings)


def _overall(findings: Sequence[RuleFinding]) -> tuple[RuleStatus, Verdict]:
    exceeded = [f.action for f in findings if f.status is RuleStatus.EXCEEDED]
    if exceeded:
        return RuleStatus.EXCEEDED, max(exceeded, key=SEVERITY.__getitem__)
    if not findings or any(f.status is RuleStatus.CANNOT_TELL for f in findings):
        return RuleStatus.CANNOT_TELL, Verdict.UNDETERMINED
    return RuleStatus.PASSED, Verdict.NORMAL


def _state(
    rule: MakersRule,
    definition: AircraftDefinition,
    mass: float | None,
    contact: RecordedContact,
    histories: Sequence[LandingHistory],
) -> ContactState:
    weight = None
    if mass is not None:
        over = is_overweight(definition, mass - rule.overweight_margin)
        weight = WeightClass.ABOVE_LANDING if over else WeightClass.UP_TO_LANDING
    nose_first = contact.nose_first
    if nose_first is None and contact.simulated is not None and contact.simulated < len(histories):
        positions = {gear.name: gear.position for gear in definition.gears}
        stays = histories[contact.simulated].contacts
        first = min(stays, key=lambda stay: stay.start, default=None)
        nose_first = None if first is None else positions[first.gear] == "nose"
    roll = None if contact.roll is None else abs(contact.roll)
    return ContactState(mass=mass, weight=weight, roll=roll, nose_first=nose_first)


def _recorded(quantity: Quantity, contact: RecordedContact) -> tuple[float | None, float | None]:
    """Value of a quantity, and the rate it was sampled at if that matters."""
    if quantity is Quantity.SINK_RATE:
        return contact.sink_rate, None
    if quantity is Quantity.ROLL_RATE:
        return None if contact.roll_rate is None else abs(contact.roll_rate), None
    if quantity is Quantity.LATERAL_LOAD_FACTOR:
        peak = contact.lateral_load_factor
        return (None, None) if peak is None else (abs(peak.value), peak.rate)
    peak = contact.normal_load_factor
    return (None, None) if peak is None else (peak.value, peak.rate)


def _finding(
    criterion: Criterion, index: int, contact: RecordedContact, state: ContactState
) -> RuleFinding:
    value, rate = _recorded(criterion.quantity, contact)
    bounds = limit_bounds(criterion.limits, rate, state, main_gear_first=criterion.main_gear_first)
    status, why = _compare(value, bounds)
    if criterion.onset is not None and status is not RuleStatus.PASSED:
        status, why = _from_onset(criterion.onset, contact, state, status, why)
    return RuleFinding(
        criterion=criterion.name,
        contact=index,
        quantity=criterion.quantity,
        unit=SI_UNITS[DIMENSIONS[criterion.quantity]],
        value=value,
        limit=bounds.high if bounds.low == bounds.high else None,
        status=status,
        action=criterion.action,
        text=_text(criterion, index, value, rate, bounds, status, why),
        source=bounds.limit.source.text,
        certainty=bounds.limit.source.certainty,
    )


def _compare(value: float | None, bounds: Bounds) -> tuple[RuleStatus, str]:
    """Status, and in words what keeps the rule from telling."""
    if bounds.high == 0.0:
        return RuleStatus.EXCEEDED, ""
    if value is None:
        return RuleStatus.CANNOT_TELL, "it is not recorded"
    if value > bounds.high * (1.0 + ROUNDING):
        return RuleStatus.EXCEEDED, ""
    if bounds.doubts:
        return RuleStatus.CANNOT_TELL, "; ".join(bounds.doubts)
    if value > bounds.low * (1.0 + ROUNDING):
        return RuleStatus.CANNOT_TELL, "the limit is published only as a range"
    return RuleStatus.PASSED, ""


def _from_onset(
    onset: Onset, contact: RecordedContact, state: ContactState, status: RuleStatus, why: str
) -> tuple[RuleStatus, str]:
    """Take into account that a criterion counts only from some normal load factor."""
    peak = contact.normal_load_factor
    low, high = curve_span(onset.curve, argument_of(onset.over, state))
    if peak is not None and peak.value >= high * (1.0 - ROUNDING):
        return status, why
    needed = f"counts only from a normal load factor of {low:.2f} g"
    if peak is None:
        return RuleStatus.CANNOT_TELL, f"{needed}, which is not recorded"
    if peak.rate < onset.rate * (1.0 - ROUNDING):
        return RuleStatus.CANNOT_TELL, f"{needed}, and that was recorded at {peak.rate:g} Hz only"
    if peak.value >= low * (1.0 - ROUNDING):
        return RuleStatus.CANNOT_TELL, f"{needed} to {high:.2f} g, and the mass is not recorded"
    return RuleStatus.PASSED, needed


def _text(
    criterion: Criterion,
    index: int,
    value: float | None,
    rate: float | None,
    bounds: Bounds,
    status: RuleStatus,
    why: str,
) -> str:
    """One line in the units of the rule."""
    dimension, unit = DIMENSIONS[criterion.quantity], criterion.unit

    def number(si: float) -> str:
        value = from_si(si, unit, dimension)
        if dimension is not Dimension.LOAD_FACTOR:
            return f"{value:.4g}"
        short = f"{value:.3f}".rstrip("0")
        return f"{short}0" if short.endswith(".") else short

    text = f"contact {index + 1}, {criterion.name}: "
    if value is not None:
        text += f"{number(value)} {unit}" + ("" if rate is None else f" at {rate:g} Hz")
    circumstances = ", ".join(bounds.circumstances)
    under = f" ({circumstances})" if circumstances else ""
    if status is RuleStatus.CANNOT_TELL:
        return f"{text}{' ' if value is not None else ''}cannot be judged: {why}"
    if bounds.high == 0.0 and status is RuleStatus.EXCEEDED:
        beyond = "beyond the rule's curve, which asks for an inspection whatever was recorded"
        return f"{text}{', ' if value is not None else ''}{circumstances}: {beyond}"
    if why:
        return f"{text}{', ' if value is not None else ''}passed: {why}"
    held = "exceeds" if status is RuleStatus.EXCEEDED else "is within"
    limit = bounds.high if status is RuleStatus.EXCEEDED else bounds.low
    at_rate = "" if bounds.limit.rate is None else f" for {bounds.limit.rate:g} Hz"
    return f"{text} {held} the limit of {number(limit)} {unit}{at_rate}{under}"
