"""Vertical acceleration at the accelerometer, from its three components and the attitude."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.flight_data.alignment import Series
from solver.flight_data.course import Course
from solver.flight_data.datum import Datum
from solver.flight_data.vertical_course import RecordedAcceleration, Touch
from solver.landing.records import GRAVITY

#: How much of the step between two samples of the acceleration the true course may leave; a step
#: at an unknown time between them would give 1 / sqrt(12), the filter smooths it.
_BETWEEN = 0.25

#: How far the course of a shock leaves a step, in parts of its height over one sampling interval.
_COURSE = 0.15

#: White noise of the vertical acceleration besides that of the samples [m2/s3].
_FLOOR = 1e-3


@dataclass(frozen=True, slots=True)
class VerticalSources:
    """Channels that speak of the vertical motion."""

    normal: Series
    lateral: Series | None
    longitudinal: Series | None
    radio: tuple[Series, ...]
    inertial: tuple[Series, ...]
    datum: Datum


def recorded_acceleration(
    sources: VerticalSources, pitch: Course, roll: Course
) -> RecordedAcceleration:
    """Vertical acceleration at the samples of the normal one."""
    series = sources.normal
    value = series.value - sources.datum.offset
    sin, cos = np.sin(pitch.at(series.time)), np.cos(pitch.at(series.time))
    angle = roll.at(series.time)
    forward, side = (
        np.interp(series.time, s.time, s.value) if s is not None else np.zeros_like(value)
        for s in (sources.longitudinal, sources.lateral)
    )
    up = GRAVITY * (sin * forward - np.sin(angle) * cos * side + np.cos(angle) * cos * value - 1.0)
    return RecordedAcceleration(series.time, up, series.sd * GRAVITY, series.interval, series.lag)


def vertical_acceleration(
    recorded: RecordedAcceleration, touches: tuple[Touch, ...], span: tuple[float, float]
) -> tuple[Array, Array, Array]:
    """Nodes, vertical acceleration at them and the variance of speed that each step adds.

    At a touch the acceleration jumps: the sample before it holds up to it, and the first one that
    the filter lets show it holds back to it.
    """
    time, up = recorded.time, recorded.up.copy()
    inside = [touch for touch in touches if time[1] < touch.time < time[-2]]
    for touch in inside:
        _sharpen(time, up, touch.time, recorded.lag)
    shocks = []
    for touch in sorted(inside, key=lambda touch: touch.time):
        at = int(np.searchsorted(time, touch.time))
        settled = min(int(np.searchsorted(time, touch.time + 1.3 * recorded.lag)), len(up) - 1)
        height = up[settled] - up[at - 1]
        # A contact at another time, or another course than a step, changes the speed after it.
        variance = (height * touch.sd) ** 2 + (
            _COURSE * height * (recorded.interval + recorded.lag)
        ) ** 2
        shocks.append((touch.time, variance))
        time = np.insert(time, at, [touch.time, touch.time])
        up = np.insert(up, at, [up[at - 1], up[at - 1] + height / 2])
    keep = (time >= span[0]) & (time <= span[1])
    time, up = time[keep], up[keep]
    dt = np.diff(time)
    step = np.abs(np.diff(up))
    noise = recorded.sd**2 * recorded.interval * dt
    between = (_BETWEEN * step * dt) ** 2 + noise + _FLOOR * dt
    for at_time, variance in shocks:
        after = int(np.searchsorted(time, at_time, side="right"))
        if 0 < after <= len(between):
            between[after - 1] += variance
    return time, up, between


def _sharpen(time: Array, up: Array, touch: float, lag: float) -> None:
    """Put the step that the filter smeared back to the touch.

    The filter is causal: a sample whose filed time is before the touch does not know of it.  Its
    step response is complete after some 2.3 times its delay (1 + 1.3 with the delay taken out).
    """
    clean = np.flatnonzero(time + lag <= touch)
    settled = np.flatnonzero(time >= touch + 1.3 * lag)
    if len(clean) == 0 or len(settled) == 0:
        return
    at = int(np.searchsorted(time, touch))
    up[clean[-1] + 1 : at] = up[clean[-1]]
    # Tyre and preload take a moment: from half the height on it rises to the settled sample.
    part = np.clip((time[at : settled[0]] - touch) / (time[settled[0]] - touch), 0.0, 1.0)
    before, after = up[clean[-1]], up[settled[0]]
    up[at : settled[0]] = before + (after - before) * (0.5 + 0.5 * part)
