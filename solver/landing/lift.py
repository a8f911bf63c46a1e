"""Lift and the other air loads of a landing.

Lift is an input of each landing, never a hidden default.  It is the vertical part of the air loads
on the whole aircraft and acts through the whole aircraft's centre of gravity (unless the aircraft
names another point), so that the aircraft is in trim at the contact; the spoilers (or the pilot)
take it away:

    HELD      L = fraction * weight for ever
    DECAYING  L = fraction * weight until ``decay_start``, from then on towards
              ``residual_fraction * weight`` with the time constant ``decay_time``
    TRIMMED   as DECAYING, with the fraction read off the normal acceleration before the contact

That course holds at the contact's angle of attack.  An aircraft with a lift slope gains or loses
lift with the angle from there (quasi-steady); the sum is never negative.

With lift equal to weight for ever an aircraft that touches one wheel first hops off it and never
loads the others; that is why HELD is not the default.
"""

import math
from dataclasses import dataclass

import numba

from solver.errors import RecordError
from solver.landing.contact import Lift, LiftModel
from solver.landing.records import Record
from solver.landing.vectors import Vector, dot, scaled, vector

#: Normal accelerations a recorder may show just before a contact [g].
TRIMMED_RANGE = (0.0, 2.5)


@dataclass(frozen=True, slots=True)
class LiftCourse:
    """Lift over time as fractions of the weight."""

    fraction: float
    decay_start: float  #: inf: held [s]
    decay_time: float  #: [s]
    residual_fraction: float

    @property
    def final_fraction(self) -> float:
        """What the lift tends to."""
        return self.fraction if math.isinf(self.decay_start) else self.residual_fraction


def lift_course(lift: Lift) -> LiftCourse:
    """Resolve the input to a course over time.

    Raises
    ------
    RecordError
        A value is out of its range, or a trimmed lift comes without recorded acceleration.
    """
    fraction = lift.fraction
    if lift.model is LiftModel.TRIMMED:
        recorded = lift.recorded_normal_acceleration
        if recorded is None:
            raise RecordError("lift TRIMMED needs recorded_normal_acceleration")
        _check("recorded_normal_acceleration", recorded, *TRIMMED_RANGE)
        fraction = recorded
    _check("lift fraction", fraction, 0.0, 2.5)
    if lift.model is LiftModel.HELD:
        return LiftCourse(fraction, math.inf, 1.0, fraction)
    _check("lift residual_fraction", lift.residual_fraction, 0.0, 2.5)
    _check("lift decay_start", lift.decay_start, 0.0, 1e6)
    _check("lift decay_time", lift.decay_time, 1e-3, 1e6)
    return LiftCourse(fraction, lift.decay_start, lift.decay_time, lift.residual_fraction)


def _check(name: str, value: float, low: float, high: float) -> None:
    if not low <= value <= high:
        raise RecordError(f"{name} {value:g} is outside {low:g} to {high:g}")


@numba.njit(cache=True)
def lift_fraction(
    time: float, fraction: float, decay_start: float, decay_time: float, residual: float
) -> float:
    """Lift over weight at a time after the first contact [s]."""
    if time <= decay_start:
        return fraction
    return residual + (fraction - residual) * math.exp((decay_start - time) / decay_time)


@numba.njit(cache=True)
def angle_of_attack(velocity: Vector) -> float:
    """Angle between the body's x axis and its velocity in the plane of symmetry [rad]."""
    return math.atan2(velocity[2], velocity[0])


@numba.njit(cache=True)
def air_loads(
    airframe: Record, course_lift: float, velocity: Vector, rate: Vector, below: Vector
) -> tuple[Vector, Vector, Vector]:
    """Lift [N], drag [N] and moment of damping and sideslip [N m], body axes.

    Lift and drag act at ``airframe.lift_point``; ``velocity`` is that point's (the air is at rest).
    The sideslip is taken as v / V, as small as it is in a landing.
    """
    speed = math.sqrt(dot(velocity, velocity))
    lift = course_lift
    if airframe.lift_slope_area > 0.0:
        change = angle_of_attack(velocity) - airframe.contact_angle_of_attack
        pressure = 0.5 * airframe.air_density * speed**2
        lift = max(0.0, course_lift + pressure * airframe.lift_slope_area * change)
    drag = -0.5 * airframe.air_density * airframe.drag_area * speed
    factor = -airframe.air_density * speed
    damping = vector(airframe.damping)
    weathercock = 0.5 * airframe.air_density * airframe.yaw_stiffness * speed * velocity[1]
    moment = (
        factor * damping[0] * rate[0],
        factor * damping[1] * rate[1],
        factor * damping[2] * rate[2] + weathercock,
    )
    return scaled(-lift, below), scaled(drag, velocity), moment
