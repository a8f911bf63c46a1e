"""Height of each wheel over the runway, from the smoothed motion."""

import numpy as np

from solver.arrays import Array
from solver.flight_data.geometry import Geometry, Wheel
from solver.flight_data.lever import rise
from solver.flight_data.touchdown import Courses
from solver.flight_data.vertical import SLOPE_SD
from solver.frames import body_structural


def wheel_course(
    courses: Courses, geometry: Geometry, wheel: Wheel, time: Array
) -> tuple[Array, Array]:
    """Height of a wheel as if its strut were extended, and its standard deviation.

    On the ground it is negative by what strut and tyre give.

    Parameters
    ----------
    courses : Courses
    geometry : Geometry
    wheel : Wheel
    time : (n,) array
        [s].

    Returns
    -------
    (n,) array, (n,) array
        [m].
    """
    arm = body_structural(wheel.position - geometry.installation.accelerometer)
    vertical = courses.vertical
    height = np.interp(time, vertical.time, vertical.height)
    variance = np.interp(time, vertical.time, vertical.covariance[:, 0, 0])
    total = height + rise(arm, courses.pitch.at(time), courses.roll.at(time))
    for course, lever in ((courses.pitch, arm[0]), (courses.roll, arm[1])):
        variance = variance + lever**2 * np.interp(time, course.time, course.covariance[:, 0, 0])
    # The touch has tied the height to the main wheels: a bias of the pitch, and the slope of the
    # runway in it, cancel but for what a wheel is ahead of them, and so does a delay but for how
    # fast that turns.
    before = max(float(main.position[0]) for main in geometry.mains) - float(wheel.position[0])
    level = courses.pitch.bias_sd**2 + SLOPE_SD**2
    turned = level + (courses.pitch.delay_sd * courses.pitch.rate_at(time)) ** 2
    variance = variance + before**2 * turned
    return np.asarray(total), np.asarray(np.sqrt(variance))


def lowest_course(
    courses: Courses, geometry: Geometry, wheels: tuple[Wheel, ...], time: Array
) -> tuple[Array, Array]:
    """Height of the lowest of some wheels and its standard deviation, (n,) each [m]."""
    each = [wheel_course(courses, geometry, wheel, time) for wheel in wheels]
    heights = np.array([height for height, _ in each])
    which = np.argmin(heights, axis=0)
    at = np.arange(len(time))
    return heights[which, at], np.array([sd for _, sd in each])[which, at]
