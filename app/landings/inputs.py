"""The solver's record as stored JSON and back, so that a later run takes exactly the same input."""

from dataclasses import asdict
from typing import Any

from solver.assessment import TouchdownRecord
from solver.landing.contact import Contact, Lift, LiftModel
from solver.landing.contact_uncertainty import ContactUncertainty
from solver.recorded import RecordedContact, RecordedPeak


def to_json(record: TouchdownRecord) -> dict[str, Any]:
    return asdict(record)


def from_json(stored: dict[str, Any]) -> TouchdownRecord:
    contacts = tuple(
        Contact(**{**contact, "lift": _lift(contact["lift"])}) for contact in stored["contacts"]
    )
    # Landings stored by earlier versions carry no recorded peaks.
    recorded = tuple(_recorded(contact) for contact in stored.get("recorded", ()))
    uncertainties = tuple(_uncertainty(each) for each in stored.get("uncertainties", ()))
    fields = {
        "contacts": contacts,
        "missing": tuple(stored["missing"]),
        "recorded": recorded,
        "uncertainties": uncertainties,
        "unexplained": tuple(stored.get("unexplained", ())),
    }
    return TouchdownRecord(**{**stored, **fields})


def _uncertainty(stored: dict[str, Any]) -> ContactUncertainty:
    # Landings stored by earlier versions say nothing of the lift's course.
    found = {name: tuple(stored[name]) for name in ("lift_course",) if name in stored}
    return ContactUncertainty(tuple(tuple(row) for row in stored["covariance"]), **found)


def _lift(stored: dict[str, Any]) -> Lift:
    return Lift(**{**stored, "model": LiftModel(stored["model"])})


def _recorded(stored: dict[str, Any]) -> RecordedContact:
    peaks = {
        name: None if stored[name] is None else RecordedPeak(**stored[name])
        for name in ("normal_load_factor", "lateral_load_factor")
    }
    return RecordedContact(**{**stored, **peaks})
