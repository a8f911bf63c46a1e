"""The state of an aircraft at a ground contact, and the lift it carries from there."""

from dataclasses import dataclass, replace
from enum import StrEnum


class LiftModel(StrEnum):
    """How lift develops after the contact; never hidden, always part of the input."""

    HELD = "held"  #: fraction * weight for ever
    DECAYING = "decaying"  #: fraction * weight until `decay_start`, then exponential decay
    TRIMMED = "trimmed"  #: fraction from the recorded normal acceleration before the contact


@dataclass(frozen=True, slots=True)
class Lift:
    """Lift as an explicit input.

    ``TRIMMED`` needs ``recorded_normal_acceleration``; it sets the fraction at the contact and
    then decays as ``DECAYING`` does.
    """

    model: LiftModel = LiftModel.DECAYING
    #: Of the aircraft's weight at the contact.  What a nose wheel that is down carries is part of
    #: it: the acceleration before the contact shows both together.
    fraction: float = 1.0
    decay_start: float = 0.5  #: after the first contact, spoilers out [s]
    decay_time: float = 1.0  #: time constant [s]
    residual_fraction: float = 0.3  #: of the weight, what lift tends to
    recorded_normal_acceleration: float | None = None  #: just before contact, +1 at rest [g]

    def seen_from(self, later: float) -> "Lift":
        """Return the course as a contact sees it so much later [s]; its fraction is its own.

        The spoilers come out once in a landing, not after every hop.
        """
        return replace(self, decay_start=max(self.decay_start - later, 0.0))


@dataclass(frozen=True, slots=True)
class Contact:
    """State at one ground contact; SI units, rad.  Signs: see `solver.frames` and below."""

    sink_rate: float  #: of the centre of gravity, downward positive [m/s]
    ground_speed: float  #: along the direction of flight over ground [m/s]
    pitch: float = 0.0  #: nose up positive [rad]
    roll: float = 0.0  #: starboard wing down positive [rad]
    drift: float = 0.0  #: heading minus track, nose right of the flight path positive [rad]
    pitch_rate: float = 0.0  #: body q [rad/s]
    roll_rate: float = 0.0  #: body p [rad/s]
    yaw_rate: float = 0.0  #: body r [rad/s]
    lift: Lift = Lift()
    time: float = 0.0  #: of this contact in the record [s]
    #: The nose wheel stayed on the ground since the contact before: the main wheels touch.
    nose_wheel_down: bool = False
