"""Writing the audit log, always in the transaction of the step it records."""

from typing import Any

from sqlalchemy.orm import Session

from app.audit.models import AuditEntry


def record(
    session: Session,
    *,
    operator_id: str,
    actor: str,
    action: str,
    subject: str,
    subject_id: str,
    model_hash: str | None = None,
    program_version: str | None = None,
    **detail: Any,
) -> None:
    """Add one entry."""
    session.add(
        AuditEntry(
            operator_id=operator_id,
            actor=actor,
            action=action,
            subject=subject,
            subject_id=subject_id,
            model_hash=model_hash,
            program_version=program_version,
            detail=detail,
        )
    )
