"""Contacts after the first: the main wheels again after a bounce, and the nose wheel."""

from dataclasses import replace

import numpy as np
from scipy.special import ndtr

from solver.arrays import Array
from solver.flight_data.alignment import Series, aligned, best
from solver.flight_data.contacts import ONSET, ContactKind, ContactTime, Rise, rises, speaks, timed
from solver.flight_data.geometry import Geometry, Place, Wheel
from solver.flight_data.parameter import Parameter
from solver.flight_data.touchdown import Courses
from solver.flight_data.wheels import lowest_course
from solver.flight_data.window import Window

#: Shortest time between two contacts of the main wheels: the oleo works, then there is a hop [s].
SHORTEST = 0.5

#: Longest time after the first contact in which the aircraft bounces or puts its nose down [s].
LONGEST = 8.0

#: What a wheel on the ground is below its extended height at the very least [m].
_LEAST_CLOSURE = 0.06

#: What the end of a hop leaves open: one wheel may come down well before the oleos show it.  The
#: scatter that is left over the synthetic fleet of `benchmarks.flight_data` [s].
_HOP_SD = 0.05

#: How far a strut may be from its full extension in a short hop [m].
_EXTENSION_SD = 0.06

#: How well the smoothed height is trusted besides its own standard deviation [m].
_HEIGHT_SD = 0.04


def later_contacts(
    window: Window,
    normal: Series,
    courses: Courses,
    geometry: Geometry,
    first: ContactTime,
) -> list[ContactTime]:
    """Contacts after the first one, in order of time.

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
        wheels, kind = geometry.mains, ContactKind.MAINS
    else:
        wheels, kind = geometry.of(Place.NOSE), ContactKind.DEROTATION
    other = _coming_down(window, normal, courses, geometry, first, end, wheels, kind)
    if other is not None:
        if kind is ContactKind.MAINS:  # their first contact is no bounce
            found = [contact for contact in found if contact.time > other.time + SHORTEST]
        found.append(other)
    return sorted(found, key=lambda contact: contact.time)


def _bounces(
    window: Window,
    normal: Series,
    courses: Courses,
    geometry: Geometry,
    first: ContactTime,
    end: float,
) -> list[ContactTime]:
    grid = np.arange(first.time, end, 0.01)
    height, sd = lowest_course(courses, geometry, geometry.mains, grid)
    drag = best(window, Parameter.LONGITUDINAL_ACCELERATION)
    contacts: list[ContactTime] = []
    last = first.time
    for rise in rises(normal, drag, last + SHORTEST, end, sudden=3.0):
        if rise.time - last < SHORTEST:
            continue
        if _airborne(window, rise, grid, height, sd, last) <= 0:
            continue
        around = (max(rise.time - normal.interval - 0.35, last + 0.3), rise.time + 0.05)
        wide = np.hypot(sd, _EXTENSION_SD)
        contact = timed(window, normal, around, ContactKind.BOUNCE, (grid, height, wide), rise)
        if contact is not None and speaks(contact, ONSET):
            contacts.append(replace(contact, sd=float(np.hypot(contact.sd, _HOP_SD))))
            last = contact.time
    return contacts


def _airborne(
    window: Window, rise: Rise, grid: Array, height: Array, sd: Array, last: float
) -> float:
    """Votes, as log odds, for the main wheels having been off the ground before a rise."""
    before = (grid > max(rise.time - 0.4, last + 0.1)) & (grid < rise.time - 0.05)
    if not np.any(before):
        return -1.0
    highest = int(np.argmax(np.where(before, height, -np.inf)))
    margin = (height[highest] + _LEAST_CLOSURE) / np.hypot(sd[highest], _HEIGHT_SD)
    chance = float(np.clip(ndtr(margin), 0.02, 0.98))
    odds = float(np.log(chance / (1 - chance)))
    odds += _switch_odds(window, last, rise.time)
    return odds + (1.0 if rise.suddenness > 6 and rise.height > 0.12 else -1.0)


def _switch_odds(window: Window, last: float, time: float) -> float:
    """Votes of the main gears' ground switches between two contacts."""
    seen = []
    for parameter in (Parameter.GEAR_LEFT, Parameter.GEAR_RIGHT, Parameter.GEAR_ANY):
        for series in aligned(window, parameter):
            after = (series.time > last) & (series.time < time + series.entry.late_most.value)
            if after.sum() >= 2:
                seen.append(series.value[after])
    if not seen:
        return 0.0
    if all(values[-1] > 0.5 and np.all(values[1:] > 0.5) for values in seen):
        return -1.5  # it may open too late to be seen in a short flight
    opened = any(np.any(np.diff(values) < 0) for values in seen)
    return 2.0 if opened else 0.5


def _coming_down(
    window: Window,
    normal: Series,
    courses: Courses,
    geometry: Geometry,
    first: ContactTime,
    end: float,
    wheels: tuple[Wheel, ...],
    kind: ContactKind,
) -> ContactTime | None:
    """First time at which the wheels that did not touch first come down to the ground."""
    if not wheels:
        return None
    grid = np.arange(first.time + 0.02, end, 0.01)
    height, sd = lowest_course(courses, geometry, wheels, grid)
    down = np.flatnonzero(height < 0)
    if len(down) == 0:
        return None
    crossing = float(grid[down[0]])
    around = (max(crossing - 0.5, first.time + 0.02), crossing + 0.5)
    return timed(window, normal, around, kind, (grid, height, sd), None)
