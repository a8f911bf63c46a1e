"""The landings that an envelope speaks for: its coordinates, their ranges, and who lies outside."""

import math
from dataclasses import dataclass

import numpy as np

from solver.aircraft.definition import AircraftDefinition, GearDefinition
from solver.aircraft.loading import Loading
from solver.arrays import Array
from solver.assessment import TouchdownRecord
from solver.landing.contact import Contact, Lift, LiftModel

#: Coordinates of a landing, in the order of every array of an envelope; SI, rad.
COORDINATES = (
    "sink_rate",
    "roll",
    "pitch",
    "mass",
    "fuel",
    "lift_fraction",
    "ground_speed",
    "drift",
    "pitch_rate",
    "roll_rate",
    "yaw_rate",
    "centre_of_gravity",
)
SINK_RATE, ROLL, PITCH, MASS, FUEL, LIFT = range(6)

#: Turn their sign in the mirror image of a landing.
_MIRRORED = [COORDINATES.index(name) for name in ("roll", "drift", "roll_rate", "yaw_rate")]

#: Coordinates that are zero in most records: samples lie denser there.
_AROUND_ZERO = ("drift", "pitch_rate", "roll_rate", "yaw_rate")
_DENSITY_EXPONENT = 1.5

_DEGREE = math.pi / 180.0

#: Above the attitude at which nose and main wheels touch together.
_LEAST_PITCH, _MOST_PITCH = 0.5 * _DEGREE, 9.0 * _DEGREE
_LIFT_RANGE = (0.6, 1.2)
_MOST_DRIFT = 1.5 * _DEGREE
_MOST_RATE = 2.0 * _DEGREE  #: of pitch and roll [rad/s]
_MOST_YAW_RATE = 0.75 * _DEGREE  #: [rad/s]

#: Speed at a lift coefficient of 1.5 in the maximum landing mass, and the range about it: flaps,
#: wind and lighter loadings make the ground speed differ.
_LIFT_COEFFICIENT = 1.5
_SPEED_RANGE = (0.75, 1.4)

#: The softest landing of an envelope, as a share of the hardest; softer ones are taken as it.
_SOFTEST = 0.08

#: Share of the half span by which the centre of gravity may lie off the plane of symmetry.
_LATERAL_OFFSET = 0.005

#: Share of a range by which a number may leave it and still be on its edge: units were converted.
_ROUNDING = 1e-6

#: Of each coordinate, to say what lies outside: words, unit, factor from SI.
_SHOWN = {
    "sink_rate": ("sink rate", "m/s", 1.0),
    "roll": ("roll", "deg", 1.0 / _DEGREE),
    "pitch": ("pitch", "deg", 1.0 / _DEGREE),
    "mass": ("mass", "kg", 1.0),
    "fuel": ("fuel", "kg", 1.0),
    "lift_fraction": ("lift fraction", "of the weight", 1.0),
    "ground_speed": ("ground speed", "m/s", 1.0),
    "drift": ("drift", "deg", 1.0 / _DEGREE),
    "pitch_rate": ("pitch rate", "deg/s", 1.0 / _DEGREE),
    "roll_rate": ("roll rate", "deg/s", 1.0 / _DEGREE),
    "yaw_rate": ("yaw rate", "deg/s", 1.0 / _DEGREE),
    "centre_of_gravity": ("centre of gravity", "m", 1.0),
}


@dataclass(frozen=True, slots=True)
class Domain:
    """A box of landings, each folded to roll to starboard; arrays (12,) as `COORDINATES`."""

    low: Array
    high: Array
    half_span: float  #: [m]

    def __post_init__(self) -> None:
        if not np.all(self.low < self.high):
            raise ValueError("every range of an envelope must have some width")

    def unit(self, coordinates: Array) -> Array:
        """Coordinates (..., 12) as places in the box, -1 to 1."""
        places: Array = 2.0 * (coordinates - self.low) / (self.high - self.low) - 1.0
        return places

    def outside(self, coordinates: Array) -> str | None:
        """Say which coordinate (12,) lies outside, with value and range; None if none does.

        The sink rate is not looked at: whoever evaluates the envelope has an answer beyond either
        end of its range.
        """
        slack = _ROUNDING * (self.high - self.low)
        for index, name in enumerate(COORDINATES):
            value, low, high = coordinates[index], self.low[index], self.high[index]
            if index == SINK_RATE or low - slack[index] <= value <= high + slack[index]:
                continue
            words, unit, factor = _SHOWN[name]
            return (
                f"{words} {value * factor:.4g} {unit} is outside the envelope's "
                f"{low * factor:.4g} to {high * factor:.4g}"
            )
        return None


