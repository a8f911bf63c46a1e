"""The first contact of a window: which rise it is, and when."""

from dataclasses import replace

import numpy as np

from solver.arrays import Array
from solver.flight_data.alignment import Series
from solver.flight_data.contacts import (
    ONSET,
    SUDDEN,
    ContactKind,
    ContactTime,
    Rise,
    first_rises,
    is_plain,
    likely_contact,
    speaks,
    timed,
)
from solver.flight_data.datum import Datum, normal_datum
from solver.flight_data.geometry import Geometry, Place
from solver.flight_data.smoothing import SETTLING, smooth_window
from solver.flight_data.sufficiency import Shortcoming, UndeterminedError, check_gaps
from solver.flight_data.touchdown import Courses
from solver.flight_data.vote import Vote
from solver.flight_data.wheels import lowest_course
from solver.flight_data.window import Window

#: How well a smoothed height is trusted besides its own standard deviation [m].
_HEIGHT_SD = 0.1

#: What the rise of the normal acceleration is late by when the nose wheel touches first: its
#: load is a fraction of the mains' and mostly turns the aircraft [s].
_NOSE_LEAD = 0.06

_NO_CONTACT = Shortcoming(
    "no_contact",
    "no ground contact is found in the window",
    "a window from 20 s before to 10 s after the touchdown",
)


def first_contact(window: Window, normal: Series, geometry: Geometry) -> tuple[ContactTime, Datum]:
    """Find a sudden rise with the wheels at the ground, or else where the height passes zero.

    Raises
    ------
    UndeterminedError
        Nothing shows a contact, or a needed channel has a gap there.
    """
    candidates = first_rises(window, normal)
    strong = [rise for rise in candidates if rise.suddenness >= SUDDEN] or candidates
    for rise in strong:
        datum, height = _untied_height(window, normal, geometry, rise.time)
        for other in candidates:
            at, doubt = (float(np.interp(other.time, height[0], each)) for each in height[1:])
            if other.time > rise.time or at > doubt * _trust(other):
                continue
            around = (other.time - normal.interval - 0.2, other.time + 0.05)
            contact = timed(window, normal, around, ContactKind.FIRST, height, other)
            if contact is not None and (is_plain(other) or speaks(contact, ONSET)):
                return contact, datum
    guess = strong[0].time if strong else likely_contact(window)
    if guess is None or not normal.time[0] + 2.0 < guess < normal.time[-1] - 1.0:
        raise UndeterminedError(_NO_CONTACT)
    datum, height = _untied_height(window, normal, geometry, guess)
    down = np.flatnonzero(height[1] < 0)
    if len(down) == 0:
        raise UndeterminedError(_NO_CONTACT)
    crossing = float(height[0][down[0]])
    around = (crossing - 1.0, crossing + 0.6)
    contact = timed(window, normal, around, ContactKind.FIRST, height, None)
    if contact is None:
        raise UndeterminedError(_NO_CONTACT)
    return contact, datum


def is_nose_first(courses: Courses, geometry: Geometry, time: float) -> bool:
    """Whether the nose wheel was lower than the main wheels at the first contact."""
    noses = geometry.of(Place.NOSE)
    if not noses:
        return False
    at = np.array([time])
    nose, _ = lowest_course(courses, geometry, noses, at)
    main, _ = lowest_course(courses, geometry, geometry.mains, at)
    return bool(nose[0] < main[0])


def nose_first(first: ContactTime) -> ContactTime:
    """First contact by the nose wheel, whose own shock hardly shows at the accelerometer."""
    return replace(
        first,
        kind=ContactKind.NOSE_FIRST,
        time=first.time - _NOSE_LEAD,
        sd=float(np.hypot(first.sd, _NOSE_LEAD)),
    )


def _trust(rise: Rise) -> float:
    """How many standard deviations the wheels may be off the ground; a gust is a weak rise."""
    return float(np.clip((rise.suddenness - 3.0) / 4.0, 0.4, 2.0))


def _untied_height(
    window: Window, normal: Series, geometry: Geometry, guess: float
) -> tuple[Datum, tuple[Array, Array, Array]]:
    """Height of the main wheels around a guess, from a smoothing that knows of no touch."""
    check_gaps(window, guess)
    datum = normal_datum(normal, guess + SETTLING + 1.0)
    contact = ContactTime(ContactKind.FIRST, guess, 0.1, Vote(guess, 0.1, ()))
    courses = smooth_window(window, normal, geometry, [contact], datum, is_tied=False)
    grid = np.arange(guess - 4.0, guess + 1.5, 0.02)
    height, sd = lowest_course(courses, geometry, geometry.mains, grid)
    return datum, (grid, height, np.hypot(sd, _HEIGHT_SD))
