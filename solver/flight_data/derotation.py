"""When the nose wheel touches: its height is zero, and the pitch breaks off from where it went.

Height and pitch hang on the same recorded angle, whose bias and delay are unknown, so that they are
weighed together: for each time the nose wheel may touch, pitch is a Gaussian process whose course
changes there, and the likelihood is that of all recorded angles, of a height of zero at that time,
and of the attitude at which the aircraft then rolls.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.special import log_ndtr

from solver.arrays import Array
from solver.flight_data.alignment import Series, aligned, best
from solver.flight_data.contacts import ContactKind, ContactTime
from solver.flight_data.geometry import Geometry, Place, Wheel
from solver.flight_data.lever import rise
from solver.flight_data.onset import Indicator, indicator
from solver.flight_data.parameter import Parameter
from solver.flight_data.touchdown import Courses
from solver.flight_data.vertical import SLOPE_SD
from solver.flight_data.vote import (
    HEIGHT_DRIFT,
    LEAST_SPEED,
    Ballot,
    Vote,
    closing_indicator,
    first_time_down,
)
from solver.flight_data.wheels import lowest_course, wheel_course
from solver.flight_data.window import Window
from solver.frames import body_structural
from solver.landing.records import GRAVITY

#: Step of the times considered [s].
_STEP = 0.02

#: Times are considered from where the wheel is so many deviations above the ground until so long
#: after it came within one of them [deviations, s].
_FROM, _UNTIL = 4.0, 1.5

#: Pitch is looked at from so long before the first contact until so long after the last time that
#: is considered, and at least until the aircraft has settled on its wheels [s].
_BEFORE, _AFTER, _SETTLED = 1.5, 1.5, 3.6

#: Radius of gyration in pitch per wheel base; an assumption, of the usual size for jets.
_GYRATION = 0.46

#: Pitch acceleration per g that the mains' load shows, over that of their vertical force alone at
#: its lever arm (rolling and spin-up drag act the same way), and its spread.
_OF_MAINS, _OF_MAINS_SPREAD = 1.8, 0.35

#: A hop shows the lift from so long after the first contact until so long before the next [s].
_COMPRESSED, _ONSET = 0.25, 0.03

#: Rate at which pitch motion is damped on the main wheels [1/s].
_DAMPING = (2.0, 0.7)

#: Acceleration of pitch that stays [rad/s2], jump of the pitch rate at a contact of the mains
#: [rad/s], and spectral densities of what else moves the pitch in the air and on the mains, and
#: when the nose strut works [rad2/s3].
_STEADY, _JUMP = 0.05, 0.02
_IN_AIR, _ON_MAINS, _ON_NOSE = 2e-3, 5e-4, 1.5e-2

#: Pitch acceleration by the nose strut times the wheel base: its preload comes at once [m/s2].
_BY_NOSE, _BY_NOSE_SPREAD = 5.5, 0.33

#: Spread of angle and rate of pitch before anything is known [rad, rad/s].
_ANGLE_SD, _RATE_SD = 1.0, 0.2

#: Part of the stated deviation of the sensor's height that is left on the synthetic fleet (the
#: smoother allows for shocks of any course), and what a wheel's height has besides it [m].
_LEFT_OF_DEVIATION, _HEIGHT_SD = 0.65, 0.01

#: Delays of the recorded pitch that are averaged over, in standard deviations.
_DELAYS = np.linspace(-2.0, 2.0, 5)

#: The time is that around which most of the chance lies within so much [s]: where the wheel may
#: have touched lightly before, a mean would lie where no time is likely.
_WANTED = 0.1

#: Chance that a light touch went before the one that pitch and switch tell, and how long at least
#: [s].
_KISS, _LEAST_APART = 0.1, 0.2

#: What the model of the pitch leaves open of the time [s].
_MODEL_SD = 0.01

#: Way of the wheel, by tyre and strut, until its switch moves [m].
_SWITCH_WAY = 0.04


@dataclass(frozen=True, slots=True)
class _Pitch:
    """Recorded pitch, and the parts of which its course is made."""

    time: Array  #: (n,) of the samples, with the usual delay [s]
    shown: Array  #: (n,) [rad]
    entry: Series
    first: float  #: contact of the aircraft [s]
    mains: tuple[float, ...]  #: contacts of the main wheels [s]
    by_load: Callable[[Array], Array]  #: pitch that a unit of the load's lever would have made
    by_damping: Callable[[Array], Array]  #: pitch that unit damping would have made
    load_lever: float  #: [rad/s2 per g]
    nose_acceleration: float  #: [rad/s2]


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
    prepared = _prepared(pitch, normal, courses, geometry, contacts, span)
    joint = _joint(prepared, courses, geometry, noses[0], grid, span[1])
    indicators = [indicator("nose height and pitch", grid, joint + _not_before(grid, height))]
    speed = _speed(grid, height)
    for switch in aligned(window, Parameter.GEAR_NOSE):
        closing = closing_indicator("ground switches", switch, grid, _SWITCH_WAY / speed)
        if closing is not None:
            indicators.append(closing)
    touched = indicator("height", grid, first_time_down(grid, height, sd))
    return _likeliest(grid, _with_kisses(indicators, touched), indicators)


def _considered(
    courses: Courses, geometry: Geometry, nose: Wheel, first: float
) -> tuple[Array, Array, Array] | None:
    """List times at which the wheel may touch, its smoothed height there and its deviation."""
    time = np.arange(first + _STEP, float(courses.vertical.time[-1]) - 0.5, _STEP)
    height, sd = wheel_course(courses, geometry, nose, time)
    near = np.flatnonzero(height < sd)
    if len(near) == 0:
        return None
    last = time[near[0]] + _UNTIL
    start = np.flatnonzero(height < _FROM * sd)[0]
    chosen = slice(start, int(np.searchsorted(time, last)))
    return time[chosen], height[chosen], sd[chosen]


def _prepared(
    pitch: Series,
    normal: Series,
    courses: Courses,
    geometry: Geometry,
    contacts: list[ContactTime],
    span: tuple[float, float],
) -> _Pitch:
    keep = (pitch.time >= span[0]) & (pitch.time <= span[1])
    first = contacts[0].time
    step = 0.005
    fine = np.arange(first, span[1] + 1.0, step)
    load = np.interp(fine, normal.time, normal.value) - 1.0
    load -= _lift_change(fine, load, courses, geometry, contacts)
    by_load = np.cumsum(np.cumsum(load)) * step**2
    by_damping = -np.cumsum(courses.pitch.at(fine) - courses.pitch.at(first)) * step
    base = _wheel_base(geometry)
    main = max(float(wheel.position[0]) for wheel in geometry.mains)
    lever = main - float(geometry.centre_of_gravity[0])
    return _Pitch(
        time=pitch.time[keep],
        shown=pitch.value[keep],
        entry=pitch,
        first=first,
        mains=tuple(contact.time for contact in contacts),
        by_load=lambda time: np.interp(time, fine, by_load, left=0.0),
        by_damping=lambda time: np.interp(time, fine, by_damping, left=0.0),
        load_lever=-_OF_MAINS * GRAVITY * lever / (_GYRATION * base) ** 2,
        nose_acceleration=_BY_NOSE / base,
    )


def _lift_change(
    time: Array, load: Array, courses: Courses, geometry: Geometry, contacts: list[ContactTime]
) -> Array:
    """Change of lift over weight, (n,): in a hop the normal acceleration shows it."""
    hops = [contact.time for contact in contacts if contact.kind is ContactKind.BOUNCE]
    if not hops:
        return np.zeros_like(time)
    low, _ = lowest_course(courses, geometry, geometry.mains, time)
    off = (time > contacts[0].time + _COMPRESSED) & (time < hops[0] - _ONSET) & (low > 0)
    shown = np.concatenate([[contacts[0].time], time[off]])
    return np.asarray(np.interp(time, shown, np.concatenate([[0.0], load[off]])))


def _wheel_base(geometry: Geometry) -> float:
    main = max(float(wheel.position[0]) for wheel in geometry.mains)
    return main - float(geometry.of(Place.NOSE)[0].position[0])


def _joint(
    pitch: _Pitch, courses: Courses, geometry: Geometry, nose: Wheel, grid: Array, end: float
) -> Array:
    """Log likelihood of each time, (n,), averaged over the delay of the recorded pitch."""
    arm = body_structural(nose.position - geometry.installation.accelerometer)
    angle, roll = courses.pitch.at(grid), courses.roll.at(grid)
    over = rise(arm, angle, roll)
    lever = (rise(arm, angle + 1e-4, roll) - over) / 1e-4
    vertical = courses.vertical
    sensor = np.interp(grid, vertical.time, vertical.height)
    sensor_variance = np.interp(grid, vertical.time, vertical.covariance[:, 0, 0])
    samples, entry = len(pitch.time), pitch.entry.entry
    # The last two rows are the height of the wheel and the attitude in which the aircraft rolls.
    scale = np.ones((len(grid), samples + 2))
    scale[:, samples] = lever
    # The touch has tied the sensor's height to the recorded pitch.
    bias = np.zeros_like(scale)
    bias[:, :samples] = 1.0
    bias[:, samples] = lever - _wheel_base(geometry)
    measured = np.empty_like(scale)
    measured[:, :samples] = pitch.shown
    measured[:, samples] = lever * angle - sensor - over
    measured[:, samples + 1] = geometry.rolling_pitch
    variance = np.full_like(scale, pitch.entry.sd**2)
    variance[:, samples] = _LEFT_OF_DEVIATION**2 * sensor_variance + _HEIGHT_SD**2
    rolls = end >= pitch.first + _SETTLED
    variance[:, samples + 1] = geometry.rolling_pitch_sd**2 if rolls else 1e2
    errors = _outer(bias) * (entry.bias.value**2 + SLOPE_SD**2)
    diagonal = np.arange(samples + 2)
    errors[:, diagonal, diagonal] += variance
    logs = []
    for delay in _DELAYS:
        time = np.column_stack(
            [
                np.tile(pitch.time - delay * entry.delay_scatter.value, (len(grid), 1)),
                grid,
                np.full(len(grid), end),
            ]
        )
        mean, covariance = _course(pitch, time, grid)
        factor = np.linalg.cholesky(covariance * _outer(scale) + errors)
        left = np.linalg.solve(factor, (measured - mean * scale)[:, :, None])[:, :, 0]
        determinant = np.log(factor[:, diagonal, diagonal]).sum(axis=1)
        logs.append(-0.5 * (left**2).sum(axis=1) - determinant - 0.5 * delay**2)
    return np.asarray(np.logaddexp.reduce(logs, axis=0)) + np.log(_speed(grid, sensor + over))


def _course(pitch: _Pitch, time: Array, touch: Array) -> tuple[Array, Array]:
    """Mean (n, m) and covariance (n, m, m) of the pitch at some times, by when the nose touches."""
    start = pitch.first - _BEFORE
    passed, down, nose = time - start, time - pitch.first, time - touch[:, None]
    covariance = _ANGLE_SD**2 + _RATE_SD**2 * _outer(passed) + _integrated(passed, _IN_AIR)
    covariance += _integrated(down, _ON_MAINS) + _integrated(nose, _ON_NOSE)
    covariance += _STEADY**2 * _outer(np.maximum(down, 0.0) ** 2 / 2)
    for contact in pitch.mains:
        covariance += _JUMP**2 * _outer(np.maximum(time - contact, 0.0))
    mean = np.zeros_like(time)
    for shape, usual, spread in (
        (pitch.by_load(time), pitch.load_lever, abs(pitch.load_lever) * _OF_MAINS_SPREAD),
        (pitch.by_damping(time), *_DAMPING),
        (
            np.maximum(nose, 0.0) ** 2 / 2,
            pitch.nose_acceleration,
            pitch.nose_acceleration * _BY_NOSE_SPREAD,
        ),
    ):
        mean += usual * shape
        covariance += spread**2 * _outer(shape)
    return mean, covariance


def _outer(rows: Array) -> Array:
    return np.asarray(rows[:, :, None] * rows[:, None, :])


def _integrated(since: Array, density: float) -> Array:
    """Covariance of white noise that begins at 0, integrated twice, (n, m, m).

    Notes
    -----
    ``S a^2 (3 b - a) / 6`` at a < b: C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for
    Machine Learning (2006), eq. 6.28.
    """
    late = np.maximum(since, 0.0)
    one, other = late[:, :, None], late[:, None, :]
    less, more = np.minimum(one, other), np.maximum(one, other)
    return np.asarray(density * less**2 * (3 * more - less) / 6)


def _speed(grid: Array, height: Array) -> Array:
    return np.maximum(-np.gradient(height, grid), LEAST_SPEED)


def _not_before(grid: Array, height: Array) -> Array:
    """Log of the chance that the wheel was not lower before, as in `first_time_down`."""
    passed = grid[:, None] - grid[None, :]
    margin = (height[None, :] - height[:, None]) / (
        HEIGHT_DRIFT[0] + HEIGHT_DRIFT[1] * np.maximum(passed, 0.0)
    )
    return np.asarray(np.where(passed > 0, log_ndtr(margin), 0.0).min(axis=1))


def _with_kisses(indicators: list[Indicator], touched: Indicator) -> Array:
    """Chance of each time, (n,).

    Where pitch and switch tell a firm touch, the wheel may have touched lightly before, of which
    only the height tells.
    """
    firm = np.exp(np.sum([each.log_likelihood for each in indicators], axis=0))
    firm /= firm.sum()
    light = np.exp(touched.log_likelihood)
    light /= light.sum()
    apart = round(_LEAST_APART / _STEP)
    later = np.append(np.cumsum(firm[::-1])[::-1], np.zeros(apart))[apart:]
    weight = (1 - _KISS) * firm + _KISS * light * later
    return np.asarray(weight / weight.sum())


def _likeliest(grid: Array, weight: Array, indicators: list[Indicator]) -> ContactTime:
    """Time around which most of the chance lies, its deviation that of all chances about it."""
    within = np.abs(grid[:, None] - grid[None, :]) <= _WANTED
    near = within[int(np.argmax(within @ weight))] * weight
    time = float(near @ grid / near.sum())
    variance = float(weight @ (grid - time) ** 2) + _MODEL_SD**2 + _STEP**2 / 12.0
    sd = float(np.sqrt(variance))
    ballots = tuple(
        Ballot(each.name, each.time, each.sd, abs(each.time - time) <= 3 * np.hypot(each.sd, sd))
        for each in indicators
    )
    return ContactTime(ContactKind.DEROTATION, time, sd, Vote(time, sd, ballots))
