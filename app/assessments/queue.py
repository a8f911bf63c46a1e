"""The job protocol: claim with a lease, finish behind a fence, sweep what was left lying.

Every step is one statement under the database's own clock, the same on SQLite and Postgres.
"""

from dataclasses import dataclass
from datetime import datetime
from typing import Any

from sqlalchemy import and_, func, or_, select, update
from sqlalchemy.orm import Session

from app.assessments.models import PENDING_CLAUSE, AssessmentJob
from app.assessments.states import State
from app.audit import service as audit
from app.db import DatabaseTime, new_id
from app.landings.models import Landing

_LONGEST_ERROR = 4000


@dataclass(frozen=True, slots=True)
class Claim:
    """The right to work on one assessment until the lease is over."""

    assessment_id: str
    landing_id: str
    operator_id: str
    token: str
    attempts: int
    lease_until: datetime


def _is_due(max_attempts: int) -> Any:
    return and_(
        PENDING_CLAUSE,
        or_(
            AssessmentJob.state == State.QUEUED,
            and_(AssessmentJob.lease_until < DatabaseTime(), AssessmentJob.attempts < max_attempts),
        ),
    )


def claim(
    session: Session, *, worker: str, lanes: tuple[int, ...], lease: float, max_attempts: int
) -> Claim | None:
    """Take the best due assessment: lowest lane first, then the oldest."""
    best = (
        select(AssessmentJob.id)
        .where(_is_due(max_attempts), AssessmentJob.lane.in_(lanes))
        .order_by(AssessmentJob.lane, AssessmentJob.created_at, AssessmentJob.id)
        .limit(1)
        .with_for_update(skip_locked=True)
        .scalar_subquery()
    )
    row = session.execute(
        update(AssessmentJob)
        .where(AssessmentJob.id == best)
        .values(
            state=State.RUNNING,
            attempts=AssessmentJob.attempts + 1,
            version=AssessmentJob.version + 1,
            token=new_id(),
            lease_until=DatabaseTime(lease),
            started_at=DatabaseTime(),
            worker=worker,
        )
        .returning(
            AssessmentJob.id,
            AssessmentJob.landing_id,
            AssessmentJob.operator_id,
            AssessmentJob.token,
            AssessmentJob.attempts,
            AssessmentJob.lease_until,
        )
        .execution_options(synchronize_session=False)
    ).one_or_none()
    if row is None:
        return None
    identifier, landing_id, operator_id, token, attempts, lease_until = row
    assert token is not None and lease_until is not None  # noqa: S101, PT018 - set just above
    return Claim(identifier, landing_id, operator_id, token, attempts, lease_until)


def finish(session: Session, claimed: Claim) -> bool:
    """Close a claim as assessed; false if another worker has taken over, so nothing may be written.

    Call it first in the transaction that writes the verdict: the row stays locked until then.
    """
    return _close(session, claimed, State.ASSESSED, None)


def fail(session: Session, claimed: Claim, error: str) -> bool:
    """Close a claim for good: trying again would end the same way."""
    return _close(session, claimed, State.FAILED, error) and _audited(
        session, claimed, State.FAILED, error
    )


def give_up(session: Session, claimed: Claim, error: str, max_attempts: int) -> bool:
    """End an attempt that went wrong: back to the queue, or dead if it was the last one."""
    state = State.QUEUED if claimed.attempts < max_attempts else State.DEAD
    closed = _close(session, claimed, state, error)
    if closed and state is State.DEAD:
        _audited(session, claimed, state, error)
    return closed


def release(session: Session, claimed: Claim, reason: str) -> bool:
    """Put a job back that this worker cannot take on now; no attempt is used up."""
    return _close(session, claimed, State.QUEUED, reason, attempts=claimed.attempts - 1)


def _close(
    session: Session,
    claimed: Claim,
    state: State,
    error: str | None,
    attempts: int | None = None,
) -> bool:
    result = session.execute(
        update(AssessmentJob)
        .where(
            AssessmentJob.id == claimed.assessment_id,
            AssessmentJob.token == claimed.token,
            AssessmentJob.state == State.RUNNING,
        )
        .values(
            state=state,
            attempts=claimed.attempts if attempts is None else attempts,
            version=AssessmentJob.version + 1,
            token=None,
            lease_until=None,
            finished_at=None if state is State.QUEUED else DatabaseTime(),
            last_error=error and error[:_LONGEST_ERROR],
        )
        .returning(AssessmentJob.id)
        .execution_options(synchronize_session=False)
    )
    return result.one_or_none() is not None


def _audited(session: Session, claimed: Claim, state: State, error: str) -> bool:
    audit.record(
        session,
        operator_id=claimed.operator_id,
        actor="worker",
        action=state,
        subject="landing",
        subject_id=claimed.landing_id,
        assessment=claimed.assessment_id,
        attempts=claimed.attempts,
        error=error[:500],
    )
    return True


def retry(session: Session, assessment_id: str) -> None:
    """Queue a failed or dead assessment again, with all its attempts."""
    session.execute(
        update(AssessmentJob)
        .where(AssessmentJob.id == assessment_id)
        .values(
            state=State.QUEUED,
            attempts=0,
            version=AssessmentJob.version + 1,
            finished_at=None,
        )
        .execution_options(synchronize_session=False)
    )


def _is_spent(max_attempts: int) -> Any:
    return and_(
        PENDING_CLAUSE,
        AssessmentJob.state == State.RUNNING,
        AssessmentJob.lease_until < DatabaseTime(),
        AssessmentJob.attempts >= max_attempts,
    )


def is_anything_spent(session: Session, max_attempts: int) -> bool:
    """Whether `bury` would find something; asked first, as it needs no write lock."""
    statement = select(AssessmentJob.id).where(_is_spent(max_attempts)).limit(1)
    return session.scalar(statement) is not None


def bury(session: Session, max_attempts: int) -> list[str]:
    """Declare dead what has used up its attempts and whose lease is over."""
    rows = session.execute(
        update(AssessmentJob)
        .where(_is_spent(max_attempts))
        .values(
            state=State.DEAD,
            version=AssessmentJob.version + 1,
            token=None,
            lease_until=None,
            finished_at=DatabaseTime(),
            last_error=func.coalesce(
                AssessmentJob.last_error,
                f"the worker was lost in each of {max_attempts} attempts",
            ),
        )
        .returning(
            AssessmentJob.id,
            AssessmentJob.operator_id,
            AssessmentJob.landing_id,
            AssessmentJob.last_error,
        )
        .execution_options(synchronize_session=False)
    ).all()
    for row in rows:
        audit.record(
            session,
            operator_id=row.operator_id,
            actor="sweeper",
            action=State.DEAD,
            subject="landing",
            subject_id=row.landing_id,
            assessment=row.id,
            error=row.last_error,
        )
    return [row.id for row in rows]


def due(session: Session, *, max_attempts: int, limit: int) -> int:
    """How many assessments could be claimed now, counted up to a limit."""
    waiting = select(AssessmentJob.id).where(_is_due(max_attempts)).limit(limit).subquery()
    return session.scalar(select(func.count()).select_from(waiting)) or 0


def inputs_of(session: Session, claimed: Claim) -> dict[str, Any]:
    """The solver's input of the claimed landing."""
    inputs: dict[str, Any] = session.execute(
        select(Landing.inputs).where(Landing.id == claimed.landing_id)
    ).scalar_one()
    return inputs
