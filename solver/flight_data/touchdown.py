"""State of the aircraft at a contact, at its centre of gravity and its gears, with covariance."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.flight_data.course import Course
from solver.flight_data.flown_lift import flown_lift
from solver.flight_data.geometry import Geometry
from solver.flight_data.lever import rise_rate
from solver.flight_data.vertical_course import VerticalCourse
from solver.frames import body_structural
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS
from solver.landing.records import GRAVITY


@dataclass(frozen=True, slots=True)
class Estimate:
    """A value and its standard deviation."""

    value: float
    sd: float


@dataclass(frozen=True, slots=True)
class TouchdownState:
    """State at one contact; rates are body rates, signs those of `solver.landing.contact`."""

    sink_rate: Estimate  #: of the centre of gravity, downward [m/s]
    gear_sink_rates: dict[str, Estimate]  #: of each gear's wheels, struts extended [m/s]
    pitch: Estimate  #: against the runway [rad]
    roll: Estimate  #: [rad]
    drift: Estimate  #: [rad]
    ground_speed: Estimate  #: [m/s]
    pitch_rate: Estimate  #: [rad/s]
    roll_rate: Estimate  #: [rad/s]
    yaw_rate: Estimate  #: [rad/s]
    lift_fraction: Estimate  #: lift over weight just before the contact
    covariance: Array  #: (9, 9) in the order of `CONTACT_COMPONENTS`
    assumed: tuple[str, ...]  #: components that no channel speaks of


@dataclass(frozen=True, slots=True)
class Courses:
    """Smoothed histories of a window; None where nothing is recorded."""

    vertical: VerticalCourse
    pitch: Course
    roll: Course
    heading: Course | None
    drift: Course | None
    ground_speed: Course | None


#: Taken where nothing is recorded: mean and standard deviation.
_UNKNOWN_DRIFT = (0.0, np.deg2rad(3.0))
_UNKNOWN_YAW_RATE = (0.0, np.deg2rad(1.5))

#: Span over which the acceleration in a hop is averaged [s].
_LIFT_SPAN = 0.6

#: How far that average is carried on to the contact [s].
_CARRIED = 0.17

#: Least change of the acceleration meanwhile [g].
_LEAST_CARRIED = 0.04

#: After so long the shock of a contact has passed through struts and filter [s].
_SHAKEN = 0.25

#: Lift over weight where no sample shows the hop.
_UNKNOWN_LIFT = Estimate(0.7, 0.2)

#: Slope of a runway, which levels show and landings do not know of [rad].
_SLOPE_SD = 0.004


def touchdown_state(
    courses: Courses,
    geometry: Geometry,
    time: float,
    time_sd: float,
    before: float | None = None,
) -> TouchdownState:
    """State just before a contact.

    Parameters
    ----------
    courses : Courses
    geometry : Geometry
    time, time_sd : float
        Of the contact [s].
    before : float, optional
        Time of the contact before it [s]; without it nothing but flight lies before.
    """
    pitch, pitch_covariance = courses.pitch.state(time)
    roll, roll_covariance = courses.roll.state(time)
    speed, speed_covariance = courses.vertical.state(time)
    drift = _value(courses.drift, time, _UNKNOWN_DRIFT)
    ground = _value(courses.ground_speed, time, (np.nan, np.nan))
    yaw_rate = _rate(courses.heading or courses.drift, time, _UNKNOWN_YAW_RATE)

    # The unknown instant of the contact adds what changes meanwhile.
    up = _acceleration_before(courses.vertical, time)
    lift = (
        Estimate(*flown_lift(courses.vertical, time, time_sd))
        if before is None
        else _lift_in_hop(courses.vertical, time, before)
    )
    sensor = geometry.installation.accelerometer
    position_sd = geometry.installation.position_sd
    angles = (pitch[0], roll[0], pitch[1], roll[1])

    # Vertical speed at a point: of the sensor, plus the swing of the arm between them.
    def sink(point: Array, extra_sd: float) -> tuple[float, Array, float]:
        arm = body_structural(point - sensor)
        value = -(speed[1] + rise_rate(arm, *angles))
        by_pitch_rate = -rise_rate(arm, pitch[0], roll[0], 1.0, 0.0)
        by_roll_rate = -rise_rate(arm, pitch[0], roll[0], 0.0, 1.0)
        by_arm = extra_sd * np.hypot(pitch[1], roll[1])
        return value, np.array([by_pitch_rate, by_roll_rate]), float(by_arm)

    base = float(speed_covariance[1, 1] + (up * time_sd) ** 2)
    rate_variances = np.array([pitch_covariance[1, 1], roll_covariance[1, 1]])

    def variance(slopes: Array, extra: float) -> float:
        return float(base + slopes**2 @ rate_variances + extra**2)

    centre, slopes, extra = sink(
        geometry.centre_of_gravity, float(np.hypot(position_sd, geometry.centre_of_gravity_sd))
    )
    gears = {}
    for wheel in geometry.wheels:
        value, wheel_slopes, wheel_extra = sink(wheel.position, position_sd)
        gears[wheel.gear] = Estimate(value, float(np.sqrt(variance(wheel_slopes, wheel_extra))))

    cos_roll, sin_roll = np.cos(roll[0]), np.sin(roll[0])
    body_pitch_rate = pitch[1] * cos_roll + yaw_rate.value * sin_roll * np.cos(pitch[0])
    body_roll_rate = roll[1] - yaw_rate.value * np.sin(pitch[0])
    body_yaw_rate = yaw_rate.value * cos_roll * np.cos(pitch[0]) - pitch[1] * sin_roll

    covariance = np.diag(
        [
            variance(slopes, extra),
            pitch_covariance[0, 0] + (pitch[1] * time_sd) ** 2 + _SLOPE_SD**2,
            roll_covariance[0, 0] + (roll[1] * time_sd) ** 2,
            drift.sd**2,
            ground.sd**2,
            pitch_covariance[1, 1],
            roll_covariance[1, 1] + (yaw_rate.sd * np.sin(pitch[0])) ** 2,
            yaw_rate.sd**2,
            lift.sd**2,
        ]
    )
    at = {name: index for index, name in enumerate(CONTACT_COMPONENTS)}
    for name, slope in zip(("pitch_rate", "roll_rate"), slopes, strict=True):
        covariance[at["sink_rate"], at[name]] = slope * covariance[at[name], at[name]]
        covariance[at[name], at["sink_rate"]] = covariance[at["sink_rate"], at[name]]
    for angle, rate, source in (
        ("pitch", "pitch_rate", pitch_covariance),
        ("roll", "roll_rate", roll_covariance),
    ):
        covariance[at[angle], at[rate]] = covariance[at[rate], at[angle]] = source[0, 1]
    assumed = []
    if courses.drift is None:
        assumed.append("drift")
    if courses.heading is None and courses.drift is None:
        assumed.append("yaw_rate")
    if courses.ground_speed is None:
        assumed.append("ground_speed")

    def estimate(name: str, value: float) -> Estimate:
        return Estimate(float(value), float(np.sqrt(covariance[at[name], at[name]])))

    return TouchdownState(
        sink_rate=estimate("sink_rate", centre),
        gear_sink_rates=gears,
        pitch=estimate("pitch", pitch[0]),
        roll=estimate("roll", roll[0]),
        drift=drift,
        ground_speed=ground,
        pitch_rate=estimate("pitch_rate", body_pitch_rate),
        roll_rate=estimate("roll_rate", body_roll_rate),
        yaw_rate=estimate("yaw_rate", body_yaw_rate),
        lift_fraction=lift,
        covariance=covariance,
        assumed=tuple(assumed),
    )


def _value(course: Course | None, time: float, unknown: tuple[float, float]) -> Estimate:
    if course is None:
        return Estimate(*unknown)
    mean, covariance = course.state(time)
    return Estimate(float(mean[0]), float(np.sqrt(covariance[0, 0])))


def _rate(course: Course | None, time: float, unknown: tuple[float, float]) -> Estimate:
    if course is None:
        return Estimate(*unknown)
    mean, covariance = course.state(time)
    return Estimate(float(mean[1]), float(np.sqrt(covariance[1, 1])))


def _acceleration_before(vertical: VerticalCourse, time: float) -> float:
    """Vertical acceleration just before a time [m/s2]."""
    index = int(np.searchsorted(vertical.time, time)) - 1
    return float(vertical.acceleration[max(index, 0)])


def _lift_in_hop(vertical: VerticalCourse, time: float, before: float) -> Estimate:
    """Lift over weight from the vertical acceleration before a later contact.

    ``L / (m g) = 1 + a / g`` as in `flown_lift`, the load of a nose wheel that is down included.
    The last samples before the contact are averaged with a straight line.
    """
    start = max(before + _SHAKEN, time - _LIFT_SPAN)
    flown = (vertical.time > start) & (vertical.time < time)
    moment, value = vertical.time[flown], vertical.acceleration[flown] / GRAVITY
    if len(np.unique(moment)) < 4:
        return _UNKNOWN_LIFT
    design = np.stack([np.ones_like(moment), moment - time], axis=1)
    coefficients, *_ = np.linalg.lstsq(design, value, rcond=None)
    residual = value - design @ coefficients
    scatter = float(np.sqrt(residual @ residual / max(len(value) - 2, 1)))
    inverse = np.linalg.inv(design.T @ design)
    # The line is carried over to the contact from the middle of a sampling interval and a filter's
    # delay before it; what the acceleration did over as long in the hop is the error of that.
    earlier = np.arange(start, time - _CARRIED, 0.05)
    change = (
        np.interp(earlier + _CARRIED, vertical.time, vertical.acceleration)
        - np.interp(earlier, vertical.time, vertical.acceleration)
    ) / GRAVITY
    carried = float(np.std(change)) if len(change) > 1 else 0.0
    sd = np.hypot(max(scatter, 0.01) * np.sqrt(inverse[0, 0]), max(carried, _LEAST_CARRIED))
    return Estimate(1.0 + float(coefficients[0]), float(sd))