def domain_of(definition: AircraftDefinition, hardest: float) -> Domain:
    """Landings of an aircraft on its main gear, up to a sink rate [m/s].

    Pitch from just above the attitude at which all wheels touch together, roll up to the verdict's
    own limit, every loading up to the maximum take-off mass, speeds about that of a landing.
    """
    masses, reference = definition.masses, definition.reference
    level = three_wheel_pitch(definition)
    weight = 9.80665 * masses.maximum_landing
    speed = math.sqrt(
        2.0
        * weight
        / (definition.aerodynamics.air_density * reference.wing_area * _LIFT_COEFFICIENT)
    )
    ranges = {
        "sink_rate": (_SOFTEST * hardest, hardest),
        "roll": (0.0, definition.verdict.roll_limit),
        "pitch": (level + _LEAST_PITCH, level + _MOST_PITCH),
        # An aircraft weighs what its definition says within a hundredth.
        "mass": (0.99 * masses.operating_empty, 1.001 * masses.maximum_takeoff),
        "fuel": (0.0, sum(tank.capacity for tank in definition.tanks)),
        "lift_fraction": _LIFT_RANGE,
        "ground_speed": (_SPEED_RANGE[0] * speed, _SPEED_RANGE[1] * speed),
        "drift": (-_MOST_DRIFT, _MOST_DRIFT),
        "pitch_rate": (-_MOST_RATE, _MOST_RATE),
        "roll_rate": (-_MOST_RATE, _MOST_RATE),
        "yaw_rate": (-_MOST_YAW_RATE, _MOST_YAW_RATE),
        "centre_of_gravity": (
            reference.forward_centre_of_gravity,
            reference.aft_centre_of_gravity,
        ),
    }
    low, high = np.array([ranges[name] for name in COORDINATES]).T
    return Domain(low, high, 0.5 * reference.wing_span)


def three_wheel_pitch(definition: AircraftDefinition) -> float:
    """Pitch [rad] at which nose and main wheels, struts extended, reach the ground together."""
    of = {
        position: [_wheel(g) for g in definition.gears if g.position == position]
        for position in ("nose", "main")
    }
    # Height of a wheel's lowest point at pitch p: z cos p - x sin p - R, with x aft; its radius is
    # small beside the wheel base, so the points below the axles are taken to turn with the body.
    return max(
        math.atan2(main[1] - nose[1], main[0] - nose[0])
        for nose in of["nose"]
        for main in of["main"]
    )


def _wheel(gear: GearDefinition) -> tuple[float, float]:
    """Station and height of the lowest point of an extended gear's wheel."""
    axle = gear.pivot + gear.strut.extended_length * gear.axis
    return float(axle[0]), float(axle[2]) - gear.tyre.free_radius


def uncovered(contact: Contact) -> str | None:
    """Say what about a contact no envelope knows; None if it is the common kind."""
    standard = Lift()
    lift = contact.lift
    if lift.model is LiftModel.HELD:
        return "lift is held, and the envelope's landings dump it"
    if (lift.decay_start, lift.decay_time, lift.residual_fraction) != (
        standard.decay_start,
        standard.decay_time,
        standard.residual_fraction,
    ):
        return "lift decays in a way of its own"
    return None


def coordinates_of(contact: Contact, loading: Loading) -> Array:
    """Coordinates (12,) of a contact in its loading, folded to roll to starboard."""
    lift = contact.lift
    fraction = lift.fraction
    if lift.model is LiftModel.TRIMMED and lift.recorded_normal_acceleration is not None:
        fraction = lift.recorded_normal_acceleration
    found = np.array(
        [
            contact.sink_rate,
            contact.roll,
            contact.pitch,
            loading.mass,
            sum(loading.fuel.values()),
            fraction,
            contact.ground_speed,
            contact.drift,
            contact.pitch_rate,
            contact.roll_rate,
            contact.yaw_rate,
            loading.centre_of_gravity[0],
        ]
    )
    if contact.roll < 0.0:
        found[_MIRRORED] *= -1.0
    return found


def lopsided(domain: Domain, loading: Loading) -> str | None:
    """Say that a loading lies off the plane of symmetry, which no envelope knows."""
    offset, most = float(loading.centre_of_gravity[1]), _LATERAL_OFFSET * domain.half_span
    if abs(offset) <= most:
        return None
    return (
        f"the centre of gravity lies {offset:+.3f} m off the plane of symmetry, the envelope's "
        f"within {most:.3f} m"
    )


def landings_at(domain: Domain, definition: AircraftDefinition, cube: Array) -> Array:
    """Coordinates (n, 12) of landings from points (n, 12) of the unit cube.

    Mass takes the place of the payload: what the fuel leaves room for.  The centre of gravity is
    a wish that the loading meets as well as it can.
    """
    found: Array = domain.low + cube * (domain.high - domain.low)
    for name in _AROUND_ZERO:
        column = COORDINATES.index(name)
        place = 2.0 * cube[:, column] - 1.0
        dense = np.sign(place) * np.abs(place) ** _DENSITY_EXPONENT
        found[:, column] = dense * domain.high[column]
    masses = definition.masses
    room = masses.maximum_takeoff - masses.operating_empty - found[:, FUEL]
    payload = np.minimum(room, sum(bay.capacity for bay in definition.bays))
    # The tanks alone may hold more than the take-off mass allows.
    found[:, FUEL] += np.minimum(room, 0.0)
    found[:, MASS] = (
        masses.operating_empty + found[:, FUEL] + cube[:, MASS] * np.maximum(payload, 0.0)
    )
    return found


def record_at(definition: AircraftDefinition, coordinates: Array) -> TouchdownRecord:
    """Touchdown record of a landing's coordinates (12,), fuel shared alike by the tanks' sizes."""
    value = dict(zip(COORDINATES, coordinates.tolist(), strict=True))
    capacity = sum(tank.capacity for tank in definition.tanks)
    contact = Contact(
        **{
            name: value[name]
            for name in (
                "sink_rate", "ground_speed", "pitch", "roll", "drift", "pitch_rate", "roll_rate",
                "yaw_rate",
            )
        },
        lift=Lift(fraction=value["lift_fraction"]),
    )  # fmt: skip
    return TouchdownRecord(
        definition.name,
        (contact,),
        mass=value["mass"],
        centre_of_gravity=value["centre_of_gravity"],
        fuel={tank.name: value["fuel"] * tank.capacity / capacity for tank in definition.tanks},
    )
