"""One time from several indicators, none of which is trusted blindly."""

from dataclasses import dataclass

import numpy as np
from scipy.special import log_ndtr

from solver.arrays import Array
from solver.flight_data.alignment import Series
from solver.flight_data.onset import Indicator, indicator

#: Chance that an indicator speaks of something else (a gust, a bump, a late switch).
DOUBT = 0.03


@dataclass(frozen=True, slots=True)
class Ballot:
    """What one indicator said, and whether the others bear it out."""

    name: str
    time: float  #: [s]
    sd: float  #: [s]
    agrees: bool


@dataclass(frozen=True, slots=True)
class Vote:
    """Result of a vote."""

    time: float  #: [s]
    sd: float  #: [s]
    ballots: tuple[Ballot, ...]


def vote(grid: Array, indicators: list[Indicator]) -> Vote:
    """Combine indicators on a common grid of times.

    Each is a mixture of its own likelihood and of doubt spread evenly over the grid, so that a
    wrong one is outvoted instead of dragging the result along.
    """
    total = np.zeros(len(grid))
    for each in indicators:
        own = np.exp(each.log_likelihood)
        total += np.log((1 - DOUBT) * own / own.sum() + DOUBT / len(grid))
    result = indicator("vote", grid, total)
    ballots = tuple(
        Ballot(
            each.name,
            each.time,
            each.sd,
            abs(each.time - result.time) <= 3 * np.hypot(each.sd, result.sd),
        )
        for each in indicators
    )
    # The grid itself leaves an error of its own.
    step = float(grid[1] - grid[0])
    return Vote(result.time, float(np.hypot(result.sd, step / np.sqrt(12.0))), ballots)


def switch_indicator(name: str, switches: list[Series], grid: Array) -> Indicator | None:
    """Weigh ground switches: the first to close does so after the contact.

    How long after is little use: a strut must be compressed before its switch moves, and a soft
    contact followed by a bounce does not do it at all.
    """
    bounds = []
    for series in switches:
        closed = np.flatnonzero((series.value[1:] > 0.5) & (series.value[:-1] < 0.5)) + 1
        for at in closed:
            if series.time[at] >= grid[0]:
                earliest = series.time[at - 1] - series.entry.late_most.value - _COMPRESSION
                bounds.append((float(series.time[at]), float(earliest)))
    if not bounds:
        return None
    latest, earliest = min(bounds)
    if latest > grid[-1] + _LONGEST:
        return None
    after = np.logaddexp(0.0, (grid - latest) / _SOFT)
    early = 1.0 / (1.0 + np.exp(np.clip((earliest - grid) / _SOFT, -50, 50)))
    return indicator(name, grid, np.log(0.3 + 0.7 * early) - after)


def closing_indicator(name: str, switch: Series, grid: Array, takes: Array) -> Indicator | None:
    """Weigh one gear's own switch: it closes a lateness after its stroke, anything up to the most.

    Parameters
    ----------
    name : str
    switch : Series
    grid : (n,) array
        Times of the contact considered, rising [s].
    takes : (n,) array
        Time the strut takes until the switch's stroke [s].

    Returns
    -------
    Indicator or None
        None if the switch does not close in the first seconds after the grid began.
    """
    closed = np.flatnonzero((switch.value[1:] > 0.5) & (switch.value[:-1] < 0.5)) + 1
    closed = closed[switch.time[closed] >= grid[0]]
    if len(closed) == 0 or switch.time[closed[0]] > grid[-1] + _LONGEST:
        return None
    most = max(switch.entry.late_most.value, _SOFT)
    shown, open_before = switch.time[closed[0]], switch.time[closed[0] - 1]

    def late_by(time: float) -> Array:
        return np.asarray(np.clip((time - takes - grid) / most, 0.0, 1.0))

    between = late_by(float(shown)) - late_by(float(open_before))
    kissed = np.where(grid < shown, _KISSED, 0.0)
    return indicator(name, grid, np.log((1 - _KISSED) * between + kissed + _WRONG))


#: Chance that a wheel touches without its switch telling, or that a switch tells anything else.
_KISSED, _WRONG = 0.1, 1e-4

#: Time a strut may take until its switch's stroke [s].
_COMPRESSION = 0.4

#: A switch that closes so much later tells nothing of this contact [s].
_LONGEST = 2.0

#: Softness of the bounds [s].
_SOFT = 0.015


def first_time_down(time: Array, height: Array, sd: Array) -> Array:
    """Log likelihood of a wheel coming down to the runway for the first time, at each time.

    The height is zero then, passes zero at its speed, and was not lower before.

    Parameters
    ----------
    time : (n,) array
        [s].
    height, sd : (n,) array
        Of the wheel above the runway, and its standard deviation [m].

    Returns
    -------
    (n,) array
    """
    speed = np.maximum(-np.gradient(height, time), LEAST_SPEED)
    here = -0.5 * (height / sd) ** 2 - np.log(sd) + np.log(speed)
    some = slice(None, None, 5)
    passed = time[:, None] - time[None, some]
    margin = (height[None, some] - height[:, None]) / (
        HEIGHT_DRIFT[0] + HEIGHT_DRIFT[1] * np.maximum(passed, 0.0)
    )
    not_before = np.where(passed > 0, log_ndtr(margin), 0.0).min(axis=1)
    return np.asarray(here + not_before)


#: How far two smoothed heights are off each other, at once [m] and per time between them [m/s].
HEIGHT_DRIFT = (0.03, 0.06)

#: Least speed at which a height is taken to pass zero [m/s].
LEAST_SPEED = 0.1


def height_indicator(name: str, grid: Array, height: Array, sd: Array) -> Indicator | None:
    """Weigh a smoothed wheel height: the contact is where it passes zero at its speed.

    Parameters
    ----------
    grid : (n,) array
    height, sd : (n,) array
        Of the wheel above the runway, and its standard deviation [m].
    """
    if not (height.min() < 3 * sd.max() and height.max() > -3 * sd.max()):
        return None
    speed = np.maximum(-np.gradient(height, grid), LEAST_SPEED)
    return indicator(name, grid, -0.5 * (height / sd) ** 2 + np.log(speed))
