"""What the vertical smoother knows of and what it gives: touches, and the smoothed motion."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array

#: Places in the smoother's state; the altimeters' own three follow, bias, scale and delay each.
HEIGHT, SPEED, BIAS, INERTIAL_OFFSET, INERTIAL_DELAY, RADIO = range(6)
PER_RADIO = 3


@dataclass(frozen=True, slots=True)
class Touch:
    """A contact as far as it is known: now the lowest of these wheels is at the ground."""

    time: float  #: [s]
    sd: float  #: [s]
    wheels: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class RecordedAcceleration:
    """Vertical acceleration as the samples have it, before anything is put into its shape."""

    time: Array  #: (n,) of the event shown, the filter's delay taken out [s]
    up: Array  #: (n,) datum taken off, upward [m/s2]
    sd: float  #: of what is independent from sample to sample [m/s2]
    interval: float  #: between samples [s]
    lag: float  #: delay of the filter before the sampler [s]


@dataclass(frozen=True, slots=True)
class VerticalCourse:
    """Smoothed motion of the accelerometer."""

    time: Array  #: (n,) [s]
    height: Array  #: (n,) [m]
    speed: Array  #: (n,) upward [m/s]
    covariance: Array  #: (n, 3, 3) of height, speed and bias
    acceleration: Array  #: (n,) vertical, upward, bias taken out [m/s2]
    bias: Array  #: (n,) to be added to the recorded acceleration [m/s2]
    recorded: RecordedAcceleration

    def state(self, time: float) -> tuple[Array, Array]:
        """(2,) height and speed, (2, 2) covariance at the node nearest a time."""
        node = int(np.argmin(np.abs(self.time - time)))
        return np.array([self.height[node], self.speed[node]]), self.covariance[node, :2, :2]

    def speed_at(self, time: float) -> float:
        """Vertical speed at any time, upward [m/s]."""
        return float(np.interp(time, self.time, self.speed))

    def acceleration_at(self, time: float) -> float:
        """Vertical acceleration at any time, upward [m/s2]."""
        return float(np.interp(time, self.time, self.acceleration))
