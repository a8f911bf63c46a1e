"""A maker's hard-landing rule: criteria, limits by recorder rate, roll and weight, and sources.

`solver.verdict.makers_rule_reader` reads one from its file; `solver.verdict.rule_findings` holds a
landing against it.  Everything is SI, load factors in g.
"""

from dataclasses import dataclass
from enum import StrEnum

from solver.assessment import Verdict
from solver.units import Dimension
from solver.verdict.limit_curve import LimitCurve


class Quantity(StrEnum):
    """What a criterion holds against its limit, and what a limit may depend on."""

    NORMAL_LOAD_FACTOR = "normal load factor"
    LATERAL_LOAD_FACTOR = "lateral load factor"
    SINK_RATE = "sink rate"
    ROLL_RATE = "roll rate"
    ROLL = "roll"
    MASS = "mass"


DIMENSIONS = {
    Quantity.NORMAL_LOAD_FACTOR: Dimension.LOAD_FACTOR,
    Quantity.LATERAL_LOAD_FACTOR: Dimension.LOAD_FACTOR,
    Quantity.SINK_RATE: Dimension.SPEED,
    Quantity.ROLL_RATE: Dimension.ANGULAR_RATE,
    Quantity.ROLL: Dimension.ANGLE,
    Quantity.MASS: Dimension.MASS,
}

#: Units of what is inside: SI, load factors in g.
SI_UNITS = {
    Dimension.LOAD_FACTOR: "g",
    Dimension.SPEED: "m/s",
    Dimension.ANGULAR_RATE: "rad/s",
    Dimension.ANGLE: "rad",
    Dimension.MASS: "kg",
}


class Certainty(StrEnum):
    """How well a limit is known."""

    READ = "read"  #: read in the source named
    COMPUTED = "computed"  #: follows from figures of the source named
    MEMORY = "memory"  #: common knowledge of the trade, not checked in a source
    ASSUMED = "assumed"  #: nobody published it; a figure of the usual size


class WeightClass(StrEnum):
    """For which landings a limit holds; a limit that names neither holds for both."""

    UP_TO_LANDING = "up to landing mass"
    ABOVE_LANDING = "above landing mass"


@dataclass(frozen=True, slots=True)
class Source:
    """Where a limit was published."""

    text: str
    certainty: Certainty


@dataclass(frozen=True, slots=True)
class Argument:
    """What a curve runs over, and the unit in which the rule speaks of it."""

    quantity: Quantity  #: ROLL or MASS
    unit: str


@dataclass(frozen=True, slots=True)
class Limit:
    """One limit of a criterion, and the landings it holds for."""

    curve: LimitCurve
    over: Argument | None  #: None for a limit that is one number
    source: Source
    rate: float | None  #: least sample rate for which it holds [Hz]; None but for load factors
    weight: WeightClass | None
    greatest: float | None  #: the publication says only that the limit lies between curve and this


@dataclass(frozen=True, slots=True)
class Onset:
    """Normal load factor from which a criterion counts at all."""

    curve: LimitCurve
    over: Argument | None
    rate: float  #: least sample rate that can show it was not reached [Hz]


@dataclass(frozen=True, slots=True)
class Criterion:
    """One quantity against its limits."""

    name: str
    quantity: Quantity
    unit: str  #: in which the rule speaks of it
    action: Verdict  #: INSPECT or HARD, where a limit is exceeded
    main_gear_first: bool  #: holds only if no nose gear touched first
    limits: tuple[Limit, ...]
    onset: Onset | None


@dataclass(frozen=True, slots=True)
class MakersRule:
    """A rule as its file says it."""

    name: str
    title: str
    note: str
    overweight_margin: float  #: above the maximum landing mass, still taken as on it [kg]
    criteria: tuple[Criterion, ...]
