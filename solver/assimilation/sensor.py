"""What a recorder would show of a simulated landing, without noise: a prediction of its samples.

`solver.flight_data.recorder` makes recordings, with errors drawn; here the same sensor, filter and
delay give the expected value of a sample, for stated errors.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from solver.arrays import Array
from solver.flight_data.anti_alias import anti_aliased
from solver.flight_data.frame import RecordedParameter
from solver.flight_data.motion import Motion, motion_of_landing, specific_force_at, velocity_at
from solver.flight_data.parameter import ACCELERATIONS, Parameter
from solver.frames import euler_from_quaternion, rotation_matrix
from solver.landing.history import LandingHistory
from solver.landing.records import GRAVITY

#: Axis of the specific force in body axes, and its sign, of each acceleration.
_AXES = {
    Parameter.NORMAL_ACCELERATION: (2, -1.0),
    Parameter.LATERAL_ACCELERATION: (1, 1.0),
    Parameter.LONGITUDINAL_ACCELERATION: (0, 1.0),
}


@dataclass(frozen=True, slots=True)
class SensorErrors:
    """Errors of one channel that stay the same through a landing."""

    bias: float = 0.0
    scale: float = 0.0  #: relative
    delay: float = 0.0  #: besides the frame's own [s]


class SensorCourses:
    """Courses of one simulated landing at the recorder's sensors."""

    def __init__(self, history: LandingHistory, accelerometer: Array) -> None:
        self._motion = motion_of_landing(history)
        self._force = mean_specific_force(self._motion, accelerometer)
        self._middles = self._motion.time - self._motion.interval / 2
        self._filtered: dict[tuple[Parameter, float], Array] = {}

    def predicted(
        self, entry: RecordedParameter, time: Array, errors: SensorErrors | None = None
    ) -> Array:
        """Predict samples.

        Parameters
        ----------
        entry : RecordedParameter
            Filter, delay and range.
        time : (n,) array
            Times under which they are filed, after the contact [s].
        errors : SensorErrors, optional

        Returns
        -------
        (n,) array
            Before the contact the first value of an acceleration holds, and the rate of an angle.
        """
        errors = errors or SensorErrors()
        at = time - entry.delay.value - errors.delay
        course = self._course(entry)
        if entry.parameter in ACCELERATIONS:
            shown = np.interp(at, self._middles, course)
        else:
            # Before the contact the angle changes at its rate there.
            rate = (course[1] - course[0]) / self._motion.interval
            shown = np.interp(at, self._motion.time, course) + rate * np.minimum(at, 0.0)
        # One g is where the datum is taken, so that an error of scale turns about it.
        rest = 1.0 if entry.parameter is Parameter.NORMAL_ACCELERATION else 0.0
        shown = shown + errors.scale * (shown - rest) + errors.bias
        return np.clip(shown, entry.least.value, entry.greatest.value)

    def _course(self, entry: RecordedParameter) -> Array:
        key = (entry.parameter, entry.corner.value)
        if key not in self._filtered:
            if entry.parameter in ACCELERATIONS:
                axis, sign = _AXES[entry.parameter]
                course = sign * self._force[:, axis] / GRAVITY
            else:
                roll, pitch, _ = euler_from_quaternion(self._motion.attitude)
                course = roll if entry.parameter is Parameter.ROLL else pitch
            self._filtered[key] = _filtered(course, entry.corner.value, self._motion.interval)
        return self._filtered[key]


def _filtered(course: Array, corner: float, interval: float) -> Array:
    """As `anti_aliased`, by convolution: its coefficients are dearer than a short course."""
    if corner <= 0.0:
        return course
    answer = _impulse_answer(corner, interval, len(course))
    return np.asarray(course[0] + np.convolve(course - course[0], answer)[: len(course)])


@lru_cache(maxsize=64)
def _impulse_answer(corner: float, interval: float, count: int) -> Array:
    impulse = np.zeros(count + 1)
    impulse[1] = 1.0  # the first value is that at rest
    return anti_aliased(impulse, corner, interval)[1:]


def mean_specific_force(motion: Motion, point: Array) -> Array:
    """Specific force at a point, averaged over each interval of the grid that ends there.

    The extension stops ring at some 70 Hz as a strut breaks away; values at the grid's instants
    would alias that, and differences between two simulations would be noise.  The change of the
    velocity over an interval is its mean acceleration exactly.

    Returns
    -------
    (nt, 3) array
        Body axes [m/s2]; the first row is the value at the first instant.
    """
    velocity = velocity_at(motion, point)
    inertial = np.diff(velocity, axis=0) / motion.interval - np.array([0.0, 0.0, GRAVITY])
    turn = rotation_matrix(motion.attitude)
    middle = (turn[:-1] + turn[1:]) / 2
    force = np.empty_like(velocity)
    force[0] = specific_force_at(motion, point)[0]
    force[1:] = np.einsum("tji,tj->ti", middle, inertial)
    return force
