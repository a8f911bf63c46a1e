"""Writing an answer: verdict, hot spots, arrays and audit in one transaction behind the fence."""

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from sqlalchemy.orm import Session

from app.artefacts.container import compress
from app.artefacts.store import DatabaseStore, KeptArtefact
from app.assessments import arrays, queue
from app.assessments.models import HotSpotRow, VerdictRow
from app.assessments.provisional import differs
from app.assessments.queue import Claim
from app.audit import service as audit
from app.rows import insert_rows
from solver.assessment import Assessment, HotSpot, LimitProbability, RuleVerdict, Verdict

#: Whatever sends an inspector to the aircraft keeps its pictures.
_ALWAYS_KEPT = (Verdict.INSPECT, Verdict.HARD, Verdict.UNDETERMINED)


@dataclass(frozen=True, slots=True)
class Answer:
    """A claimed landing's answer as rows: all computing and packing is done, only writing left."""

    claim: Claim
    verdict: dict[str, Any]
    hot_spots: list[dict[str, Any]]
    artefacts: list[KeptArtefact]
    entry: audit.Entry


def answer(claimed: Claim, assessment: Assessment, *, keeps_arrays_from: float) -> Answer:
    """Make the rows of an assessment, before the transaction that would hold locks meanwhile."""
    is_kept = (
        assessment.action in _ALWAYS_KEPT or not assessment.worst_utilisation < keeps_arrays_from
    )
    return Answer(
        claimed,
        _verdict(claimed, assessment),
        [_hot_spot(claimed.assessment_id, spot) for spot in assessment.hot_spots],
        _artefacts(claimed.assessment_id, assessment) if is_kept else [],
        audit.Entry(
            operator_id=claimed.operator_id,
            actor="worker",
            action="assessed",
            subject="landing",
            subject_id=claimed.landing_id,
            model_hash=assessment.model_hash,
            program_version=assessment.program_version,
            detail={
                "assessment": claimed.assessment_id,
                "verdict": str(assessment.verdict),
                "action": str(assessment.action),
                "attempt": claimed.attempts,
                "provisional_differs": differs(claimed.provisional, assessment.verdict),
            },
        ),
    )


def record_answers(session: Session, answers: Sequence[Answer]) -> list[Claim]:
    """Store the answers whose claims still hold; returns those, the others leave no trace.

    The number of statements is the same for one answer and for many.
    """
    held = queue.finish(session, [answer.claim for answer in answers])
    tokens = {claimed.token for claimed in held}
    written = [answer for answer in answers if answer.claim.token in tokens]
    if written:
        insert_rows(session, VerdictRow, [answer.verdict for answer in written])
        insert_rows(session, HotSpotRow, [spot for answer in written for spot in answer.hot_spots])
        DatabaseStore(session).put([kept for answer in written for kept in answer.artefacts])
        audit.record_all(session, [answer.entry for answer in written])
    return held


def _artefacts(assessment_id: str, assessment: Assessment) -> list[KeptArtefact]:
    packed: dict[str, bytes] = {}
    if assessment.peak_field is not None:
        packed[arrays.PEAK_FIELD] = arrays.pack_peak_field(assessment.peak_field)
    for contact, history in enumerate(assessment.histories):
        packed[arrays.history_kind(contact)] = arrays.pack_history(history)
    return [KeptArtefact(assessment_id, kind, compress(data)) for kind, data in packed.items()]


def _verdict(claimed: Claim, assessment: Assessment) -> dict[str, Any]:
    return {
        "assessment_id": claimed.assessment_id,
        "operator_id": claimed.operator_id,
        "landing_id": claimed.landing_id,
        "verdict": assessment.verdict,
        "provisional_differs": differs(claimed.provisional, assessment.verdict),
        "action": assessment.action,
        "rule_difference": assessment.rule_difference,
        "makers_rule": _rule(assessment.makers_rule),
        "probability_limit_exceeded": _number(assessment.probability_limit_exceeded),
        "limit_probability": _likelihood(assessment.limit_probability),
        "driving_contact": assessment.driving_contact,
        "worst_utilisation": _number(assessment.worst_utilisation),
        "worst_margin": _number(assessment.worst_margin),
        "peak_normal_load_factor": _number(assessment.peak_normal_load_factor),
        "energy_error": _number(assessment.energy_error),
        "equilibrium_residual": _number(assessment.equilibrium_residual),
        "reasons": [_plain(asdict(reason)) for reason in assessment.reasons],
        "gear_loads": [_plain(asdict(load)) for load in assessment.gear_loads],
        "notes": list(assessment.notes),
        "timing": _plain(asdict(assessment.timing)),
        "advisory": assessment.advisory,
        "model_hash": assessment.model_hash,
        "program_version": assessment.program_version,
        "inputs": claimed.inputs,
    }


def _hot_spot(assessment_id: str, spot: HotSpot) -> dict[str, Any]:
    x, y, z = spot.position
    return {
        "assessment_id": assessment_id,
        "rank": spot.rank,
        "component": spot.component,
        "zone": spot.zone,
        "side": spot.side,
        "element": int(spot.element),
        "element_kind": spot.element_kind,
        "x": float(x),
        "y": float(y),
        "z": float(z),
        "peak_stress": float(spot.peak_stress),
        "allowable": float(spot.allowable),
        "utilisation": float(spot.utilisation),
        "margin": _number(spot.margin),
        "time": float(spot.time),
        "contact": int(spot.contact),
        "ata_chapter": spot.ata_chapter,
        "inspection": spot.inspection,
        "probability_limit_exceeded": spot.probability_limit_exceeded,
        "probability_standard_error": spot.probability_standard_error,
    }


def _rule(verdict: RuleVerdict | None) -> dict[str, Any] | None:
    if verdict is None:
        return None
    findings = [_plain(asdict(finding)) for finding in verdict.findings]
    return asdict(verdict) | {"findings": findings}


def _likelihood(likelihood: LimitProbability | None) -> dict[str, Any] | None:
    return None if likelihood is None else asdict(likelihood)


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
