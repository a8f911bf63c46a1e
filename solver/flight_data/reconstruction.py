"""The one public call: a window in, contacts with their states out, or why it cannot tell."""

from dataclasses import dataclass, replace

import numpy as np

from solver.arrays import Array
from solver.flight_data.alignment import Series, aligned, best
from solver.flight_data.bounces import later_contacts
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
from solver.flight_data.course import (
    ATTITUDE_ACTIVITY,
    SPEED_ACTIVITY,
    YAW_ACTIVITY,
    Course,
    smooth_course,
)
from solver.flight_data.datum import Datum, normal_datum
from solver.flight_data.geometry import Geometry, Place, Wheel
from solver.flight_data.parameter import Parameter
from solver.flight_data.sufficiency import Shortcoming, shortcomings
from solver.flight_data.touchdown import Courses, TouchdownState, touchdown_state
from solver.flight_data.vertical import OVER_RUNWAY, smooth_vertical
from solver.flight_data.vertical_acceleration import VerticalSources
from solver.flight_data.vertical_course import Touch
from solver.flight_data.vote import Vote
from solver.flight_data.wheels import lowest_course, wheel_course
from solver.flight_data.window import Window


@dataclass(frozen=True, slots=True)
class FoundContact:
    """One ground contact and the state just before it."""

    kind: ContactKind
    time: float  #: [s]
    time_sd: float  #: [s]
    gear: str  #: whose wheels were lowest
    timing: ContactTime
    state: TouchdownState


@dataclass(frozen=True, slots=True)
class Reconstruction:
    """What a window tells of a landing."""

    contacts: tuple[FoundContact, ...]
    cannot_tell: tuple[Shortcoming, ...]  #: empty: the window carries a verdict
    courses: Courses | None
    datum: Datum | None
    notes: tuple[str, ...]


#: How long before and after the first contact the motion is smoothed [s].
BEFORE, AFTER = 9.0, 7.0

#: After so long the aircraft rolls, unless it bounced meanwhile [s].
SETTLING = 3.0

#: How well a smoothed height is trusted besides its own standard deviation [m].
_HEIGHT_SD = 0.1

#: What the rise of the normal acceleration is late by when the nose wheel touches first: its
#: load is a fraction of the mains' and mostly turns the aircraft [s].
_NOSE_LEAD = 0.06

#: Spectral density of the angular acceleration while the ground acts: half a rad/s2 over a third of
#: a second [rad2/s3].
SHOCK = 0.1

#: In heading and drift the ground acts less [rad2/s3].
YAW_SHOCK = 0.01


def reconstruct(window: Window, geometry: Geometry) -> Reconstruction:
    """Find the contacts of a window and estimate the state at each.

    Parameters
    ----------
    window : Window
    geometry : Geometry

    Returns
    -------
    Reconstruction
        Without contacts where the window cannot tell; it then says why, and what would settle it.
    """
    lacking = shortcomings(window)
    normal = best(window, Parameter.NORMAL_ACCELERATION)
    if lacking or normal is None:
        return Reconstruction((), lacking, None, None, ())
    first, datum = _first_contact(window, normal, geometry)
    if first is None or datum is None:
        return Reconstruction((), (_NO_CONTACT,), None, None, ())
    if (gap := _gap(window, first.time)) is not None:
        return Reconstruction((), (gap,), None, None, ())

    # The later contacts are timed by a height that is tied to the first one only: tied to
    # themselves they would bear themselves out.
    courses = _courses(window, normal, geometry, [first], datum)
    if _is_nose_first(courses, geometry, first.time):
        first = _earlier(first)
        courses = _courses(window, normal, geometry, [first], datum)
    contacts = [first, *later_contacts(window, normal, courses, geometry, first)]
    if len(contacts) > 1:
        courses = _courses(window, normal, geometry, contacts, datum)
    found = tuple(_found(contact, courses, geometry) for contact in contacts)
    notes = () if datum.found else ("no rolling in the window: normal acceleration not zeroed",)
    return Reconstruction(found, (), courses, datum, notes)


_NO_CONTACT = Shortcoming(
    "no_contact",
    "no ground contact is found in the window",
    "a window from 20 s before to 10 s after the touchdown",
)


def _first_contact(
    window: Window, normal: Series, geometry: Geometry
) -> tuple[ContactTime | None, Datum | None]:
    """First contact: a sudden rise with the wheels at the ground, or else the height alone."""
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
        return None, None
    datum, height = _untied_height(window, normal, geometry, guess)
    down = np.flatnonzero(height[1] < 0)
    if len(down) == 0:
        return None, None
    crossing = float(height[0][down[0]])
    around = (crossing - 1.0, crossing + 0.6)
    return timed(window, normal, around, ContactKind.FIRST, height, None), datum


def _is_nose_first(courses: Courses, geometry: Geometry, time: float) -> bool:
    """Whether the nose wheel was lower than the main wheels at the first contact."""
    noses = geometry.of(Place.NOSE)
    if not noses:
        return False
    at = np.array([time])
    nose, _ = lowest_course(courses, geometry, noses, at)
    main, _ = lowest_course(courses, geometry, geometry.mains, at)
    return bool(nose[0] < main[0])


