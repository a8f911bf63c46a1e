"""The one place where aviation units become SI, for records and recordings alike.

Factors are exact by definition: foot and inch of 1959, international pound, international nautical
mile, standard gravity of the 3rd CGPM (1901).
"""

import math
from enum import StrEnum
from typing import Literal, get_args

FOOT = 0.3048  #: [m]
INCH = 0.0254  #: [m]
POUND = 0.45359237  #: [kg]
KNOT = 1852.0 / 3600.0  #: [m/s]
STANDARD_GRAVITY = 9.80665  #: [m/s2]
MINUTE = 60.0  #: [s]


class Dimension(StrEnum):
    """What kind of number a unit can measure."""

    SPEED = "speed"
    ANGLE = "angle"
    ANGULAR_RATE = "angular rate"
    MASS = "mass"
    LOAD_FACTOR = "load factor"
    STATION = "station"
    TIME = "time"
    LENGTH = "length"
    FRACTION = "fraction"


SpeedUnit = Literal["m/s", "ft/s", "ft/min", "kt", "km/h"]
AngleUnit = Literal["deg", "rad"]
AngularRateUnit = Literal["deg/s", "rad/s"]
MassUnit = Literal["kg", "lb", "t"]
LoadFactorUnit = Literal["g", "m/s2"]
StationUnit = Literal["%MAC", "m", "ft", "in"]
TimeUnit = Literal["s", "ms"]
LengthUnit = Literal["m", "ft"]
FractionUnit = Literal["1", "%"]

#: Chord percentages have no factor of their own: they need the aircraft's reference chord.
PERCENT_CHORD = "%MAC"

_FACTORS: dict[Dimension, dict[str, float]] = {
    Dimension.SPEED: {
        "m/s": 1.0,
        "ft/s": FOOT,
        "ft/min": FOOT / MINUTE,
        "kt": KNOT,
        "km/h": 1000.0 / 3600.0,
    },
    Dimension.ANGLE: {"deg": math.pi / 180.0, "rad": 1.0},
    Dimension.ANGULAR_RATE: {"deg/s": math.pi / 180.0, "rad/s": 1.0},
    Dimension.MASS: {"kg": 1.0, "lb": POUND, "t": 1000.0},
    Dimension.LOAD_FACTOR: {
        "g": 1.0,
        "m/s2": 1.0 / STANDARD_GRAVITY,
        "mg": 1e-3,
    },
    Dimension.STATION: {"m": 1.0, "ft": FOOT, "in": INCH},
    Dimension.TIME: {"s": 1.0, "ms": 1e-3},
    Dimension.LENGTH: {"m": 1.0, "ft": FOOT},
    Dimension.FRACTION: {"1": 1.0, "%": 0.01},
}

_LITERALS: dict[Dimension, object] = {
    Dimension.SPEED: SpeedUnit,
    Dimension.ANGLE: AngleUnit,
    Dimension.ANGULAR_RATE: AngularRateUnit,
    Dimension.MASS: MassUnit,
    Dimension.LOAD_FACTOR: LoadFactorUnit,
    Dimension.STATION: StationUnit,
    Dimension.TIME: TimeUnit,
    Dimension.LENGTH: LengthUnit,
    Dimension.FRACTION: FractionUnit,
}


def allowed_units(dimension: Dimension) -> tuple[str, ...]:
    """Units in which a number of this kind may be given."""
    return get_args(_LITERALS[dimension])


def to_si(value: float, unit: str, dimension: Dimension) -> float:
    """Value in the solver's unit: SI, load factors in g, fractions of one."""
    return value * _FACTORS[dimension][unit]


def from_si(value: float, unit: str, dimension: Dimension) -> float:
    """Value of an SI number in another unit, for messages in the sender's own unit."""
    return value / _FACTORS[dimension][unit]
