"""Height and vertical speed of the accelerometer through the landing, by fixed-interval smoothing.

State: height above the runway h, vertical speed v (both upward, at the accelerometer, so that the
recorded acceleration drives it without the aircraft's angular acceleration), bias of the vertical
acceleration, sum of runway slope and bias in the inertial vertical speed, its delay, and per radio
altimeter bias, scale and delay.
"""

import numpy as np

from solver.arrays import Array
from solver.flight_data.course import Course
from solver.flight_data.geometry import Geometry
from solver.flight_data.rts import LinearSystem, smooth
from solver.flight_data.vertical_acceleration import (
    VerticalSources,
    recorded_acceleration,
    vertical_acceleration,
)
from solver.flight_data.vertical_course import (
    BIAS,
    HEIGHT,
    INERTIAL_DELAY,
    INERTIAL_OFFSET,
    PER_RADIO,
    RADIO,
    SPEED,
    RecordedAcceleration,
    Touch,
    VerticalCourse,
)
from solver.flight_data.vertical_measurements import Measurement, VerticalMeasurements
from solver.landing.records import GRAVITY

#: Standard deviation of a runway's slope along the touchdown zone [rad]; an assumption: rules allow
#: 0.8 % in the end quarters of instrument runways, and most have far less.
SLOPE_SD = 0.004

#: Radio altitude before this is over the approach terrain and not over the runway [s].
OVER_RUNWAY = 6.0

#: Drift of the acceleration's bias: attitude error turning with the aircraft [m2/s5].
_BIAS_DRIFT = 2e-5

#: Error of the vertical acceleration besides the datum's: attitude, scale [m/s2].
_RESOLVING_SD = 0.02

#: Error of a radio altitude besides the altimeter's: where antenna and sensor really sit [m].
_ANTENNA_SD = 0.3

#: Least variance of a constant, which keeps the covariance regular.
_LEAST = 1e-8


def smooth_vertical(
    sources: VerticalSources,
    pitch: Course,
    roll: Course,
    ground_speed: float,
    geometry: Geometry,
    touches: tuple[Touch, ...],
    rolling_from: float | None,
    over_runway_from: float,
    span: tuple[float, float],
) -> VerticalCourse:
    """Smooth the vertical motion.

    Parameters
    ----------
    sources : VerticalSources
    pitch, roll : Course
    ground_speed : float
        At the contact; a slope shows as a vertical speed [m/s].
    geometry : Geometry
    touches : tuple of Touch
        At each, a wheel's height is zero.
    rolling_from : float, optional
        From here on the wheels stay on the ground [s].
    over_runway_from : float
        Radio altitude before that is over other ground [s].
    span : (float, float)
        First and last instant [s].
    """
    recorded = recorded_acceleration(sources, pitch, roll)
    driven = vertical_acceleration(recorded, touches, span)
    ends = (float(driven[0][0]), float(driven[0][-1]))
    maker = VerticalMeasurements(sources, pitch, roll, geometry, over_runway_from, ends)
    variances = _initial_variances(sources, ground_speed, maker.size)
    # The delays act on the speed and acceleration that are being sought: a first pass gives them.
    rough = _solved(recorded, driven, maker.all(touches, rolling_from, None), variances)
    return _solved(recorded, driven, maker.all(touches, rolling_from, rough), variances)


def _initial_variances(sources: VerticalSources, ground_speed: float, size: int) -> Array:
    variances = np.zeros(size)
    variances[[HEIGHT, SPEED]] = 100.0**2, 10.0**2
    variances[BIAS] = (sources.datum.sd * GRAVITY) ** 2 + _RESOLVING_SD**2
    variances[[INERTIAL_OFFSET, INERTIAL_DELAY]] = 1.0  # of no effect if nothing is recorded
    if sources.inertial:
        entry = sources.inertial[0].entry
        variances[INERTIAL_OFFSET] = entry.bias.value**2 + (SLOPE_SD * ground_speed) ** 2
        variances[INERTIAL_DELAY] = entry.delay_scatter.value**2
    for index, radio in enumerate(sources.radio):
        at = RADIO + PER_RADIO * index
        # Twice the altimeter's own: it is set to zero for one attitude and one loading.
        variances[at] = (2 * radio.entry.bias.value) ** 2 + _ANTENNA_SD**2
        variances[at + 1] = radio.entry.scale.value**2
        variances[at + 2] = radio.entry.delay_scatter.value**2
    return np.maximum(variances, _LEAST)


def _solved(
    recorded: RecordedAcceleration,
    driven: tuple[Array, Array, Array],
    measurements: list[Measurement],
    variances: Array,
) -> VerticalCourse:
    times = np.array([each.time for each in measurements])
    grid, up, between = _refined(driven, times)
    size = len(variances)
    dt = np.diff(grid)
    transition = np.tile(np.eye(size), (len(dt), 1, 1))
    transition[:, HEIGHT, SPEED] = dt
    transition[:, HEIGHT, BIAS] = dt**2 / 2
    transition[:, SPEED, BIAS] = dt
    drive = np.zeros((len(dt), size))
    # Integrals of a straight line between the nodes.
    drive[:, HEIGHT] = (2 * up[:-1] + up[1:]) / 6 * dt**2
    drive[:, SPEED] = (up[:-1] + up[1:]) / 2 * dt
    noise = np.zeros((len(dt), size, size))
    noise[:, SPEED, SPEED] = between
    noise[:, HEIGHT, SPEED] = noise[:, SPEED, HEIGHT] = between * dt / 2
    noise[:, HEIGHT, HEIGHT] = between * dt**2 / 3
    noise[:, BIAS, BIAS] = _BIAS_DRIFT * dt
    initial = np.zeros(size)
    initial[[HEIGHT, SPEED]] = 50.0, -3.0
    result = smooth(
        LinearSystem(
            initial=initial,
            initial_covariance=np.diag(variances),
            transition=transition,
            noise=noise,
            drive=drive,
            # At a jump of the acceleration two nodes share a time; either has the same state.
            node=np.searchsorted(grid, times).astype(np.int64),
            row=np.array([each.row for each in measurements]).reshape(len(times), size),
            measured=np.array([each.value for each in measurements]),
            variance=np.array([each.variance for each in measurements]),
        )
    )
    return VerticalCourse(
        time=grid,
        height=result.mean[:, HEIGHT],
        speed=result.mean[:, SPEED],
        covariance=result.covariance[:, : BIAS + 1, : BIAS + 1],
        acceleration=up + result.mean[:, BIAS],
        bias=result.mean[:, BIAS],
        recorded=recorded,
    )


def _refined(driven: tuple[Array, Array, Array], extra: Array) -> tuple[Array, Array, Array]:
    """Grid with the measurements' times, acceleration on it, variance of each step."""
    time, up, between = driven
    new = np.setdiff1d(extra, time)
    new = new[(new > time[0]) & (new < time[-1])]
    grid = np.sort(np.concatenate([time, new]))
    fine = np.interp(grid, time, up)
    # Interpolation cannot see both values of a jump.
    fine[np.isin(grid, time)] = up
    total = np.concatenate([[0.0], np.cumsum(between)])
    return grid, fine, np.diff(np.interp(grid, time, total))
