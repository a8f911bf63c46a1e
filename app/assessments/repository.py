"""Queries on assessments."""

from collections.abc import Sequence
from typing import Any

from sqlalchemy import Row, func, select
from sqlalchemy.orm import Session

from app.artefacts.models import Artefact
from app.assessments.models import AssessmentJob, HotSpotRow, VerdictRow
from app.security import Principal
from app.tenancy import scoped

Found = Row[AssessmentJob, VerdictRow | None]


def get(session: Session, principal: Principal, assessment_id: str) -> Found | None:
    statement: Any = (
        scoped(principal, AssessmentJob, VerdictRow)
        .outerjoin(VerdictRow, VerdictRow.assessment_id == AssessmentJob.id)
        .where(AssessmentJob.id == assessment_id)
    )
    found: Found | None = session.execute(statement).one_or_none()
    return found


def version(session: Session, principal: Principal, assessment_id: str) -> int | None:
    """Just what a conditional request needs."""
    statement = scoped(principal, AssessmentJob).with_only_columns(AssessmentJob.version)
    return session.scalar(statement.where(AssessmentJob.id == assessment_id))


def hot_spots(session: Session, assessment_id: str) -> Sequence[HotSpotRow]:
    return session.scalars(
        select(HotSpotRow)
        .where(HotSpotRow.assessment_id == assessment_id)
        .order_by(HotSpotRow.rank)
    ).all()


def count_of_histories(session: Session, assessment_id: str) -> int:
    statement = select(func.count()).where(
        Artefact.assessment_id == assessment_id, Artefact.kind.startswith("history-")
    )
    return session.scalar(statement) or 0
