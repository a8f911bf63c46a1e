"""Queries on landings."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

from sqlalchemy import Row, and_, delete, insert, or_, text
from sqlalchemy.orm import Session

from app.assessments.models import AssessmentJob, VerdictRow
from app.assessments.states import State
from app.audit import service as audit
from app.config import LANE_NAMES
from app.db import DatabaseTime, new_id
from app.landings.answers import LandingFilter
from app.landings.arrivals import Arrival
from app.landings.models import IdempotencyKey, Landing
from app.rows import insert_rows
from app.security import Principal
from app.tenancy import scoped

Listed = Row[Landing, AssessmentJob, VerdictRow | None]


@dataclass(frozen=True, slots=True)
class Kept:
    """A landing as it is stored, as far as its sender needs to know."""

    landing_id: str
    assessment_id: str
    state: str
    provisional: dict[str, Any] | None
    body_digest: str
    is_repeated: bool = True


def kept(session: Session, principal: Principal, record_ids: Sequence[str]) -> dict[str, Kept]:
    """Landings that are known already, by their record's identity."""
    statement = (
        scoped(principal, Landing)
        .with_only_columns(Landing.id, Landing.record_id, Landing.body_digest)
        .where(Landing.record_id.in_(record_ids))
    )
    landings = session.execute(statement).all()
    if not landings:
        return {}
    # Asked apart: joined to a table that has just grown, new records would be sought by reading it.
    jobs = scoped(principal, AssessmentJob).with_only_columns(
        AssessmentJob.landing_id,
        AssessmentJob.id,
        AssessmentJob.state,
        AssessmentJob.provisional,
    )
    found = session.execute(jobs.where(AssessmentJob.landing_id.in_([row[0] for row in landings])))
    by_landing = {row[0]: row for row in found}
    return {
        record_id: Kept(landing_id, job.id, job.state, job.provisional, body_digest)
        for landing_id, record_id, body_digest in landings
        for job in [by_landing[landing_id]]
    }


def store(
    session: Session, principal: Principal, arrived: Sequence[Arrival], lane: int
) -> dict[str, Kept]:
    """Store landings with their assessments and audit entries; raises if one is known already."""
    landings, jobs, entries = [], [], []
    stored: dict[str, Kept] = {}
    for arrival in arrived:
        landing_id, assessment_id = new_id(), new_id()
        landings.append(
            {
                "id": landing_id,
                "operator_id": principal.operator_id,
                "record_id": arrival.record_id,
                "body_digest": arrival.body_digest,
                "aircraft": arrival.aircraft,
                "tail": arrival.tail,
                "touchdown_at": arrival.touchdown_at or datetime.now(UTC),
                "record": arrival.posted,
                "inputs": arrival.inputs,
                "sd": arrival.sd,
                "sd_defaulted": arrival.sd_defaulted,
                "taken_as_zero": arrival.taken_as_zero,
            }
        )
        jobs.append(
            {
                "id": assessment_id,
                "operator_id": principal.operator_id,
                "landing_id": landing_id,
                "lane": lane,
                "provisional": arrival.provisional,
            }
        )
        entries.append(
            audit.Entry(
                operator_id=principal.operator_id,
                actor=principal.actor,
                action="received",
                subject="landing",
                subject_id=landing_id,
                detail={
                    "assessment": assessment_id,
                    "lane": LANE_NAMES[lane],
                    "body_sha256": arrival.body_digest,
                }
                | _provisional(arrival),
            )
        )
        stored[arrival.record_id] = Kept(
            landing_id,
            assessment_id,
            State.QUEUED,
            arrival.provisional,
            arrival.body_digest,
            is_repeated=False,
        )
    insert_rows(session, Landing, landings)
    insert_rows(session, AssessmentJob, jobs)
    audit.record_all(session, entries)
    return stored


def _provisional(arrival: Arrival) -> dict[str, Any]:
    """What the audit log notes of a provisional verdict; nothing where none was asked for."""
    given = arrival.provisional
    return {} if given is None else {"provisional": given["verdict"]}


def count_anew(session: Session) -> None:
    """Bring Postgres's statistics of the queue up to date; its own daemon may take a minute."""
    if session.get_bind().dialect.name == "postgresql":
        session.execute(text("ANALYZE landing (id, operator_id, record_id), assessment"))


def by_idempotency_key(session: Session, principal: Principal, key: str) -> Kept | None:
    """The landing that a key was used for, with the digest of the body it came with."""
    statement = (
        scoped(principal, Landing)
        .with_only_columns(
            Landing.id,
            AssessmentJob.id,
            AssessmentJob.state,
            AssessmentJob.provisional,
            Landing.body_digest,
        )
        .join(AssessmentJob, AssessmentJob.landing_id == Landing.id)
        .join(IdempotencyKey, IdempotencyKey.landing_id == Landing.id)
        .where(
            IdempotencyKey.operator_id == principal.operator_id,
            IdempotencyKey.key == key,
            IdempotencyKey.expires_at > DatabaseTime(),
        )
    )
    row = session.execute(statement).one_or_none()
    return None if row is None else Kept(*row)


def remember_key(
    session: Session, principal: Principal, key: str, kept: Kept, lifetime: float
) -> None:
    session.execute(
        insert(IdempotencyKey).values(
            operator_id=principal.operator_id,
            key=key,
            body_digest=kept.body_digest,
            landing_id=kept.landing_id,
            expires_at=DatabaseTime(lifetime),
        )
    )


def forget_expired_keys(session: Session) -> None:
    session.execute(delete(IdempotencyKey).where(IdempotencyKey.expires_at <= DatabaseTime()))


def get(session: Session, principal: Principal, landing_id: str) -> Listed | None:
    return session.execute(_joined(principal).where(Landing.id == landing_id)).one_or_none()


def page(
    session: Session,
    principal: Principal,
    wanted: LandingFilter,
    after: tuple[datetime, str] | None,
    limit: int,
) -> Sequence[Listed]:
    """Landings, latest touchdown first."""
    statement = _joined(principal).where(*_conditions(wanted))
    if after is not None:
        moment, identifier = after
        statement = statement.where(
            or_(
                Landing.touchdown_at < moment,
                and_(Landing.touchdown_at == moment, Landing.id < identifier),
            )
        )
    ordered = statement.order_by(Landing.touchdown_at.desc(), Landing.id.desc())
    return session.execute(ordered.limit(limit)).all()


def _joined(principal: Principal) -> Any:
    return (
        scoped(principal, Landing, AssessmentJob, VerdictRow)
        .join(AssessmentJob, AssessmentJob.landing_id == Landing.id)
        .outerjoin(VerdictRow, VerdictRow.assessment_id == AssessmentJob.id)
    )


def _conditions(wanted: LandingFilter) -> list[Any]:
    conditions: list[Any] = []
    if wanted.aircraft is not None:
        conditions.append(Landing.aircraft == wanted.aircraft)
    if wanted.tail is not None:
        conditions.append(Landing.tail == wanted.tail)
    if wanted.verdict is not None:
        conditions.append(VerdictRow.verdict == wanted.verdict)
    if wanted.action is not None:
        conditions.append(VerdictRow.action == wanted.action)
    if wanted.state is not None:
        conditions.append(AssessmentJob.state == wanted.state)
    if wanted.from_ is not None:
        conditions.append(Landing.touchdown_at >= wanted.from_)
    if wanted.to is not None:
        conditions.append(Landing.touchdown_at < wanted.to)
    return conditions
