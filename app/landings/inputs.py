"""The solver's record as stored JSON and back, so that a later run takes exactly the same input."""

from dataclasses import asdict
from typing import Any

from solver.assessment import TouchdownRecord
from solver.landing.contact import Contact, Lift, LiftModel


def to_json(record: TouchdownRecord) -> dict[str, Any]:
    return asdict(record)


def from_json(stored: dict[str, Any]) -> TouchdownRecord:
    contacts = tuple(
        Contact(**{**contact, "lift": _lift(contact["lift"])}) for contact in stored["contacts"]
    )
    return TouchdownRecord(**{**stored, "contacts": contacts, "missing": tuple(stored["missing"])})


def _lift(stored: dict[str, Any]) -> Lift:
    return Lift(**{**stored, "model": LiftModel(stored["model"])})
