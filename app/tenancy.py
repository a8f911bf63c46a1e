"""Every select starts here, so that nobody sees another operator's rows."""

from typing import Any

from sqlalchemy import Select, select

from app.assessments.models import AssessmentJob, VerdictRow
from app.landings.models import Landing
from app.security import Principal

Owned = type[Landing] | type[AssessmentJob] | type[VerdictRow]


def scoped(principal: Principal, table: Owned, *joined: Any) -> Select[Any]:
    """Select an owned table, and what is joined to it, for the principal's operator only."""
    return select(table, *joined).where(table.operator_id == principal.operator_id)
