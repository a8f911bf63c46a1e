"""Recorder windows become landings, which go the same way as posted records."""

from typing import Any

from sqlalchemy import Engine

from app.config import Settings
from app.fleet.registry import AircraftRegistry
from app.flight_data.answers import CannotTell, ContactFound, WindowAccepted, WindowNote
from app.flight_data.intake import WindowIntake, take_in_window
from app.flight_data.schemas import WindowQuery
from app.landings import service as landings
from app.landings.field_errors import FieldError, InvalidRecordError
from app.landings.intake import parse_record
from app.security import Principal


def accept(
    engine: Engine,
    settings: Settings,
    registry: AircraftRegistry,
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
    intake = take_in_window(content, query, aircraft.definition)
    accepted = landings.accept(
        engine,
        settings,
        registry,
        principal,
        parse_record(intake.record),
        lane=query.lane,
        idempotency_key=idempotency_key,
        body_digest=intake.digest,
        lacking=tuple(f"{each.settled_by} ({each.reason})" for each in intake.found.cannot_tell),
    )
    return WindowAccepted(**accepted.model_dump(), **_understood(intake))


def _understood(intake: WindowIntake) -> dict[str, Any]:
    return {
        "contacts": [
            ContactFound(
                kind=contact.kind,
                gear=contact.gear,
                time_s=contact.time,
                time_sd_s=contact.time_sd,
                chance=contact.chance,
                sink_rate_m_s=contact.state.sink_rate.value,
                sink_rate_sd_m_s=contact.state.sink_rate.sd,
                gear_sink_rates_m_s={
                    gear: estimate.value for gear, estimate in contact.state.gear_sink_rates.items()
                },
            )
            for contact in intake.found.contacts
        ],
        "cannot_tell": [
            CannotTell(code=each.code, reason=each.reason, settled_by=each.settled_by)
            for each in intake.found.cannot_tell
        ],
        "notes": [WindowNote(code=n.code, text=n.text) for n in intake.window.notes],
    }
