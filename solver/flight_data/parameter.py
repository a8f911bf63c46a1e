"""What a recorder window may hold: quantities of the trade, their dimension and plausible range."""

import math
from dataclasses import dataclass
from enum import StrEnum

from solver.units import Dimension


class Parameter(StrEnum):
    """A recorded quantity.  Signs are those of `solver.frames` and of the touchdown record."""

    NORMAL_ACCELERATION = "normal_acceleration"  #: specific force upward, +1 at rest [g]
    LATERAL_ACCELERATION = "lateral_acceleration"  #: specific force to starboard [g]
    LONGITUDINAL_ACCELERATION = "longitudinal_acceleration"  #: specific force forward [g]
    RADIO_ALTITUDE = "radio_altitude"  #: [m]
    VERTICAL_SPEED = "vertical_speed"  #: inertial, upward positive [m/s]
    BAROMETRIC_SPEED = "barometric_speed"  #: vertical, upward positive; too slow to judge by [m/s]
    PITCH = "pitch"  #: nose up [rad]
    ROLL = "roll"  #: starboard wing down [rad]
    HEADING = "heading"  #: [rad]
    TRACK = "track"  #: [rad]
    DRIFT = "drift"  #: heading minus track [rad]
    GROUND_SPEED = "ground_speed"  #: [m/s]
    AIRSPEED = "airspeed"  #: [m/s]
    GEAR_LEFT = "gear_left"  #: 1 with the left main gear's switch on ground
    GEAR_RIGHT = "gear_right"
    GEAR_NOSE = "gear_nose"
    GEAR_ANY = "gear_any"  #: one discrete for the whole aircraft
    GROSS_MASS = "gross_mass"  #: [kg]
    PRESSURE_ALTITUDE = "pressure_altitude"  #: [m]


#: The switches, which show no number but a state.
SWITCHES = (
    Parameter.GEAR_LEFT,
    Parameter.GEAR_RIGHT,
    Parameter.GEAR_NOSE,
    Parameter.GEAR_ANY,
)

ACCELERATIONS = (
    Parameter.NORMAL_ACCELERATION,
    Parameter.LATERAL_ACCELERATION,
    Parameter.LONGITUDINAL_ACCELERATION,
)

#: Angles that jump by a full turn.
HEADINGS = (Parameter.HEADING, Parameter.TRACK)


@dataclass(frozen=True, slots=True)
class Kind:
    """Dimension and range of a parameter; None for the dimension of a switch.

    The range is what a fixed-wing aircraft near the ground can show.  A sample outside it is an
    error of the recording, not a hard landing: 12 g is beyond every published landing.
    """

    dimension: Dimension | None
    least: float
    greatest: float


_TURN = 2 * math.pi

KINDS: dict[Parameter, Kind] = {
    Parameter.NORMAL_ACCELERATION: Kind(Dimension.LOAD_FACTOR, -6.0, 12.0),
    Parameter.LATERAL_ACCELERATION: Kind(Dimension.LOAD_FACTOR, -5.0, 5.0),
    Parameter.LONGITUDINAL_ACCELERATION: Kind(Dimension.LOAD_FACTOR, -5.0, 5.0),
    Parameter.RADIO_ALTITUDE: Kind(Dimension.LENGTH, -1300.0, 2500.0),
    Parameter.VERTICAL_SPEED: Kind(Dimension.SPEED, -60.0, 60.0),
    Parameter.BAROMETRIC_SPEED: Kind(Dimension.SPEED, -60.0, 60.0),
    Parameter.PITCH: Kind(Dimension.ANGLE, -_TURN / 8, _TURN / 8),
    Parameter.ROLL: Kind(Dimension.ANGLE, -_TURN / 4, _TURN / 4),
    Parameter.HEADING: Kind(Dimension.ANGLE, -_TURN, _TURN),
    Parameter.TRACK: Kind(Dimension.ANGLE, -_TURN, _TURN),
    Parameter.DRIFT: Kind(Dimension.ANGLE, -_TURN / 8, _TURN / 8),
    Parameter.GROUND_SPEED: Kind(Dimension.SPEED, 0.0, 300.0),
    Parameter.AIRSPEED: Kind(Dimension.SPEED, 0.0, 300.0),
    Parameter.GEAR_LEFT: Kind(None, 0.0, 1.0),
    Parameter.GEAR_RIGHT: Kind(None, 0.0, 1.0),
    Parameter.GEAR_NOSE: Kind(None, 0.0, 1.0),
    Parameter.GEAR_ANY: Kind(None, 0.0, 1.0),
    Parameter.GROSS_MASS: Kind(Dimension.MASS, 100.0, 1e6),
    Parameter.PRESSURE_ALTITUDE: Kind(Dimension.LENGTH, -1000.0, 20000.0),
}
