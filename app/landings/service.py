"""Taking landings in, once each."""

import hashlib
import json
from dataclasses import replace
from datetime import UTC, datetime
from typing import Any

from sqlalchemy import Engine
from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from app.assessments.models import AssessmentJob
from app.assessments.states import State
from app.audit import service as audit
from app.config import LANES, Settings
from app.db import DatabaseTime, new_id, reading, writing
from app.errors import not_found, problem
from app.fleet.registry import AircraftRegistry
from app.landings import inputs, repository
from app.landings.answers import LandingAccepted, LandingDetail, LandingFilter, LandingSummary
from app.landings.field_errors import FieldError, InvalidRecordError
from app.landings.intake import Intake, take_in, unknown_aircraft
from app.landings.models import IdempotencyKey, Landing
from app.landings.schemas import TouchdownRecordIn
from app.paging import Page, decode_cursor, encode_cursor
from app.security import Principal
from solver.assessment import Verdict


def accept(
    engine: Engine,
    settings: Settings,
    registry: AircraftRegistry,
    principal: Principal,
    record: TouchdownRecordIn,
    *,
    lane: str,
    idempotency_key: str | None,
    body_digest: str | None = None,
    lacking: tuple[str, ...] = (),
) -> LandingAccepted:
    """Store a landing and its assessment in one transaction, or find the one it repeats.

    ``body_digest`` is the identity of what the record was made from, where that is not the record
    itself; ``lacking`` is what keeps it from carrying a verdict besides its missing fields.
    """
    aircraft = registry.get(record.aircraft.model_id)
    if aircraft is None:
        known = [a.definition.name for a in registry.all()]
        raise InvalidRecordError([unknown_aircraft(record, known)])
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
    intake = take_in(record, aircraft.definition)
    if lacking:
        intake.record = replace(intake.record, missing=lacking)
    posted = record.model_dump(mode="json", by_alias=True, exclude_unset=True)
    body_digest = body_digest or _digest(posted)
    try:
        with writing(engine) as session:
            return _find_or_store(
                session, settings, principal, record, intake, posted, body_digest,
                lane=lane, idempotency_key=idempotency_key,
            )  # fmt: skip
    except IntegrityError:
        # The same record came in twice at the same moment; the other one was first.
        with writing(engine) as session:
            return _find_or_store(
                session, settings, principal, record, intake, posted, body_digest,
                lane=lane, idempotency_key=idempotency_key,
            )  # fmt: skip


def _find_or_store(
    session: Session,
    settings: Settings,
    principal: Principal,
    record: TouchdownRecordIn,
    intake: Intake,
    posted: dict[str, Any],
    body_digest: str,
    *,
    lane: str,
    idempotency_key: str | None,
) -> LandingAccepted:
    repository.forget_expired_keys(session)
    record_id = record.record_id or f"sha256:{body_digest}"
    by_key = idempotency_key and repository.by_idempotency_key(session, principal, idempotency_key)
    if by_key:
        _same_body(by_key.body_digest, body_digest, "Idempotency-Key", str(idempotency_key))
        return _accepted(session, principal, by_key.landing_id, is_repeated=True)
    earlier = repository.by_record_id(session, principal, record_id)
    if earlier is not None:
        _same_body(earlier.body_digest, body_digest, "record_id", record_id)
    landing_id = earlier.id if earlier else _store(
        session, principal, record, intake, posted, record_id, body_digest, lane
    )  # fmt: skip
    if idempotency_key is not None:
        session.add(
            IdempotencyKey(
                operator_id=principal.operator_id,
                key=idempotency_key,
                body_digest=body_digest,
                landing_id=landing_id,
                expires_at=DatabaseTime(settings.idempotency_days * 86_400.0),
            )
        )
    session.flush()
    return _accepted(session, principal, landing_id, is_repeated=earlier is not None)


