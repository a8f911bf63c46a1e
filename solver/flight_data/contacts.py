"""Ground contacts of a window: where they are looked for, and how each is timed."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from solver.arrays import Array
from solver.flight_data.alignment import Series, aligned
from solver.flight_data.onset import Indicator, rise_onset
from solver.flight_data.parameter import Parameter
from solver.flight_data.vote import Vote, height_indicator, switch_indicator, vote
from solver.flight_data.window import Window
from solver.gear.place import Place


class ContactKind(StrEnum):
    """What a contact is in the course of a landing."""

    FIRST = "first"  #: out of the flight
    BOUNCE = "bounce"  #: main wheels again, after all of them had left the ground
    ONE_GEAR = "one_gear"  #: one main gear again, while another had stayed on the ground
    NOSE_FIRST = "nose_first"  #: the nose wheel before the mains
    MAINS = "mains"  #: the main wheels, after the nose wheel
    DEROTATION = "derotation"  #: the nose wheel, with the mains on the ground or just off it


#: Contacts of the nose wheel.
NOSE_KINDS = (ContactKind.DEROTATION, ContactKind.NOSE_FIRST)


@dataclass(frozen=True, slots=True)
class ContactTime:
    """One ground contact."""

    kind: ContactKind
    time: float  #: [s]
    sd: float  #: [s]
    vote: Vote
    chance: float = 1.0  #: that there was such a contact


#: Name of the chief indicator.
ONSET = "normal acceleration"

#: Wheels that are brought to speed pull the aircraft back.
SPIN_UP = "spin-up drag"

#: Step of the grids on which indicators are compared [s].
STEP = 0.005

#: Rise of the normal acceleration that may be a contact [g].
LEAST_RISE = 0.06

#: Rises closer than this are one [s].
CLOSE = 0.3

#: A gust changes the normal acceleration by more than this only over a longer time [g].
GUST = 0.02

_SWITCH_OF = {
    Place.LEFT: Parameter.GEAR_LEFT,
    Place.RIGHT: Parameter.GEAR_RIGHT,
    Place.NOSE: Parameter.GEAR_NOSE,
}


@dataclass(frozen=True, slots=True)
class Rise:
    """A sudden rise of the normal acceleration."""

    time: float  #: of the first high sample, as filed less the delay but not the filter's [s]
    height: float  #: of the rise within a few samples [g]
    suddenness: float  #: its first step over the usual step from sample to sample


def rises(
    normal: Series, drag: Series | None, first: float, last: float, sudden: float
) -> list[Rise]:
    """Sudden rises of the normal acceleration in order of time.

    Gusts and the flare change it as much, but over longer: the step from sample to sample is
    compared with those of the seconds before.  Wheels that spin up pull at the same moment, which
    is the plainer sign where the sink is small.
    """
    time, value = normal.time + normal.lag, normal.value
    steps = np.diff(value, prepend=value[0])
    memory = max(6, round(3.0 / normal.interval))
    reach = max(1, round(0.1 / normal.interval))
    found: list[Rise] = []
    for k in np.flatnonzero((time > first) & (time < last)):
        if k < 6 or k + 1 >= len(value):
            continue
        trend, usual = _usual_step(steps[max(1, k - memory) : k], normal.sd)
        top = value[k : k + reach + 1]
        height = float(top.max() - value[k - 1])
        step = (height - trend * (1 + int(np.argmax(top)))) / usual
        if steps[k] - trend < 2 * usual or step < 2.5 or height < LEAST_RISE:
            continue
        if drag is not None and drag.channel.rate >= 4:
            step = float(np.hypot(step, _pull(drag, float(time[k]) - normal.interval)))
        if step >= sudden:
            found.append(Rise(float(time[k]), height, step))
    return _strongest(found)


def _strongest(found: list[Rise]) -> list[Rise]:
    """Of rises that follow each other closely the most sudden one, in order of time."""
    kept: list[Rise] = []
    for rise in sorted(found, key=lambda rise: -rise.suddenness):
        if all(abs(rise.time - other.time) >= CLOSE for other in kept):
            kept.append(rise)
    return sorted(kept, key=lambda rise: rise.time)


def _usual_step(steps: Array, noise: float) -> tuple[float, float]:
    """Median and robust scatter; the first shock must not hide the next one."""
    trend = float(np.median(steps))
    return trend, max(1.48 * float(np.median(np.abs(steps - trend))), 1.4 * noise)


def _pull(drag: Series, time: float) -> float:
    """Suddenness of a fall of the longitudinal acceleration after a time."""
    filed = drag.time + drag.lag
    before = int(np.searchsorted(filed, time, side="right")) - 1
    after = (filed > time) & (filed < time + 0.15 + drag.interval)
    if before < 6 or not np.any(after):
        return 0.0
    trend, usual = _usual_step(np.diff(drag.value[max(0, before - 12) : before + 1]), drag.sd)
    return max(0.0, float(drag.value[before] - drag.value[after].min() + trend) / usual)


def likely_contact(window: Window) -> float | None:
    """Rough time of a first contact that no shock shows: radio altitude, or the switches [s]."""
    if (switch := first_closed(window)) is not None:
        return switch - 0.3
    times = []
    for radio in aligned(window, Parameter.RADIO_ALTITUDE):
        high = np.flatnonzero(radio.value > 6.0)
        # Out of the flight: it must have been higher before, which a take-off was not.
        low = np.flatnonzero(radio.value < 1.0)
        low = low[low > high[0]] if len(high) else low[:0]
        times += [float(radio.time[low[0]])] if len(low) else []
    return float(np.mean(times)) if times else None


def speaks(contact: ContactTime, name: str) -> bool:
    """Whether an indicator took part in the vote on a contact."""
    return any(ballot.name == name for ballot in contact.vote.ballots)


def timed(
    window: Window,
    normal: Series,
    around: tuple[float, float],
    kind: ContactKind,
    height: tuple[Array, Array, Array],
    rise: Rise,
    apart: float,
    *,
    is_led: bool = False,
) -> ContactTime | None:
    """Let the indicators vote on the time of a later contact; None if none of them speaks.

    Parameters
    ----------
    window : Window
    normal : Series
        Normal acceleration.
    around : (float, float)
        First and last time considered [s].
    kind : ContactKind
    height : ((n,), (n,), (n,))
        Time, smoothed height of the wheel and its standard deviation [s, m, m].
    rise : Rise
        Of the normal acceleration, that belongs to it.
    apart : float
        Time by which the other main gear comes down later, by the roll angle [s].
    is_led : bool, optional
        Whether the nose wheel is on the ground and loaded before.
    """
    grid = np.arange(*around, STEP)
    course = (np.interp(grid, height[0], h) for h in height[1:])
    indicators: list[Indicator | None] = [
        rise_onset(ONSET, normal, grid, GUST, rise.time + 0.08, apart, is_led=is_led),
        switch_indicator("ground switches", main_switches(window), grid),
        height_indicator("wheel height", grid, *course),
    ]
    speaking = [each for each in indicators if each is not None]
    if not speaking:
        return None
    result = vote(grid, speaking)
    return ContactTime(kind, result.time, result.sd, result)


def main_switches(window: Window) -> list[Series]:
    """Ground switches that speak of the main gears."""
    return switches_of(window, Place.LEFT, Place.RIGHT)


def switches_of(window: Window, *places: Place) -> list[Series]:
    """Ground switches that speak of the gears at some places."""
    return [
        series
        for parameter in (*(_SWITCH_OF[place] for place in places), Parameter.GEAR_ANY)
        for series in aligned(window, parameter)
    ]


def first_closed(window: Window) -> float | None:
    """Filed time of the first main switch that closes after having been open."""
    times = []
    for parameter in (Parameter.GEAR_LEFT, Parameter.GEAR_RIGHT, Parameter.GEAR_ANY):
        for series in aligned(window, parameter):
            closed = np.flatnonzero((series.value[1:] > 0.5) & (series.value[:-1] < 0.5)) + 1
            if len(closed):
                times.append(float(series.time[closed[0]]))
    return min(times, default=None)
