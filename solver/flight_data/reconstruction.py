"""The one public call: a window in, contacts with their states out, or why it cannot tell."""

from dataclasses import dataclass, replace

import numpy as np

from solver.flight_data.alignment import Series, best
from solver.flight_data.ambiguity import widened, widened_state
from solver.flight_data.bounces import later_contacts
from solver.flight_data.contacts import NOSE_KINDS, ContactKind, ContactTime
from solver.flight_data.datum import Datum
from solver.flight_data.derotation import nose_contact
from solver.flight_data.first_contact import first_contact, is_nose_first, nose_first
from solver.flight_data.geometry import Geometry
from solver.flight_data.nose_wheel import nose_wheel_is_down, within_travel
from solver.flight_data.parameter import Parameter
from solver.flight_data.smoothing import smooth_window, touching_wheels
from solver.flight_data.sufficiency import Shortcoming, UndeterminedError, check_gaps, shortcomings
from solver.flight_data.touchdown import Courses, Estimate, TouchdownState, touchdown_state
from solver.flight_data.wheels import wheel_course
from solver.flight_data.window import Window

#: Hypotheses of the first contact that are less likely are not followed up.
_NEGLIGIBLE = 0.01

#: Contacts of two hypotheses that are closer than this may be the same one [s].
_SAME = 0.4


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
    nose_wheel_down: bool = False  #: it stayed on the ground through the hop


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
    check_gaps(window, hypotheses[0].contact.time)
    courses, found = _followed(window, normal, geometry, datum, hypotheses[0].contact)
    others = [
        (each.chance, _followed(window, normal, geometry, datum, each.contact)[1])
        for each in hypotheses[1:]
        if each.chance > _NEGLIGIBLE
    ]
    notes = () if datum.found else ("no rolling in the window: normal acceleration not zeroed",)
    return Reconstruction(_widened(found, others), (), courses, datum, notes)


def _followed(
    window: Window, normal: Series, geometry: Geometry, datum: Datum, first: ContactTime
) -> tuple[Courses, tuple[FoundContact, ...]]:
    """Courses and contacts that follow from one time of the first contact."""
    # The later contacts are timed by a height that is tied to the first one only: tied to
    # themselves they would bear themselves out.
    courses = smooth_window(window, normal, geometry, [first], datum)
    if is_nose_first(courses, geometry, first.time):
        first = nose_first(first)
        courses = smooth_window(window, normal, geometry, [first], datum)
    contacts = [first, *later_contacts(window, normal, courses, geometry, first)]
    if len(contacts) > 1:
        courses = smooth_window(window, normal, geometry, contacts, datum)
    if first.kind is not ContactKind.NOSE_FIRST:
        nose = nose_contact(window, normal, courses, geometry, contacts)
        if nose is not None:
            contacts = sorted([*contacts, nose], key=lambda contact: contact.time)
            courses = smooth_window(window, normal, geometry, contacts, datum)
    return courses, tuple(_found(contact, courses, geometry, contacts) for contact in contacts)


def _widened(
    found: tuple[FoundContact, ...], others: list[tuple[float, tuple[FoundContact, ...]]]
) -> tuple[FoundContact, ...]:
    """Let what other times of the first contact lead to widen the deviations of each contact."""
    contacts = []
    for contact in found:
        same = [
            (chance, match)
            for chance, other in others
            if (match := _counterpart(contact, found[0], other)) is not None
        ]
        time = widened(
            Estimate(contact.time, contact.time_sd),
            [(chance, Estimate(match.time, match.time_sd)) for chance, match in same],
        )
        state = widened_state(contact.state, [(chance, match.state) for chance, match in same])
        contacts.append(replace(contact, time_sd=time.sd, state=state))
    return tuple(contacts)


def _counterpart(
    contact: FoundContact, first: FoundContact, other: tuple[FoundContact, ...]
) -> FoundContact | None:
    """Contact that would be this one if another hypothesis of the first contact held."""
    if contact is first:
        return other[0]
    near = [each for each in other if abs(each.time - contact.time) < _SAME]
    alike = near if contact.kind is not ContactKind.DEROTATION else other
    return min(
        (each for each in alike if each.kind is contact.kind),
        key=lambda each: abs(each.time - contact.time),
        default=None,
    )


def _found(
    contact: ContactTime, courses: Courses, geometry: Geometry, contacts: list[ContactTime]
) -> FoundContact:
    at = np.array([contact.time])
    lowest = min(
        touching_wheels(contact.kind, geometry),
        key=lambda wheel: float(wheel_course(courses, geometry, wheel, at)[0][0]),
    )
    before = [other.time for other in contacts if other.time < contact.time]
    state = touchdown_state(courses, geometry, contact.time, contact.sd, max(before, default=None))
    touched = [other.time for other in contacts if other.kind in NOSE_KINDS]
    is_down = contact.kind is ContactKind.BOUNCE and nose_wheel_is_down(
        state, contact.time, touched, geometry
    )
    if is_down:
        state = within_travel(state, geometry)
    return FoundContact(
        contact.kind, contact.time, contact.sd, lowest.gear, contact, state, contact.chance, is_down
    )
