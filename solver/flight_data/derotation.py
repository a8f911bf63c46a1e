"""When the nose wheel touches: its height is zero, and the pitch breaks off from where it went.

Height and pitch hang on the same recorded angle, whose bias and delay are unknown, so that they are
weighed together: for each time the nose wheel may touch, pitch is a Gaussian process whose course
changes there, and the likelihood is that of all recorded angles, of a height of zero at that time,
and of the attitude at which the aircraft then rolls.
"""

import numpy as np
from scipy.special import log_ndtr
from scipy.stats import norm

from solver.arrays import Array
from solver.flight_data.alignment import Series, aligned, best
from solver.flight_data.contacts import ContactKind, ContactTime
from solver.flight_data.geometry import Geometry, Wheel
from solver.flight_data.lever import rise
from solver.flight_data.onset import Indicator, indicator
from solver.flight_data.parameter import Parameter
from solver.flight_data.pitch_model import PitchModel, outer, pitch_model, wheel_base
from solver.flight_data.touchdown import Courses
from solver.flight_data.vertical import SLOPE_SD
from solver.flight_data.vote import (
    HEIGHT_DRIFT,
    LEAST_SPEED,
    Ballot,
    Vote,
    closing_indicator,
)
from solver.flight_data.wheels import wheel_course
from solver.flight_data.window import Window
from solver.frames import body_structural
from solver.gear.place import Place

#: Step of the times considered [s].
_STEP = 0.02

#: Times are considered from where the wheel is so many deviations above the ground until so long
#: after it came within one of them [deviations, s].
_FROM, _UNTIL = 4.0, 1.5

#: With fewer times than this the window ends too soon.
_FEWEST = 3

#: Pitch is looked at from so long before the first contact until so long after the last time that
#: is considered, and at least until the aircraft has settled on its wheels [s].
_BEFORE, _AFTER, _SETTLED = 1.5, 1.5, 3.6

#: Part of the stated deviation of a height that is left on the synthetic fleet (the smoother allows
#: for shocks of any course), and what a wheel's height has besides it [m].
_LEFT_OF_DEVIATION, _HEIGHT_SD = 0.65, 0.01

#: Least scatter of a recorded angle [rad].
_LEAST_SD = 1e-4

#: Delays of the recorded pitch that are averaged over, in standard deviations.
_DELAYS = np.linspace(-2.0, 2.0, 5)

#: The time is that around which most of the chance lies within so much [s]: where the wheel may
#: have touched lightly before, a mean would lie where no time is likely.
_WANTED = 0.1

#: Chance that a light touch went before the one that pitch and switch tell, if the height passed
#: zero then, and how long at least [s].
_KISS, _LEAST_APART = 0.2, 0.2

#: What the model of the pitch leaves open of the time [s].
_MODEL_SD = 0.01

#: Way of the wheel, by tyre and strut, until its switch moves [m].
_SWITCH_WAY = 0.04


def nose_contact(
    window: Window,
    normal: Series,
    courses: Courses,
    geometry: Geometry,
    contacts: list[ContactTime],
) -> ContactTime | None:
    """First contact of the nose wheel, if it comes down within the smoothed courses.

    Parameters
    ----------
    window : Window
    normal : Series
        Normal acceleration.
    courses : Courses
        Smoothed with all contacts of the main wheels.
    geometry : Geometry
    contacts : list of ContactTime
        Of the main wheels, the first one first.
    """
    noses = geometry.of(Place.NOSE)
    pitch = best(window, Parameter.PITCH)
    if not noses or pitch is None:
        return None
    first = contacts[0].time
    considered = _considered(courses, geometry, noses[0], first)
    if considered is None:
        return None
    grid, height, sd = considered
    last = max(float(grid[-1]) + _AFTER, first + _SETTLED)
    span = (first - _BEFORE, min(last, float(courses.vertical.time[-1])))
    model = pitch_model(normal, courses, geometry, contacts, span)
    joint = _joint(model, pitch, courses, geometry, grid, span)
    not_before = _not_before(grid, height)
    indicators = [indicator("nose height and pitch", grid, joint + not_before)]
    speed = _speed(grid, height)
    for switch in aligned(window, Parameter.GEAR_NOSE):
        closing = closing_indicator("ground switches", switch, grid, _SWITCH_WAY / speed)
        if closing is not None:
            indicators.append(closing)
    lasting = joint + np.sum([each.log_likelihood for each in indicators[1:]], axis=0)
    left = np.hypot(_LEFT_OF_DEVIATION * sd, _HEIGHT_SD)
    touching = norm.pdf(height, scale=left) * speed * _STEP
    return _likeliest(grid, _with_kisses(lasting, not_before, touching), indicators)


def _considered(
    courses: Courses, geometry: Geometry, nose: Wheel, first: float
) -> tuple[Array, Array, Array] | None:
    """List times at which the wheel may touch, its smoothed height there and its deviation."""
    time = np.arange(first + _STEP, float(courses.vertical.time[-1]) - 0.5, _STEP)
    height, sd = wheel_course(courses, geometry, nose, time)
    near = np.flatnonzero(height < sd)
    if len(near) == 0:
        return None
    last = min(time[near[0]] + _UNTIL, time[-1])
    start = np.flatnonzero(height < _FROM * sd)[0]
    chosen = slice(start, int(np.searchsorted(time, last)))
    if len(time[chosen]) < _FEWEST:
        return None
    return time[chosen], height[chosen], sd[chosen]


