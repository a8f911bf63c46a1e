"""A posted record on its way in: checked for its sender and its aircraft, ready to be stored."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Any

from app.fleet.registry import AircraftRegistry
from app.landings import inputs
from app.landings.field_errors import FieldError, InvalidRecordError
from app.landings.intake import take_in, unknown_aircraft
from app.landings.schemas import TouchdownRecordIn
from app.security import Principal
from solver.aircraft.definition import AircraftDefinition
from solver.assessment import TouchdownRecord
from solver.landing.contact_uncertainty import ContactUncertainty

Fleet = Mapping[str, AircraftDefinition]


@dataclass(frozen=True, slots=True)
class Arrival:
    """A record as posted and as the solver takes it, with the identity it goes by."""

    record_id: str  #: the sender's own, or one made from the content
    body_digest: str
    aircraft: str
    tail: str | None
    touchdown_at: datetime | None
    posted: dict[str, Any]
    inputs: dict[str, Any]
    sd: dict[str, float]
    sd_defaulted: list[str]
    taken_as_zero: list[str]
    provisional: dict[str, Any] | None = None  #: verdict; see `app.assessments.provisional`


@dataclass(frozen=True, slots=True)
class Reconstructed:
    """What is known of a record that was made from a recording, besides the record itself."""

    lacking: tuple[str, ...]  #: what keeps it from carrying a verdict, in place of missing fields
    unexplained: tuple[str, ...]  #: recorded responses that do not fit
    uncertainties: tuple[ContactUncertainty, ...]  #: of each contact whose state is known

    def onto(self, record: TouchdownRecord) -> TouchdownRecord:
        """Record with all that."""
        return replace(
            record,
            missing=self.lacking or record.missing,
            unexplained=self.unexplained,
            uncertainties=self.uncertainties,
        )


def fleet(registry: AircraftRegistry) -> Fleet:
    """Aircraft that records may name now."""
    return {aircraft.definition.name: aircraft.definition for aircraft in registry.all()}


def check(
    record: TouchdownRecordIn,
    principal: Principal,
    known: Fleet,
    *,
    body_digest: str | None = None,
    reconstructed: Reconstructed | None = None,
) -> Arrival:
    """Convert a record; raises `InvalidRecordError` for what cannot be taken in.

    ``body_digest`` and ``reconstructed`` as in `service.accept`.
    """
    definition = known.get(record.aircraft.model_id)
    if definition is None:
        raise InvalidRecordError([unknown_aircraft(record, list(known))])
    if record.operator_token not in (None, principal.operator):
        raise InvalidRecordError(
            [
                FieldError(
                    "operator_token",
                    record.operator_token,
                    principal.operator,
                    "is not the operator of this key",
                )
            ]
        )
    intake = take_in(record, definition)
    if reconstructed is not None:
        intake.record = reconstructed.onto(intake.record)
    posted = record.model_dump(mode="json", by_alias=True, exclude_unset=True)
    body_digest = body_digest or _digest(posted)
    return Arrival(
        record_id=record.record_id or f"sha256:{body_digest}",
        body_digest=body_digest,
        aircraft=record.aircraft.model_id,
        tail=record.aircraft.tail_token,
        touchdown_at=record.contacts[0].t_utc,
        posted=posted,
        inputs=inputs.to_json(intake.record),
        sd=intake.sd,
        sd_defaulted=intake.sd_defaulted,
        taken_as_zero=intake.taken_as_zero,
    )


def _digest(posted: dict[str, Any]) -> str:
    """Identity of a record's content, whatever the order and spacing of its text."""
    canonical = json.dumps(posted, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(canonical.encode()).hexdigest()
