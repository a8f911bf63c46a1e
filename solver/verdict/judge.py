"""From margins and contact conditions to a verdict with its reasons.

Every finding becomes a `Reason` that carries the least severe verdict it would give alone; the
verdict is the most severe of them.  A missed hard landing costs more than a false alarm, so a
finding never lowers a verdict, and what cannot be told is UNDETERMINED, never NORMAL.
"""

import math
from collections.abc import Iterator, Mapping, Sequence, Set

from solver.aircraft.definition import AircraftDefinition
from solver.assessment import (
    GearLoad,
    HotSpot,
    LimitProbability,
    ProbabilityBasis,
    Reason,
    TouchdownRecord,
    Verdict,
)
from solver.landing.history import GroundContact, LandingHistory, Outcome

#: Rising order; HARD outranks UNDETERMINED because what is known already grounds the aircraft.
SEVERITY = {
    Verdict.NORMAL: 0,
    Verdict.FIRM: 1,
    Verdict.INSPECT: 2,
    Verdict.UNDETERMINED: 3,
    Verdict.HARD: 4,
}


#: Time between samples of gear switches [s].
SWITCH_SAMPLING = 0.25

#: Share by which a mass may pass the limit and still be on it: records and fills are rounded.
MASS_ROUNDING = 1e-4


def is_overweight(definition: AircraftDefinition, mass: float) -> bool:
    """Whether a mass [kg] is above the maximum landing mass."""
    return mass > definition.masses.maximum_landing * (1.0 + MASS_ROUNDING)


def severest(reasons: Sequence[Reason]) -> Verdict:
    """Return the most severe verdict among the reasons; without any there is none to give."""
    return max(
        (reason.verdict for reason in reasons),
        key=SEVERITY.__getitem__,
        default=Verdict.UNDETERMINED,
    )


def judge(
    definition: AircraftDefinition,
    record: TouchdownRecord,
    mass: float,
    histories: Sequence[LandingHistory],
    loads: Sequence[GearLoad],
    worst: HotSpot | None,
    likelihood: LimitProbability | None = None,
) -> tuple[Reason, ...]:
    """Return all reasons, most severe first; one of them always states the worst utilisation.

    Parameters
    ----------
    definition : AircraftDefinition
        Holds the thresholds.
    record : TouchdownRecord
        What was reported.
    mass : float
        Gross mass at the landing [kg].
    histories : sequence of LandingHistory
        One for each contact of the record.
    loads : sequence of GearLoad
        Of every gear in every contact.
    worst : HotSpot
        The most used element of the airframe; None if no contact could be simulated.
    likelihood : LimitProbability, optional
        That a limit was exceeded; None if the record does not say how well it is known.
    """
    found = [
        *_airframe(definition, mass, worst),
        *_gears(definition, mass, loads),
        *_probability(definition, likelihood),
        *_conditions(definition, record, mass, histories),
        *_gaps(record, histories),
    ]
    return tuple(sorted(found, key=lambda reason: -SEVERITY[reason.verdict]))


def graded(definition: AircraftDefinition, mass: float, utilisation: float) -> Verdict:
    """Verdict that a utilisation gives; above the landing mass the lower thresholds come down."""
    thresholds = definition.verdict
    factor = thresholds.overweight_factor if is_overweight(definition, mass) else 1.0
    if utilisation > 1.0:
        return Verdict.HARD
    if utilisation >= thresholds.inspect_utilisation * factor:
        return Verdict.INSPECT
    if utilisation >= thresholds.firm_utilisation * factor:
        return Verdict.FIRM
    return Verdict.NORMAL