def _joint(
    model: PitchModel,
    pitch: Series,
    courses: Courses,
    geometry: Geometry,
    grid: Array,
    span: tuple[float, float],
) -> Array:
    """Log likelihood of each time, (n,), averaged over the delay of the recorded pitch."""
    nose = geometry.of(Place.NOSE)[0]
    arm = body_structural(nose.position - geometry.installation.accelerometer)
    angle, roll = courses.pitch.at(grid), courses.roll.at(grid)
    over = rise(arm, angle, roll)
    lever = (rise(arm, angle + 1e-4, roll) - over) / 1e-4
    vertical = courses.vertical
    sensor = np.interp(grid, vertical.time, vertical.height)
    sensor_variance = np.interp(grid, vertical.time, vertical.covariance[:, 0, 0])
    keep = (pitch.time >= span[0]) & (pitch.time <= span[1])
    filed, entry = pitch.time[keep], pitch.entry
    samples = len(filed)
    # The last two rows are the height of the wheel and the attitude in which the aircraft rolls.
    scale = np.ones((len(grid), samples + 2))
    scale[:, samples] = lever
    # The touch has tied the sensor's height to the recorded pitch.
    bias = np.zeros_like(scale)
    bias[:, :samples] = 1.0
    bias[:, samples] = lever - wheel_base(geometry)
    measured = np.empty_like(scale)
    measured[:, :samples] = pitch.value[keep]
    measured[:, samples] = lever * angle - sensor - over
    measured[:, samples + 1] = geometry.rolling_pitch
    variance = np.full_like(scale, max(pitch.sd, _LEAST_SD) ** 2)
    variance[:, samples] = _LEFT_OF_DEVIATION**2 * sensor_variance + _HEIGHT_SD**2
    rolls = span[1] >= model.first + _SETTLED
    variance[:, samples + 1] = geometry.rolling_pitch_sd**2 if rolls else 1e2
    errors = outer(bias) * (entry.bias.value**2 + SLOPE_SD**2)
    diagonal = np.arange(samples + 2)
    errors[:, diagonal, diagonal] += variance
    logs = []
    for delay in _DELAYS:
        time = np.column_stack(
            [
                np.tile(filed - delay * entry.delay_scatter.value, (len(grid), 1)),
                grid,
                np.full(len(grid), span[1]),
            ]
        )
        mean, covariance = model.moments(time, grid)
        factor = np.linalg.cholesky(covariance * outer(scale) + errors)
        left = np.linalg.solve(factor, (measured - mean * scale)[:, :, None])[:, :, 0]
        determinant = np.log(factor[:, diagonal, diagonal]).sum(axis=1)
        logs.append(-0.5 * (left**2).sum(axis=1) - determinant - 0.5 * delay**2)
    return np.asarray(np.logaddexp.reduce(logs, axis=0)) + np.log(_speed(grid, sensor + over))


def _speed(grid: Array, height: Array) -> Array:
    return np.maximum(-np.gradient(height, grid), LEAST_SPEED)


def _not_before(grid: Array, height: Array) -> Array:
    """Log of the chance that the wheel was not lower before, as in `first_time_down`."""
    passed = grid[:, None] - grid[None, :]
    margin = (height[None, :] - height[:, None]) / (
        HEIGHT_DRIFT[0] + HEIGHT_DRIFT[1] * np.maximum(passed, 0.0)
    )
    return np.asarray(np.where(passed > 0, log_ndtr(margin), 0.0).min(axis=1))


def _with_kisses(lasting: Array, not_before: Array, touching: Array) -> Array:
    """Chance of each time as that of the first touch, (n,).

    Where pitch and switch tell a touch that lasts, the wheel may have touched lightly before, of
    which only the height tells: the more so the more likely it is to have passed zero by then.

    Parameters
    ----------
    lasting : (n,) array
        Log likelihood of each time as that of a touch that lasts.
    not_before : (n,) array
        Log of the chance that the wheel was not lower before.
    touching : (n,) array
        Chance that its height passes zero at each time.
    """
    firm = np.exp(lasting - lasting.max())
    apart = round(_LEAST_APART / _STEP)
    later = np.append(np.cumsum(firm[::-1])[::-1], np.zeros(apart))[apart:]
    weight = np.exp(not_before) * ((1 - _KISS) * firm + _KISS * touching * later)
    return np.asarray(weight / weight.sum())


def _likeliest(grid: Array, weight: Array, indicators: list[Indicator]) -> ContactTime:
    """Time around which most of the chance lies, its deviation that of all chances about it."""
    steps = np.arange(len(grid))
    within = np.abs(steps[:, None] - steps[None, :]) <= round(_WANTED / _STEP)
    near = within[int(np.argmax(within @ weight))] * weight
    time = float(near @ grid / near.sum())
    variance = float(weight @ (grid - time) ** 2) + _MODEL_SD**2 + _STEP**2 / 12.0
    sd = float(np.sqrt(variance))
    ballots = tuple(
        Ballot(each.name, each.time, each.sd, abs(each.time - time) <= 3 * np.hypot(each.sd, sd))
        for each in indicators
    )
    return ContactTime(ContactKind.DEROTATION, time, sd, Vote(time, sd, ballots))
