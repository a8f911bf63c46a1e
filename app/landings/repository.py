"""Queries on landings."""

from collections.abc import Sequence
from datetime import datetime
from typing import Any

from sqlalchemy import Row, and_, delete, or_, select
from sqlalchemy.orm import Session

from app.assessments.models import AssessmentJob, VerdictRow
from app.db import DatabaseTime
from app.landings.answers import LandingFilter
from app.landings.models import IdempotencyKey, Landing
from app.security import Principal
from app.tenancy import scoped

Listed = Row[Landing, AssessmentJob, VerdictRow | None]


def by_record_id(session: Session, principal: Principal, record_id: str) -> Landing | None:
    statement = scoped(principal, Landing).where(Landing.record_id == record_id)
    return session.scalars(statement).one_or_none()


def by_idempotency_key(session: Session, principal: Principal, key: str) -> IdempotencyKey | None:
    return session.scalars(
        select(IdempotencyKey).where(
            IdempotencyKey.operator_id == principal.operator_id,
            IdempotencyKey.key == key,
            IdempotencyKey.expires_at > DatabaseTime(),
        )
    ).one_or_none()


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
    if wanted.state is not None:
        conditions.append(AssessmentJob.state == wanted.state)
    if wanted.from_ is not None:
        conditions.append(Landing.touchdown_at >= wanted.from_)
    if wanted.to is not None:
        conditions.append(Landing.touchdown_at < wanted.to)
    return conditions