def _airframe(
    definition: AircraftDefinition, mass: float, worst: HotSpot | None
) -> Iterator[Reason]:
    if worst is None:
        return
    verdict = graded(definition, mass, worst.utilisation)
    yield Reason(
        code="airframe_limit_exceeded" if verdict is Verdict.HARD else "airframe_stress",
        text=(
            f"{worst.component}, {worst.zone}: peak stress {worst.peak_stress / 1e6:.0f} MPa is "
            f"{worst.utilisation:.0%} of the limit allowable {worst.allowable / 1e6:.0f} MPa"
        ),
        verdict=verdict,
    )


def _gears(
    definition: AircraftDefinition, mass: float, loads: Sequence[GearLoad]
) -> Iterator[Reason]:
    by_name = {gear.name: gear for gear in definition.gears}
    for load in loads:
        verdict = graded(definition, mass, load.utilisation)
        if verdict is not Verdict.NORMAL:
            yield Reason(
                code="gear_limit_exceeded" if verdict is Verdict.HARD else "gear_load",
                text=(
                    f"{load.gear}, contact {load.contact + 1}: ground load is "
                    f"{load.utilisation:.0%} of the design limit (vertical "
                    f"{load.vertical_force / 1e3:.1f} kN, drag {load.drag_force / 1e3:.1f} kN, "
                    f"side {load.side_force / 1e3:.1f} kN)"
                ),
                verdict=verdict,
            )
        if load.stroke_utilisation >= 1.0:
            yield Reason(
                code="strut_bottomed",
                text=f"{load.gear}, contact {load.contact + 1}: the shock strut reached its stop",
                verdict=Verdict.INSPECT,
            )
        tyre = by_name[load.gear].tyre
        if load.tyre_deflection >= tyre.bottoming_deflection:
            yield Reason(
                code="tyre_bottomed",
                text=(
                    f"{load.gear}, contact {load.contact + 1}: tyre deflection "
                    f"{load.tyre_deflection * 1e3:.0f} mm reached bottoming at "
                    f"{tyre.bottoming_deflection * 1e3:.0f} mm"
                ),
                verdict=Verdict.INSPECT,
            )


def _probability(
    definition: AircraftDefinition, likelihood: LimitProbability | None
) -> Iterator[Reason]:
    """Look where not looking would cost more than looking; see `VerdictThresholds`."""
    if likelihood is None:
        return
    thresholds, probability = definition.verdict, likelihood.probability
    if probability >= thresholds.hard_probability:
        verdict, code = Verdict.HARD, "limit_probably_exceeded"
        beyond = f"at or above the {thresholds.hard_probability:.0%} from which a landing is hard"
    elif probability >= thresholds.inspect_probability:
        verdict, code = Verdict.INSPECT, "limit_possibly_exceeded"
        beyond = f"at or above the {thresholds.inspect_probability:.1%} from which to inspect"
    else:
        verdict, code = Verdict.NORMAL, "limit_probability"
        beyond = f"below the {thresholds.inspect_probability:.1%} from which to inspect"
    if likelihood.basis is ProbabilityBasis.SAMPLES:
        known = (
            f"{probability:.1%} (95 % interval of sampling {likelihood.lower:.1%} to "
            f"{likelihood.upper:.1%}, {likelihood.samples} simulated landings)"
        )
    else:
        known = f"0 (at most {likelihood.upper:.1%}, {likelihood.samples} simulated landings)"
    yield Reason(
        code=code,
        text=f"probability that a limit was exceeded, as well as the record is known: {known}, "
        + beyond,
        verdict=verdict,
    )


