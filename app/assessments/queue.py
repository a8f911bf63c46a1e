"""The job protocol: claim with a lease, finish behind a fence, sweep what was left lying.

Every step is one statement under the database's own clock, the same on SQLite and Postgres.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from operator import itemgetter
from typing import Any

from sqlalchemy import and_, func, or_, select, update
from sqlalchemy.orm import Session

from app.assessments.models import PENDING_CLAUSE, RUNNING_CLAUSE, AssessmentJob
from app.assessments.states import State
from app.audit import service as audit
from app.db import DatabaseTime, NewToken, UnhurriedCommit
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
    inputs: dict[str, Any]  #: of the solver
    provisional: dict[str, Any] | None = None  #: verdict given when the landing came in


def _is_due(max_attempts: int) -> Any:
    return and_(
        PENDING_CLAUSE,
        or_(
            AssessmentJob.state == State.QUEUED,
            and_(AssessmentJob.lease_until < DatabaseTime(), AssessmentJob.attempts < max_attempts),
        ),
    )


def claim(
    session: Session,
    *,
    worker: str,
    lanes: tuple[int, ...],
    lease: float,
    max_attempts: int,
    most: int = 1,
) -> list[Claim]:
    """Take the best due assessments: lowest lane first, then the oldest.

    Several come from one lane only, so that nobody who waits shares a batch with a back-fill.  One
    that was tried before comes alone: if it kills its worker, it must not use up the attempts of
    its neighbours.
    """
    order = (AssessmentJob.lane, AssessmentJob.created_at, AssessmentJob.id)
    # As a table of its own: inside a join Postgres might run the limited select more than once.
    best = (
        select(*order, AssessmentJob.attempts)
        .where(_is_due(max_attempts), AssessmentJob.lane.in_(lanes))
        .order_by(*order)
        .limit(most)
        .with_for_update(skip_locked=True)
        .cte("best")
        .prefix_with("MATERIALIZED")
    )
    place = (best.c.lane, best.c.created_at, best.c.id)
    ranked = select(
        best.c.id,
        best.c.lane,
        best.c.attempts,
        func.row_number().over(order_by=place).label("place"),
        func.first_value(best.c.lane).over(order_by=place).label("first_lane"),
        func.first_value(best.c.attempts).over(order_by=place).label("first_attempts"),
    ).subquery("ranked")
    batch = select(ranked.c.id).where(
        or_(
            ranked.c.place == 1,
            and_(
                ranked.c.lane == ranked.c.first_lane,
                ranked.c.attempts == 0,
                ranked.c.first_attempts == 0,
            ),
        )
    )
    record = select(Landing.inputs).where(Landing.id == AssessmentJob.landing_id)
    rows = session.execute(
        update(AssessmentJob)
        .where(AssessmentJob.id.in_(batch))
        .values(
            state=State.RUNNING,
            attempts=AssessmentJob.attempts + 1,
            version=AssessmentJob.version + 1,
            token=NewToken(),
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
            record.scalar_subquery(),
            AssessmentJob.provisional,
            AssessmentJob.created_at,
            # A claim that a power cut takes back is made again; who holds it then is fenced.
            UnhurriedCommit(),
        )
        .execution_options(synchronize_session=False)
    ).all()
    # What an update returns comes in no order.
    return [Claim(*row[:8]) for row in sorted(rows, key=itemgetter(8, 0))]


def finish(session: Session, claims: Sequence[Claim]) -> list[Claim]:
    """Close claims as assessed; returns those that still held.

    Where another worker has taken over nothing may be written.  Call it first in the transaction
    that writes the verdicts: the rows stay locked until then.
    """
    held = set(
        session.scalars(
            update(AssessmentJob)
            .where(_is_held(claims))
            .values(
                state=State.ASSESSED,
                version=AssessmentJob.version + 1,
                token=None,
                lease_until=None,
                finished_at=DatabaseTime(),
                last_error=None,
            )
            .returning(AssessmentJob.id)
            .execution_options(synchronize_session=False)
        )
    )
    return [claimed for claimed in claims if claimed.assessment_id in held]


def _is_held(claims: Sequence[Claim]) -> Any:
    """The fence: only rows that still carry the token of their claim.

    A token belongs to one claim of one row, so no pairing with the identifiers is needed.
    """
    return and_(
        AssessmentJob.id.in_([claimed.assessment_id for claimed in claims]),
        AssessmentJob.token.in_([claimed.token for claimed in claims]),
        AssessmentJob.state == State.RUNNING,
    )


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


def release(session: Session, claims: Sequence[Claim], reason: str | None = None) -> None:
    """Put jobs back that this worker cannot take on now; no attempt is used up."""
    session.execute(
        update(AssessmentJob)
        .where(_is_held(claims))
        .values(
            state=State.QUEUED,
            attempts=AssessmentJob.attempts - 1,
            version=AssessmentJob.version + 1,
            token=None,
            lease_until=None,
            last_error=func.coalesce(reason, AssessmentJob.last_error),
        )
        .execution_options(synchronize_session=False)
    )


def _close(session: Session, claimed: Claim, state: State, error: str) -> bool:
    result = session.execute(
        update(AssessmentJob)
        .where(_is_held([claimed]))
        .values(
            state=state,
            version=AssessmentJob.version + 1,
            token=None,
            lease_until=None,
            finished_at=None if state is State.QUEUED else DatabaseTime(),
            last_error=error[:_LONGEST_ERROR],
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
        RUNNING_CLAUSE,
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