def _store(
    session: Session,
    principal: Principal,
    record: TouchdownRecordIn,
    intake: Intake,
    posted: dict[str, Any],
    record_id: str,
    body_digest: str,
    lane: str,
) -> str:
    landing = Landing(
        id=new_id(),
        operator_id=principal.operator_id,
        record_id=record_id,
        body_digest=body_digest,
        aircraft=record.aircraft.model_id,
        tail=record.aircraft.tail_token,
        touchdown_at=record.contacts[0].t_utc or datetime.now(UTC),
        record=posted,
        inputs=inputs.to_json(intake.record),
        sd=intake.sd,
        sd_defaulted=intake.sd_defaulted,
        taken_as_zero=intake.taken_as_zero,
    )
    session.add(landing)
    session.flush()
    job = AssessmentJob(
        id=new_id(),
        operator_id=principal.operator_id,
        landing_id=landing.id,
        lane=LANES[lane],
    )
    session.add(job)
    audit.record(
        session,
        operator_id=principal.operator_id,
        actor=principal.actor,
        action="received",
        subject="landing",
        subject_id=landing.id,
        assessment=job.id,
        lane=lane,
        body_sha256=body_digest,
    )
    return landing.id


def _same_body(known: str, given: str, what: str, value: str) -> None:
    if known != given:
        raise problem(
            409,
            "conflict",
            f"This {what} was used for another body",
            f"{what} {value!r} belongs to a record with another content; send the record "
            "unchanged or under a new identity",
        )


def _accepted(
    session: Session, principal: Principal, landing_id: str, *, is_repeated: bool
) -> LandingAccepted:
    row = repository.get(session, principal, landing_id)
    assert row is not None  # noqa: S101 - found or stored in this very transaction
    landing, job, _ = row
    return LandingAccepted(
        landing_id=landing.id,
        assessment_id=job.id,
        state=State(job.state),
        is_repeated=is_repeated,
        sd_defaulted=landing.sd_defaulted,
        taken_as_zero=landing.taken_as_zero,
        missing=landing.inputs["missing"],
        links=_links(landing.id, job.id),
    )


def get(engine: Engine, principal: Principal, landing_id: str) -> LandingDetail:
    with reading(engine) as session:
        row = repository.get(session, principal, landing_id)
    if row is None:
        raise not_found("landing", landing_id)
    landing = row[0]
    return LandingDetail(
        **_summary(row).model_dump(),
        record=landing.record,
        inputs=landing.inputs,
        sd=landing.sd,
        sd_defaulted=landing.sd_defaulted,
        taken_as_zero=landing.taken_as_zero,
    )


def page(engine: Engine, principal: Principal, wanted: LandingFilter) -> Page[LandingSummary]:
    after = None if wanted.cursor is None else decode_cursor(wanted.cursor)
    with reading(engine) as session:
        rows = repository.page(session, principal, wanted, after, wanted.limit + 1)
    shown = rows[: wanted.limit]
    last = shown[-1][0] if len(rows) > wanted.limit else None
    return Page(
        items=[_summary(row) for row in shown],
        next=encode_cursor(last.touchdown_at, last.id) if last else None,
    )


def _summary(row: repository.Listed) -> LandingSummary:
    landing, job, verdict = row
    return LandingSummary(
        id=landing.id,
        record_id=landing.record_id,
        aircraft=landing.aircraft,
        tail=landing.tail,
        touchdown_at=landing.touchdown_at,
        received_at=landing.received_at,
        contacts=len(landing.inputs["contacts"]),
        assessment_id=job.id,
        state=State(job.state),
        verdict=Verdict(verdict.verdict) if verdict else None,
        action=Verdict(verdict.action) if verdict else None,
        is_provisional=verdict.is_provisional if verdict else None,
        worst_utilisation=verdict.worst_utilisation if verdict else None,
        links=_links(landing.id, job.id),
    )


def _links(landing_id: str, assessment_id: str) -> dict[str, str]:
    assessment = f"/v1/assessments/{assessment_id}"
    return {
        "landing": f"/v1/landings/{landing_id}",
        "assessment": assessment,
        "hot_spots": f"{assessment}/hot-spots",
        "histories": f"{assessment}/histories",
        "peak_field": f"{assessment}/peak-field",
    }


def _digest(posted: dict[str, Any]) -> str:
    """Identity of a record's content, whatever the order and spacing of its text."""
    canonical = json.dumps(posted, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(canonical.encode()).hexdigest()
