"""Writing the audit log, always in the transaction of the step it records."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from sqlalchemy.orm import Session

from app.audit.models import AuditEntry
from app.rows import insert_rows


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """One step: who did what to which subject."""

    operator_id: str
    actor: str
    action: str
    subject: str
    subject_id: str
    model_hash: str | None = None
    program_version: str | None = None
    detail: dict[str, Any] = field(default_factory=dict)


def record(
    session: Session,
    *,
    operator_id: str,
    actor: str,
    action: str,
    subject: str,
    subject_id: str,
    **detail: Any,
) -> None:
    """Add one entry."""
    record_all(
        session,
        [
            Entry(
                operator_id=operator_id,
                actor=actor,
                action=action,
                subject=subject,
                subject_id=subject_id,
                detail=detail,
            )
        ],
    )


def record_all(session: Session, entries: Sequence[Entry]) -> None:
    """Add entries, in one round trip."""
    insert_rows(session, AuditEntry, [asdict(entry) for entry in entries])
