"""Taking landings in, once each."""

from collections.abc import Sequence
from dataclasses import replace

from fastapi_problem.error import Problem
from sqlalchemy import Engine
from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from app.assessments.answers import ProvisionalOut
from app.assessments.provisional import provisional
from app.assessments.states import State
from app.config import LANES, Settings
from app.db import reading, writing
from app.errors import not_found, problem
from app.fleet.envelopes import Envelopes
from app.fleet.registry import AircraftRegistry
from app.landings import arrivals, inputs, repository
from app.landings.answers import LandingAccepted, LandingDetail, LandingFilter, LandingSummary
from app.landings.arrivals import Arrival, Reconstructed
from app.landings.repository import Kept
from app.landings.schemas import TouchdownRecordIn
from app.paging import Page, decode_cursor, encode_cursor
from app.security import Principal
from solver.assessment import Verdict


def accept(
    engine: Engine,
    settings: Settings,
    registry: AircraftRegistry,
    envelopes: Envelopes,
    principal: Principal,
    record: TouchdownRecordIn,
    *,
    lane: str,
    idempotency_key: str | None,
    body_digest: str | None = None,
    reconstructed: Reconstructed | None = None,
) -> LandingAccepted:
    """Store a landing and its assessment in one transaction, or find the one it repeats.

    Its provisional verdict is given and stored with it.
    ``body_digest`` is the identity of what the record was made from, where that is not the record
    itself; ``reconstructed`` is what else is known where it was made from a recording.
    """
    known = arrivals.fleet(registry)
    arrival = arrivals.check(
        record, principal, known, body_digest=body_digest, reconstructed=reconstructed
    )
    arrival = replace(
        arrival,
        provisional=provisional(envelopes.get(arrival.aircraft), inputs.from_json(arrival.inputs)),
    )
    try:
        kept = _accept(engine, settings, principal, arrival, lane, idempotency_key)
    except IntegrityError:
        # The same record came in twice at the same moment; the other one was first.
        kept = _accept(engine, settings, principal, arrival, lane, idempotency_key)
    return LandingAccepted(
        landing_id=kept.landing_id,
        assessment_id=kept.assessment_id,
        state=State(kept.state),
        is_repeated=kept.is_repeated,
        sd_defaulted=arrival.sd_defaulted,
        taken_as_zero=arrival.taken_as_zero,
        missing=list(arrival.inputs["missing"]),
        provisional=None
        if kept.provisional is None
        else ProvisionalOut.model_validate(kept.provisional),
        links=_links(kept.landing_id, kept.assessment_id),
    )


def _accept(
    engine: Engine,
    settings: Settings,
    principal: Principal,
    arrival: Arrival,
    lane: str,
    idempotency_key: str | None,
) -> Kept:
    with writing(engine) as session:
        if idempotency_key is None:
            (kept,) = find_or_store(session, principal, [arrival], lane)
            return _same_body(kept, arrival, "record_id", arrival.record_id)
        repository.forget_expired_keys(session)
        used = repository.by_idempotency_key(session, principal, idempotency_key)
        if used is not None:
            return _same_body(used, arrival, "Idempotency-Key", idempotency_key)
        (kept,) = find_or_store(session, principal, [arrival], lane)
        _same_body(kept, arrival, "record_id", arrival.record_id)
        repository.remember_key(
            session, principal, idempotency_key, kept, settings.idempotency_days * 86_400.0
        )
        return kept


def find_or_store(
    session: Session, principal: Principal, arrived: Sequence[Arrival], lane: str
) -> list[Kept]:
    """What each arrival is kept as: stored now, or found under its identity.

    Whoever finds a landing with another content than its own has a conflict; nothing was changed.
    The number of statements is the same for one arrival and for many.
    """
    known = repository.kept(session, principal, [arrival.record_id for arrival in arrived])
    new: dict[str, Arrival] = {}
    for arrival in arrived:
        if arrival.record_id not in known:
            new.setdefault(arrival.record_id, arrival)
    stored = repository.store(session, principal, list(new.values()), LANES[lane]) if new else {}
    found = []
    for arrival in arrived:
        # Only the first of several with one identity is new.
        kept = stored.pop(arrival.record_id, None)
        if kept is not None:
            known[arrival.record_id] = replace(kept, is_repeated=True)
        found.append(kept or known[arrival.record_id])
    return found


def _same_body(kept: Kept, arrival: Arrival, what: str, value: str) -> Kept:
    if kept.body_digest != arrival.body_digest:
        raise conflict(what, value)
    return kept


def conflict(what: str, value: str) -> Problem:
    return problem(
        409,
        "conflict",
        f"This {what} was used for another body",
        f"{what} {value!r} belongs to a record with another content; send the record "
        "unchanged or under a new identity",
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
