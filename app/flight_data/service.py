"""Recorder windows become landings, which go the same way as posted records."""

from typing import Any

from sqlalchemy import Engine

from app.config import Settings
from app.fleet.envelopes import Envelopes
from app.fleet.registry import AircraftRegistry
from app.flight_data.answers import CannotTell, WindowAccepted, WindowNote
from app.flight_data.contact_answers import contact_found
from app.flight_data.intake import WindowIntake, take_in_window
from app.flight_data.schemas import WindowQuery
from app.landings import service as landings
from app.landings.arrivals import Reconstructed
from app.landings.field_errors import FieldError, InvalidRecordError
from app.landings.intake import NEEDED_FOR_A_VERDICT, parse_record
from app.security import Principal


def accept(
    engine: Engine,
    settings: Settings,
    registry: AircraftRegistry,
    envelopes: Envelopes,
    principal: Principal,
    content: bytes,
    query: WindowQuery,
    *,
    idempotency_key: str | None,
) -> WindowAccepted:
    """Reconstruct a window's landing and store it, or find the one it repeats."""
    aircraft = registry.get(query.aircraft)
    if aircraft is None:
        known = ", ".join(a.definition.name for a in registry.all()) or "none yet"
        fault = FieldError("aircraft", query.aircraft, known, "no such aircraft definition")
        raise InvalidRecordError([fault])
    intake = take_in_window(content, query, aircraft)
    accepted = landings.accept(
        engine,
        settings,
        registry,
        envelopes,
        principal,
        parse_record(intake.record),
        lane=query.lane,
        idempotency_key=idempotency_key,
        body_digest=intake.digest,
        reconstructed=_reconstructed(intake),
    )
    return WindowAccepted(**accepted.model_dump(), **_understood(intake))


def _reconstructed(intake: WindowIntake) -> Reconstructed:
    given = intake.record["contacts"]
    return Reconstructed(
        lacking=tuple(f"{each.settled_by} ({each.reason})" for each in intake.found.cannot_tell),
        unexplained=intake.responses.unexplained,
        uncertainties=tuple(
            uncertainty
            for contact, uncertainty in zip(given, intake.responses.uncertainties, strict=False)
            if all(name in contact for name in NEEDED_FOR_A_VERDICT)
        ),
    )


def _understood(intake: WindowIntake) -> dict[str, Any]:
    updates = {id(update.found): update for update in intake.responses.updates}
    return {
        "contacts": [
            contact_found(contact, updates.get(id(contact))) for contact in intake.found.contacts
        ],
        "cannot_tell": [
            CannotTell(code=each.code, reason=each.reason, settled_by=each.settled_by)
            for each in intake.found.cannot_tell
        ],
        "notes": [WindowNote(code=n.code, text=n.text) for n in intake.notes],
    }
