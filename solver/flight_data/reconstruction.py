"""The one public call: a window in, contacts with their states out, or why it cannot tell."""

from dataclasses import dataclass, replace

import numpy as np

from solver.flight_data.alignment import Series, best
from solver.flight_data.bounces import later_contacts
from solver.flight_data.contacts import ContactKind, ContactTime
from solver.flight_data.datum import Datum
from solver.flight_data.first_contact import first_contact, is_nose_first, nose_first
from solver.flight_data.geometry import Geometry
from solver.flight_data.parameter import Parameter
from solver.flight_data.smoothing import smooth_window, touching_wheels
from solver.flight_data.sufficiency import Shortcoming, UndeterminedError, check_gaps, shortcomings
from solver.flight_data.touchdown import Courses, TouchdownState, touchdown_state
from solver.flight_data.wheels import wheel_course
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
    chance: float = 1.0  #: that there was such a contact; a bounce may be none


@dataclass(frozen=True, slots=True)
class Reconstruction:
    """What a window tells of a landing."""

    contacts: tuple[FoundContact, ...]
    cannot_tell: tuple[Shortcoming, ...]  #: empty: the window carries a verdict
    courses: Courses | None
    datum: Datum | None
    notes: tuple[str, ...]


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
    try:
        return _reconstructed(window, normal, geometry)
    except UndeterminedError as error:
        return Reconstruction((), (error.shortcoming,), None, None, ())


def _reconstructed(window: Window, normal: Series, geometry: Geometry) -> Reconstruction:
    hypotheses, datum = first_contact(window, normal, geometry)
    first = hypotheses[0].contact
    spread = sum(
        each.chance * (each.contact.sd**2 + (each.contact.time - first.time) ** 2)
        for each in hypotheses
    )
    check_gaps(window, first.time)
    # The later contacts are timed by a height that is tied to the first one only: tied to
    # themselves they would bear themselves out.
    courses = smooth_window(window, normal, geometry, [first], datum)
    if is_nose_first(courses, geometry, first.time):
        first = nose_first(first)
        courses = smooth_window(window, normal, geometry, [first], datum)
    contacts = [first, *later_contacts(window, normal, courses, geometry, first)]
    if len(contacts) > 1:
        courses = smooth_window(window, normal, geometry, contacts, datum)
    found = [_found(contact, courses, geometry) for contact in contacts]
    found[0] = replace(found[0], time_sd=float(np.sqrt(spread)))
    notes = () if datum.found else ("no rolling in the window: normal acceleration not zeroed",)
    return Reconstruction(tuple(found), (), courses, datum, notes)


def _found(contact: ContactTime, courses: Courses, geometry: Geometry) -> FoundContact:
    at = np.array([contact.time])
    lowest = min(
        touching_wheels(contact.kind, geometry),
        key=lambda wheel: float(wheel_course(courses, geometry, wheel, at)[0][0]),
    )
    state = touchdown_state(courses, geometry, contact.time, contact.sd)
    return FoundContact(
        contact.kind, contact.time, contact.sd, lowest.gear, contact, state, contact.chance
    )