def _conditions(
    definition: AircraftDefinition,
    record: TouchdownRecord,
    mass: float,
    histories: Sequence[LandingHistory],
) -> Iterator[Reason]:
    """Contact conditions that ask for a look whatever the simulated stress."""
    thresholds = definition.verdict
    positions = {gear.name: gear.position for gear in definition.gears}
    for number, (contact, history) in enumerate(zip(record.contacts, histories, strict=True), 1):
        switches = {each.nose_first for each in record.recorded if each.simulated == number - 1}
        if contact.nose_wheel_down:
            switches.add(False)
        nose = _nose_first(positions, history, switches, is_first=number == 1)
        if nose is not None:
            yield Reason(
                code="nose_first",
                text=(
                    f"contact {number}: the nose gear touched first, at "
                    f"{nose.closure_speed:.2f} m/s; inspect the nose gear and its attachment"
                ),
                verdict=thresholds.nose_first,
            )
        else:
            yield from _struck_nose(thresholds.nose_closure_limit, positions, number, history)
        if abs(contact.roll) >= thresholds.roll_limit:
            yield Reason(
                code="roll_at_contact",
                text=(
                    f"contact {number}: roll {math.degrees(contact.roll):.1f} degrees, limit "
                    f"{math.degrees(thresholds.roll_limit):.1f}; inspect the first gear"
                ),
                verdict=Verdict.INSPECT,
            )
    if is_overweight(definition, mass):
        limit = definition.masses.maximum_landing
        yield Reason(
            code="overweight",
            text=(
                f"landed at {mass:.0f} kg, above the maximum landing mass of {limit:.0f} kg: "
                "lower thresholds apply"
            ),
            verdict=Verdict.NORMAL,
        )


def _nose_first(
    positions: Mapping[str, str],
    history: LandingHistory,
    switches: Set[bool | None],
    *,
    is_first: bool,
) -> GroundContact | None:
    """Touchdown of a nose gear that came down before the mains.

    Near the attitude of three wheels a small error of pitch decides which one the simulation brings
    down first.  Switches that showed the nose wheel first are believed; where they showed a main
    wheel first, the simulated nose counts if it leads by more than their sampling.  After the first
    contact it may have been on the ground all the while.
    """
    first = {
        place: min(
            (stay for stay in history.contacts if positions[stay.gear] == place),
            key=lambda stay: stay.start,
            default=None,
        )
        for place in ("nose", "main")
    }
    nose, main = first["nose"], first["main"]
    if nose is None:
        return None
    lead = math.inf if main is None else main.start - nose.start
    if True in switches:
        return nose
    if False in switches:
        return nose if is_first and lead > SWITCH_SAMPLING else None
    return nose if lead > 0.0 else None


def _struck_nose(
    limit: float, positions: Mapping[str, str], number: int, history: LandingHistory
) -> Iterator[Reason]:
    """Find a nose brought down fast: struts were damaged inside by loads below their limit."""
    closures = [c.closure_speed for c in history.contacts if positions[c.gear] == "nose"]
    if max(closures, default=0.0) >= limit:
        yield Reason(
            code="nose_struck",
            text=(
                f"contact {number}: the nose wheel came down at {max(closures):.2f} m/s, limit "
                f"{limit:.2f}; inspect the nose gear, its attachment and the forward fuselage"
            ),
            verdict=Verdict.INSPECT,
        )


def record_gaps(record: TouchdownRecord) -> Iterator[Reason]:
    """Return what keeps the record from carrying a verdict, whatever its simulation says."""
    if record.missing:
        yield Reason(
            code="record_incomplete",
            text="the record lacks " + "; ".join(record.missing),
            verdict=Verdict.UNDETERMINED,
        )
    if record.unexplained:
        yield Reason(
            code="recorded_response_unexplained",
            text="the stated uncertainties cannot explain what was recorded after the contact: "
            + "; ".join(record.unexplained),
            verdict=Verdict.UNDETERMINED,
        )


def _gaps(record: TouchdownRecord, histories: Sequence[LandingHistory]) -> Iterator[Reason]:
    """Return what keeps the record, or its simulation, from carrying a verdict."""
    yield from record_gaps(record)
    for number, history in enumerate(histories, 1):
        if history.outcome is Outcome.TIME_LIMIT and not history.contacts:
            yield Reason(
                code="no_ground_contact",
                text=f"contact {number}: the simulated aircraft never loaded a gear",
                verdict=Verdict.UNDETERMINED,
            )
