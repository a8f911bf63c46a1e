"""Every table, gathered for the migrations."""

from app.artefacts.models import Artefact
from app.assessments.models import AssessmentJob, HotSpotRow, VerdictRow
from app.audit.models import AuditEntry
from app.db import Base
from app.fleet.models import AirframeModel, ApiKey, Operator
from app.landings.models import IdempotencyKey, Landing

__all__ = [
    "AirframeModel",
    "ApiKey",
    "Artefact",
    "AssessmentJob",
    "AuditEntry",
    "Base",
    "HotSpotRow",
    "IdempotencyKey",
    "Landing",
    "Operator",
    "VerdictRow",
]
