"""Writing an answer: verdict, hot spots, arrays and audit in one transaction behind the fence."""

import math
from dataclasses import asdict
from typing import Any

import numpy as np
from sqlalchemy.orm import Session

from app.artefacts.store import DatabaseStore
from app.assessments import arrays, queue
from app.assessments.models import HotSpotRow, VerdictRow
from app.assessments.queue import Claim
from app.audit import service as audit
from solver.assessment import Assessment, HotSpot, RuleVerdict, Verdict

#: Whatever sends an inspector to the aircraft keeps its pictures.
_ALWAYS_KEPT = (Verdict.INSPECT, Verdict.HARD, Verdict.UNDETERMINED)


def record_assessment(
    session: Session,
    claimed: Claim,
    inputs: dict[str, Any],
    assessment: Assessment,
    *,
    keeps_arrays_from: float,
) -> bool:
    """Store the answer if the claim still holds; false leaves the database untouched."""
    if not queue.finish(session, claimed):
        return False
    session.add(_verdict(claimed, inputs, assessment))
    session.flush()
    session.add_all(_hot_spot(claimed.assessment_id, spot) for spot in assessment.hot_spots)
    if assessment.action in _ALWAYS_KEPT or not assessment.worst_utilisation < keeps_arrays_from:
        _keep_arrays(session, claimed.assessment_id, assessment)
    audit.record(
        session,
        operator_id=claimed.operator_id,
        actor="worker",
        action="assessed",
        subject="landing",
        subject_id=claimed.landing_id,
        model_hash=assessment.model_hash,
        program_version=assessment.program_version,
        assessment=claimed.assessment_id,
        verdict=str(assessment.verdict),
        action_asked=str(assessment.action),
        attempt=claimed.attempts,
    )
    return True


def _keep_arrays(session: Session, assessment_id: str, assessment: Assessment) -> None:
    store = DatabaseStore(session)
    if assessment.peak_field is not None:
        field = arrays.pack_peak_field(assessment.peak_field)
        store.put(assessment_id, arrays.PEAK_FIELD, field)
    for contact, history in enumerate(assessment.histories):
        store.put(assessment_id, arrays.history_kind(contact), arrays.pack_history(history))


def _verdict(claimed: Claim, inputs: dict[str, Any], assessment: Assessment) -> VerdictRow:
    return VerdictRow(
        assessment_id=claimed.assessment_id,
        operator_id=claimed.operator_id,
        landing_id=claimed.landing_id,
        verdict=assessment.verdict,
        action=assessment.action,
        rule_difference=assessment.rule_difference,
        makers_rule=_rule(assessment.makers_rule),
        probability_limit_exceeded=_number(assessment.probability_limit_exceeded),
        driving_contact=assessment.driving_contact,
        worst_utilisation=_number(assessment.worst_utilisation),
        worst_margin=_number(assessment.worst_margin),
        peak_normal_load_factor=_number(assessment.peak_normal_load_factor),
        energy_error=_number(assessment.energy_error),
        equilibrium_residual=_number(assessment.equilibrium_residual),
        reasons=[_plain(asdict(reason)) for reason in assessment.reasons],
        gear_loads=[_plain(asdict(load)) for load in assessment.gear_loads],
        notes=list(assessment.notes),
        timing=_plain(asdict(assessment.timing)),
        advisory=assessment.advisory,
        model_hash=assessment.model_hash,
        program_version=assessment.program_version,
        inputs=inputs,
    )


def _hot_spot(assessment_id: str, spot: HotSpot) -> HotSpotRow:
    x, y, z = spot.position
    return HotSpotRow(
        assessment_id=assessment_id,
        rank=spot.rank,
        component=spot.component,
        zone=spot.zone,
        side=spot.side,
        element=int(spot.element),
        element_kind=spot.element_kind,
        x=float(x),
        y=float(y),
        z=float(z),
        peak_stress=float(spot.peak_stress),
        allowable=float(spot.allowable),
        utilisation=float(spot.utilisation),
        margin=_number(spot.margin),
        time=float(spot.time),
        contact=int(spot.contact),
        ata_chapter=spot.ata_chapter,
        inspection=spot.inspection,
    )


def _rule(verdict: RuleVerdict | None) -> dict[str, Any] | None:
    if verdict is None:
        return None
    findings = [_plain(asdict(finding)) for finding in verdict.findings]
    return asdict(verdict) | {"findings": findings}


def _number(value: float | None) -> float | None:
    """Neither database keeps NaN or infinity in a way that JSON can carry out again."""
    return float(value) if value is not None and math.isfinite(value) else None


def _plain(fields: dict[str, Any]) -> dict[str, Any]:
    """Values of a dataclass as JSON types; what is not finite becomes null."""
    return {
        name: _number(float(value)) if isinstance(value, float | np.floating) else _exact(value)
        for name, value in fields.items()
    }


def _exact(value: object) -> object:
    # An integer out of an array is none of Python's own.
    return value.item() if isinstance(value, np.generic) else value
