"""The provisional verdict: what a landing's record says by the envelope alone, before it is solved.

It stands for the stress verdict to come, graded by the same thresholds, and errs to the stricter
side: the surface's error is added to what is expected.  What the envelope does not cover has no
provisional verdict, and says why.
"""

from dataclasses import dataclass

from solver.aircraft.definition import AircraftDefinition
from solver.aircraft.loading import Loading, find_loading
from solver.assessment import TouchdownRecord, Verdict
from solver.envelope.domain import (
    PITCH,
    SINK_RATE,
    coordinates_of,
    lopsided,
    uncovered,
)
from solver.envelope.envelope import Basis, Envelope, Expected, LimitSinkRate
from solver.errors import RecordError
from solver.verdict.judge import SEVERITY, graded


@dataclass(frozen=True, slots=True)
class CoveredContact:
    """A contact that the envelope speaks for."""

    contact: int  #: of those whose state is known, from 0
    verdict: Verdict
    sink_rate: float  #: [m/s]
    expected: Expected
    limit_sink_rate: LimitSinkRate  #: at this contact's attitude, loading and lift


@dataclass(frozen=True, slots=True)
class ProvisionalVerdict:
    """First answer to a landing."""

    verdict: Verdict | None  #: None: the envelope cannot tell
    reasons: tuple[str, ...]  #: what it does not cover
    driving: CoveredContact | None  #: the contact that uses most; None if none is covered
    basis: Basis


def provisional_verdict(envelope: Envelope, record: TouchdownRecord) -> ProvisionalVerdict:
    """Worst of all contacts of a record.

    A contact that is not covered leaves the landing without a provisional verdict, unless another
    one is HARD already: nothing that follows could make that milder.
    """
    reasons = []
    if record.missing:
        reasons.append("the record lacks " + "; ".join(record.missing))
    if record.runway_friction is not None:
        reasons.append("the record states the runway's friction")
    covered = []
    try:
        loading = find_loading(
            envelope.mass_states,
            record.mass,
            record.centre_of_gravity,
            record.fuel,
            record.payload,
        )
    except RecordError as error:
        reasons.append(str(error))
    else:
        for index in range(len(record.contacts)):
            found = _contact(envelope, record, index, loading)
            if isinstance(found, str):
                reasons.append(f"contact {index + 1}: {found}")
            else:
                covered.append(found)
    worst = max(covered, key=lambda c: (SEVERITY[c.verdict], c.expected.high), default=None)
    verdict = None if worst is None else worst.verdict
    if reasons and verdict is not Verdict.HARD:
        verdict = None
    return ProvisionalVerdict(verdict, tuple(reasons), worst, envelope.basis)


def _contact(
    envelope: Envelope, record: TouchdownRecord, index: int, loading: Loading
) -> CoveredContact | str:
    """Say what the envelope expects of one contact, or why it cannot."""
    contact = record.contacts[index]
    if any(each.nose_first for each in record.recorded if each.simulated == index):
        return "the gear switches say that the nose gear touched first"
    coordinates = coordinates_of(contact, loading)
    domain = envelope.domain
    if coordinates[PITCH] < domain.low[PITCH]:
        outside: str | None = "the main gears do not clearly touch first: " + (
            domain.outside(coordinates) or ""
        )
    else:
        outside = uncovered(contact) or lopsided(domain, loading) or domain.outside(coordinates)
    if outside:
        return outside
    course = envelope.course(coordinates)
    expected = course.expected(contact.sink_rate)
    verdict = _verdict(envelope.mass_states.definition, contact.roll, loading.mass, expected)
    hardest = float(domain.high[SINK_RATE])
    if contact.sink_rate > hardest and verdict is not Verdict.HARD:
        return (
            f"sink rate {contact.sink_rate:.4g} m/s is beyond the envelope's {hardest:.4g} m/s, "
            f"where the verdict is {verdict}"
        )
    return CoveredContact(
        contact=index,
        verdict=verdict,
        sink_rate=contact.sink_rate,
        expected=expected,
        limit_sink_rate=course.limit_sink_rate(),
    )


def _verdict(
    definition: AircraftDefinition, roll: float, mass: float, expected: Expected
) -> Verdict:
    found = graded(definition, mass, expected.high)
    if expected.stop_ratio >= 1.0 or abs(roll) >= definition.verdict.roll_limit:
        found = max(found, Verdict.INSPECT, key=SEVERITY.__getitem__)
    return found