def _earlier(first: ContactTime) -> ContactTime:
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
    datum = normal_datum(normal, guess + SETTLING + 1.0)
    contact = ContactTime(ContactKind.FIRST, guess, 0.1, Vote(guess, 0.1, ()))
    courses = _courses(window, normal, geometry, [contact], datum, is_tied=False)
    grid = np.arange(guess - 4.0, guess + 1.5, 0.02)
    height, sd = lowest_course(courses, geometry, geometry.mains, grid)
    return datum, (grid, height, np.hypot(sd, _HEIGHT_SD))


def _gap(window: Window, contact: float) -> Shortcoming | None:
    """Gap of a needed channel at the contact."""
    for parameter, reach in (
        (Parameter.NORMAL_ACCELERATION, 1.0),
        (Parameter.PITCH, 1.5),
        (Parameter.ROLL, 1.5),
    ):
        channel = window.first(parameter)
        if channel is None:
            continue
        near = channel.time[(channel.time > contact - 2 * reach) & (channel.time < contact + reach)]
        if len(near) < 2 or np.diff(near).max() > 3.5 / channel.rate:
            name = parameter.replace("_", " ")
            return Shortcoming(
                f"gap_{parameter}",
                f"{name} has a gap at the contact",
                f"{name} without a gap from 2 s before to 1 s after the contact",
            )
    return None


def _courses(
    window: Window,
    normal: Series,
    geometry: Geometry,
    contacts: list[ContactTime],
    datum: Datum,
    *,
    is_tied: bool = True,
) -> Courses:
    """Smooth everything; ``is_tied`` puts the wheels to the ground at the contacts."""
    first, last = contacts[0].time, contacts[-1].time
    span = (
        max(first - BEFORE, float(normal.time[0])),
        min(last + AFTER, float(normal.time[-1])),
    )
    nodes = np.unique(np.concatenate([[span[0], span[1]], [c.time for c in contacts]]))
    shocks = [(c.time, c.time + 1.5, SHOCK) for c in contacts]
    yaw_shocks = [(start, end, YAW_SHOCK) for start, end, _ in shocks]
    pitch = _course(window, Parameter.PITCH, nodes, shocks, ATTITUDE_ACTIVITY)
    roll = _course(window, Parameter.ROLL, nodes, shocks, ATTITUDE_ACTIVITY)
    assert pitch is not None  # noqa: S101 - `shortcomings` has looked
    assert roll is not None  # noqa: S101
    heading = _course(window, Parameter.HEADING, nodes, yaw_shocks, YAW_ACTIVITY)
    drift = _course(window, Parameter.DRIFT, nodes, yaw_shocks, YAW_ACTIVITY)
    ground = _course(window, Parameter.GROUND_SPEED, nodes, [], SPEED_ACTIVITY)
    speed = 60.0 if ground is None else float(ground.at(first))
    sources = VerticalSources(
        normal=normal,
        lateral=best(window, Parameter.LATERAL_ACCELERATION),
        longitudinal=best(window, Parameter.LONGITUDINAL_ACCELERATION),
        radio=aligned(window, Parameter.RADIO_ALTITUDE),
        inertial=aligned(window, Parameter.VERTICAL_SPEED),
        datum=datum,
    )
    touches = tuple(
        Touch(c.time, c.sd, tuple(wheel.gear for wheel in _touching(c.kind, geometry)))
        for c in contacts
        # The wheels that come down second are timed by the height: it must not be tied to them.
        if is_tied and c.kind not in (ContactKind.DEROTATION, ContactKind.MAINS)
    )
    rolling = last + SETTLING
    vertical = smooth_vertical(
        sources,
        pitch,
        roll,
        speed,
        geometry,
        touches,
        rolling if rolling < span[1] - 1.0 else None,
        first - OVER_RUNWAY,
        span,
    )
    return Courses(vertical, pitch, roll, heading, drift, ground)


def _course(
    window: Window,
    parameter: Parameter,
    nodes: Array,
    opened: list[tuple[float, float, float]],
    activity: Array,
) -> Course | None:
    series = aligned(window, parameter)
    usable = tuple(s for s in series if np.sum((s.time >= nodes[0]) & (s.time <= nodes[-1])) >= 4)
    if not usable:
        return None
    return smooth_course(usable, nodes, tuple(opened), activity)


def _touching(kind: ContactKind, geometry: Geometry) -> tuple[Wheel, ...]:
    """Wheels of which the lowest touches in a contact."""
    is_nose = kind in (ContactKind.DEROTATION, ContactKind.NOSE_FIRST)
    return geometry.of(Place.NOSE) if is_nose else geometry.mains


def _found(contact: ContactTime, courses: Courses, geometry: Geometry) -> FoundContact:
    at = np.array([contact.time])
    lowest = min(
        _touching(contact.kind, geometry),
        key=lambda wheel: float(wheel_course(courses, geometry, wheel, at)[0][0]),
    )
    state = touchdown_state(courses, geometry, contact.time, contact.sd)
    return FoundContact(contact.kind, contact.time, contact.sd, lowest.gear, contact, state)
