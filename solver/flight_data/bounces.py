"""Contacts of the main wheels after the first one: after a bounce, or after the nose wheel."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.special import expit

from solver.arrays import Array
from solver.flight_data.alignment import Series, best
from solver.flight_data.contacts import (
    ONSET,
    ContactKind,
    ContactTime,
    Rise,
    main_switches,
    rises,
    speaks,
    timed,
)
from solver.flight_data.geometry import Geometry
from solver.flight_data.onset import indicator
from solver.flight_data.parameter import Parameter
from solver.flight_data.touchdown import Courses
from solver.flight_data.vote import first_time_down, switch_indicator, vote
from solver.flight_data.wheels import lowest_course, wheel_course
from solver.flight_data.window import Window
from solver.gear.place import Place

#: Shortest time between two contacts of the main wheels [s].
SHORTEST = 0.35

#: Longest time after the first contact in which the aircraft bounces [s].
LONGEST = 8.0

#: Rises that are weaker are no contact [suddenness].
_SUDDEN = 2.5

#: How well the extended height of a wheel is trusted besides its own standard deviation: in the
#: air a strut is at its full extension but for friction [m].
_HEIGHT_SD = 0.02

#: A usual contact after a hop: rise of the normal acceleration [g] and its suddenness.
_USUAL_RISE, _USUAL_SUDDENNESS = 0.25, 7.0

#: Log odds of a hop, and of one gear having been off the ground, before a rise: constant, per
#: standard deviation of the wheel's greatest height, per logarithm of rise and of suddenness.
#: Logistic regression (D. R. Cox, J. R. Stat. Soc. B 20 (1958) 215) over 600 landings of the
#: synthetic fleet of `benchmarks.flight_data`.
_HOP = (-0.9, 0.74, 1.09, 2.17)
_ONE_OFF = (-0.12, 0.96, 3.13, 0.63)

#: A hop is reported at these log odds (one in three): to miss a contact costs more than to report
#: one that was not.
_LEAST_ODDS = -0.7

#: How long after the smoothed height of the mains passes zero they may still touch [s].
_AFTER_DOWN = 0.6

#: Part of the stated deviation of their height that is left on the synthetic fleet: the smoother
#: allows for shocks of any course.
_LEFT_OF_DEVIATION = 0.65

#: Heights count as evidence up to so many standard deviations.
_MOST_DEVIATIONS = 4.0

#: A nose wheel that is at least so deep shows in the normal acceleration before the mains do [m].
_LOADED = 0.1

#: What the end of a hop leaves open besides what the vote knows [s].
_HOP_SD = 0.022

#: Slowest and latest touch of the other main gear that is reckoned with [m/s, s].
_LEAST_SPEED, _MOST_APART = 0.2, 0.4


@dataclass(frozen=True, slots=True)
class _Heights:
    """Extended heights of the lowest and the highest main wheel after the first contact."""

    time: Array  #: (n,) [s]
    low: Array  #: (n,) [m]
    high: Array  #: (n,) [m]
    sd: Array  #: (n,) of either [m]
    nose: Array  #: (n,) of the nose wheel, a deviation higher [m]


def later_contacts(
    window: Window,
    normal: Series,
    courses: Courses,
    geometry: Geometry,
    first: ContactTime,
) -> list[ContactTime]:
    """Contacts of the main wheels after the first contact, in order of time.

    Parameters
    ----------
    window : Window
    normal : Series
        Normal acceleration.
    courses : Courses
        Smoothed with the contacts known so far.
    geometry : Geometry
    first : ContactTime
    """
    end = min(first.time + LONGEST, float(courses.vertical.time[-1]) - 0.5)
    found = _bounces(window, normal, courses, geometry, first, end)
    if first.kind is ContactKind.NOSE_FIRST:
        mains = _mains_down(window, courses, geometry, first, end)
        if mains is not None:  # their first contact is no bounce
            found = [contact for contact in found if contact.time > mains.time + SHORTEST]
            found.append(mains)
    return sorted(found, key=lambda contact: contact.time)


def _bounces(
    window: Window,
    normal: Series,
    courses: Courses,
    geometry: Geometry,
    first: ContactTime,
    end: float,
) -> list[ContactTime]:
    """Contacts of the main wheels after the first, the plainest first where two are too close."""
    grid = np.arange(first.time, end, 0.01)
    each = [wheel_course(courses, geometry, wheel, grid) for wheel in geometry.mains]
    heights = np.array([height for height, _ in each])
    sd = np.hypot(np.max([sd for _, sd in each], axis=0), _HEIGHT_SD)
    nose = np.full(len(grid), np.inf)
    if geometry.of(Place.NOSE):
        height, deviation = lowest_course(courses, geometry, geometry.of(Place.NOSE), grid)
        nose = height + deviation
    courses_of_wheels = _Heights(grid, heights.min(axis=0), heights.max(axis=0), sd, nose)
    drag = best(window, Parameter.LONGITUDINAL_ACCELERATION)
    found: list[tuple[float, ContactTime]] = []
    for rise in rises(normal, drag, first.time + SHORTEST, end, sudden=_SUDDEN):
        hop, one_off = _odds(rise, courses_of_wheels, first.time)
        if hop <= _LEAST_ODDS and one_off <= 0:
            continue
        contact = _came_down(window, normal, courses_of_wheels, rise, first, hop, one_off)
        if contact is not None and speaks(contact, ONSET):
            found.append((max(hop - _LEAST_ODDS, one_off), contact))
    kept: list[ContactTime] = []
    for _, contact in sorted(found, key=lambda each: -each[0]):
        if all(abs(contact.time - other.time) >= SHORTEST for other in kept):
            kept.append(contact)
    return kept


def _odds(rise: Rise, heights: _Heights, first: float) -> tuple[float, float]:
    """Log odds of all main wheels, and of one of them, having been off the ground before a rise."""
    before = (heights.time > max(rise.time - 0.5, first + 0.1)) & (heights.time < rise.time + 0.03)
    if not np.any(before):
        return -np.inf, -np.inf
    size = np.log(rise.height / _USUAL_RISE)
    suddenness = np.log(rise.suddenness / _USUAL_SUDDENNESS)

    def odds(height: Array, weights: tuple[float, float, float, float]) -> float:
        deviations = np.clip((height / heights.sd)[before].max(), -_MOST_DEVIATIONS, None)
        terms = (1.0, min(deviations, _MOST_DEVIATIONS), size, suddenness)
        return float(np.dot(weights, terms))

    return odds(heights.low, _HOP), odds(heights.high, _ONE_OFF)


def _came_down(
    window: Window,
    normal: Series,
    heights: _Heights,
    rise: Rise,
    first: ContactTime,
    hop: float,
    one_off: float,
) -> ContactTime | None:
    """Time of the contact that a rise shows: of the lowest wheel after a hop, else of the other."""
    is_hop = hop > _LEAST_ODDS
    height = heights.low if is_hop else heights.high
    at = int(np.searchsorted(heights.time, rise.time))
    # From the top of the hop on, or a little before where that is not plain.
    top = float(heights.time[max(at - 50, 0) + int(np.argmax(height[max(at - 50, 0) : at]))])
    start = min(top - 0.05, rise.time - normal.interval - 0.1)
    around = (max(start, first.time + 0.2), rise.time + 0.05)
    speed = float(height[at - 10] - height[at - 4]) / 0.06
    apart = 0.0
    if is_hop:
        between = float(heights.high[at - 4] - heights.low[at - 4])
        apart = min(between / max(speed, _LEAST_SPEED), _MOST_APART)
    kind = ContactKind.BOUNCE if is_hop else ContactKind.ONE_GEAR
    course = (heights.time, height, heights.sd)
    is_led = bool(heights.nose[at] < -_LOADED)
    contact = timed(window, normal, around, kind, course, rise, apart, is_led=is_led)
    if contact is None:
        return None
    chance = float(expit(hop if is_hop else one_off))
    return replace(contact, sd=float(np.hypot(contact.sd, _HOP_SD)), chance=chance)


def _mains_down(
    window: Window, courses: Courses, geometry: Geometry, first: ContactTime, end: float
) -> ContactTime | None:
    """First time at which the main wheels come down after the nose wheel."""
    grid = np.arange(first.time + 0.02, end, 0.01)
    height, sd = lowest_course(courses, geometry, geometry.mains, grid)
    down = np.flatnonzero(height < 0)
    if len(down) == 0:
        return None
    crossing = float(grid[down[0]])
    near = grid < crossing + _AFTER_DOWN
    log = first_time_down(grid[near], height[near], _LEFT_OF_DEVIATION * sd[near])
    indicators = [indicator("wheel height", grid[near], log)]
    switches = switch_indicator("ground switches", main_switches(window), grid[near])
    if switches is not None:
        indicators.append(switches)
    result = vote(grid[near], indicators)
    return ContactTime(ContactKind.MAINS, result.time, result.sd, result)
