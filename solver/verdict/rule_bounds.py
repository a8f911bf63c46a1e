"""Between what bounds the limit of a criterion lies, given what is known of a contact.

What is not known widens the bounds or raises a doubt.  A doubt only ever lets the limit fall or the
true value rise (a slow recorder misses the peak; more roll, or the nose gear first, lowers the
limit), so that a value above the upper bound exceeds the limit in spite of it, but a value below
the lower one proves nothing.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from solver.units import from_si
from solver.verdict.limit_curve import ROUNDING, LimitCurve, Outside
from solver.verdict.makers_rule import (
    DIMENSIONS,
    Argument,
    Limit,
    Quantity,
    WeightClass,
)


@dataclass(frozen=True, slots=True)
class ContactState:
    """What a limit may depend on; None for what the record does not say."""

    mass: float | None  #: [kg]
    weight: WeightClass | None
    roll: float | None  #: magnitude [rad]
    nose_first: bool | None


@dataclass(frozen=True, slots=True)
class Bounds:
    """The limit lies between ``low`` and ``high``; equal where it is known."""

    low: float
    high: float
    limit: Limit  #: the one that holds, or the most lenient that may
    doubts: tuple[str, ...]
    circumstances: tuple[str, ...]  #: under which the limit was read off


def limit_bounds(
    limits: Sequence[Limit], rate: float | None, state: ContactState, *, main_gear_first: bool
) -> Bounds:
    """Bounds of the limit at one contact.

    Parameters
    ----------
    limits : sequence of Limit
        Of one criterion.
    rate : float, optional
        Samples per second of the recorded value [Hz]; None where the value has none.
    state : ContactState
        Of the contact.
    main_gear_first : bool
        Whether the criterion holds only if no nose gear touched first.
    """
    doubts: list[str] = []
    limits = _of_weight(limits, state, doubts)
    limits = _of_rate(limits, rate, doubts)
    spans = [(*_span(limit, state, doubts), limit) for limit in limits]
    if main_gear_first and state.nose_first is not False:
        doubts.append(
            "the nose gear touched first, where the limit does not hold"
            if state.nose_first
            else "it is not known which gear touched first"
        )
    lenient = max(spans, key=lambda span: span[1])
    return Bounds(
        low=min(low for low, _, _ in spans),
        high=lenient[1],
        limit=lenient[2],
        doubts=tuple(dict.fromkeys(doubts)),
        circumstances=_circumstances(limits, state),
    )


def curve_span(curve: LimitCurve, argument: float | None) -> tuple[float, float]:
    """Least and greatest value a curve may have; equal if its argument is known."""
    if argument is None:
        return min(curve.values), max(curve.values)
    value = curve.value(argument)
    return value, value


def argument_of(over: Argument | None, state: ContactState) -> float | None:
    """Where on a curve the contact lies; a constant lies anywhere."""
    if over is None:
        return 0.0
    return state.roll if over.quantity is Quantity.ROLL else state.mass


def _of_weight(limits: Sequence[Limit], state: ContactState, doubts: list[str]) -> list[Limit]:
    if state.weight is None:
        if any(limit.weight is not None for limit in limits):
            doubts.append("the mass is not recorded")
        return list(limits)
    return [limit for limit in limits if limit.weight in (None, state.weight)]


def _of_rate(limits: list[Limit], rate: float | None, doubts: list[str]) -> list[Limit]:
    """Limits for the highest rate that the recorder reaches, for the lowest if it reaches none."""
    rates = {limit.rate for limit in limits if limit.rate is not None}
    if rate is None or not rates:
        return limits
    reached = [known for known in rates if known <= rate * (1.0 + ROUNDING)]
    if not reached:
        doubts.append(f"it was recorded at {rate:g} Hz, the rule needs {min(rates):g} Hz")
    chosen = max(reached) if reached else min(rates)
    return [limit for limit in limits if limit.rate == chosen]


def _span(limit: Limit, state: ContactState, doubts: list[str]) -> tuple[float, float]:
    """Span of one limit; beyond the end of its curve as the rule says."""
    curve, over = limit.curve, limit.over
    argument = argument_of(over, state)
    if over is not None and argument is None:
        doubts.append(f"the {over.quantity} is not recorded")
    if over is not None and argument is not None and not curve.covers(argument):
        shown = from_si(argument, over.unit, DIMENSIONS[over.quantity])
        if curve.outside is Outside.INSPECT:
            return 0.0, 0.0
        if curve.outside is Outside.CANNOT_TELL:
            doubts.append(f"{over.quantity} {shown:.4g} {over.unit} is beyond what the rule covers")
            # More roll lowers a limit; which way mass would move it is not known.
            return curve_span(curve, argument) if over.quantity is Quantity.ROLL else (0, math.inf)
    low, high = curve_span(curve, argument)
    if over is not None and argument is None and curve.outside is Outside.INSPECT:
        low = 0.0
    return low, high if limit.greatest is None else max(high, limit.greatest)


def _circumstances(limits: Sequence[Limit], state: ContactState) -> tuple[str, ...]:
    """Say for what the limit was read off, in the rule's units."""
    said = [
        f"{over.quantity} {from_si(argument, over.unit, DIMENSIONS[over.quantity]):.5g} {over.unit}"
        for over in dict.fromkeys(limit.over for limit in limits)
        if over is not None and (argument := argument_of(over, state)) is not None
    ]
    if state.weight is not None and any(limit.weight is state.weight for limit in limits):
        said.append(state.weight)
    return tuple(said)
