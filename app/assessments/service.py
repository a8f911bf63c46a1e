"""Answers about assessments, and trying one again by hand."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from sqlalchemy import Engine
from sqlalchemy.orm import Session

from app.artefacts.container import Container, unpack
from app.artefacts.store import DatabaseStore
from app.assessments import queue, repository
from app.assessments.answers import (
    AssessmentOut,
    Channel,
    Histories,
    HotSpotOut,
    HotSpots,
    PeakFieldOut,
    ProvisionalOut,
    VerdictOut,
)
from app.assessments.arrays import PEAK_FIELD, history_kind
from app.assessments.models import AssessmentJob, VerdictRow
from app.assessments.provisional import difference
from app.assessments.states import PENDING, RETRIABLE, State
from app.audit import service as audit
from app.config import LANE_NAMES
from app.db import reading, writing
from app.errors import not_found, problem
from app.security import Principal
from solver.assessment import Verdict


def etag(assessment_id: str, version: int) -> str:
    """Strong: every change of the row raises its version."""
    return f'"{assessment_id}-{version}"'


def current_etag(engine: Engine, principal: Principal, assessment_id: str) -> str:
    with reading(engine) as session:
        version = repository.version(session, principal, assessment_id)
    if version is None:
        raise not_found("assessment", assessment_id)
    return etag(assessment_id, version)


def get(engine: Engine, principal: Principal, assessment_id: str) -> tuple[AssessmentOut, str]:
    """The assessment and its entity tag, of one and the same moment."""
    with reading(engine) as session:
        job, verdict = _found(session, principal, assessment_id)
    return _answer(job, verdict), etag(job.id, job.version)


def hot_spots(engine: Engine, principal: Principal, assessment_id: str) -> HotSpots:
    with reading(engine) as session:
        _, verdict = _assessed(session, principal, assessment_id)
        rows = repository.hot_spots(session, assessment_id)
    items = [
        HotSpotOut.model_validate(
            {"position": (row.x, row.y, row.z), **row.__dict__}, from_attributes=False
        )
        for row in rows
    ]
    return HotSpots(assessment_id=assessment_id, verdict=Verdict(verdict.verdict), items=items)


def histories(engine: Engine, principal: Principal, assessment_id: str, contact: int) -> Histories:
    with reading(engine) as session:
        _assessed(session, principal, assessment_id)
        contacts = repository.count_of_histories(session, assessment_id)
        curves = unpack(_kept(session, assessment_id, history_kind(contact), contacts))
    return Histories(
        assessment_id=assessment_id,
        contact=contact,
        contacts=contacts,
        outcome=curves.meta["outcome"],
        ground_contacts=curves.meta["ground_contacts"],
        time=curves["time"].tolist(),
        channels=[
            Channel(name=array.name, unit=array.unit, values=_finite(array.values))
            for array in curves.arrays
            if array.name != "time"
        ],
    )


def history_bytes(engine: Engine, principal: Principal, assessment_id: str, contact: int) -> bytes:
    with reading(engine) as session:
        _assessed(session, principal, assessment_id)
        contacts = repository.count_of_histories(session, assessment_id)
        return _kept(session, assessment_id, history_kind(contact), contacts)


def peak_field_bytes(engine: Engine, principal: Principal, assessment_id: str) -> bytes:
    with reading(engine) as session:
        _assessed(session, principal, assessment_id)
        return _kept(session, assessment_id, PEAK_FIELD, 0)


def peak_field(engine: Engine, principal: Principal, assessment_id: str) -> PeakFieldOut:
    with reading(engine) as session:
        _, verdict = _assessed(session, principal, assessment_id)
        field: Container = unpack(_kept(session, assessment_id, PEAK_FIELD, 0))
    return PeakFieldOut(
        assessment_id=assessment_id,
        model_hash=verdict.model_hash,
        element=field["element"].tolist(),
        stress=_finite(field["stress"]),
        utilisation=_finite(field["utilisation"]),
        time=_finite(field["time"]),
        contact=field["contact"].tolist(),
    )


def retry(engine: Engine, principal: Principal, assessment_id: str) -> AssessmentOut:
    """Queue an assessment again that failed or died."""
    with writing(engine) as session:
        job, _ = _found(session, principal, assessment_id)
        if job.state not in RETRIABLE:
            raise problem(
                409,
                "not-retriable",
                "Only a failed or dead assessment can be tried again",
                f"this one is {job.state}; retriable: {', '.join(RETRIABLE)}",
            )
        queue.retry(session, assessment_id)
        audit.record(
            session,
            operator_id=principal.operator_id,
            actor=principal.actor,
            action="retried",
            subject="landing",
            subject_id=job.landing_id,
            assessment=job.id,
            after=job.state,
        )
        session.flush()
        session.refresh(job)
        return _answer(job, None)


def _found(
    session: Session, principal: Principal, assessment_id: str
) -> tuple[AssessmentJob, VerdictRow | None]:
    found = repository.get(session, principal, assessment_id)
    if found is None:
        raise not_found("assessment", assessment_id)
    return found[0], found[1]


def _assessed(
    session: Session, principal: Principal, assessment_id: str
) -> tuple[AssessmentJob, VerdictRow]:
    job, verdict = _found(session, principal, assessment_id)
    if verdict is None:
        headers = {"Retry-After": "1"} if job.state in PENDING else None
        raise problem(
            409,
            "not-assessed",
            "There is no verdict yet",
            f"the assessment is {job.state}"
            + (f": {job.last_error}" if job.state not in PENDING and job.last_error else ""),
            headers=headers,
        )
    return job, verdict


def _kept(session: Session, assessment_id: str, kind: str, contacts: int) -> bytes:
    data = DatabaseStore(session).get(assessment_id, kind)
    if data is None:
        detail = (
            f"histories are kept for contacts 0 to {contacts - 1}"
            if contacts
            else "arrays are kept for landings near or above a limit only; the stored inputs "
            "give them again"
        )
        raise problem(404, "not-kept", "These arrays were not kept", detail)
    return data


def _answer(job: AssessmentJob, verdict: VerdictRow | None) -> AssessmentOut:
    base = f"/v1/assessments/{job.id}"
    return AssessmentOut(
        id=job.id,
        landing_id=job.landing_id,
        state=State(job.state),
        lane=LANE_NAMES[job.lane],
        attempts=job.attempts,
        created_at=job.created_at,
        started_at=job.started_at,
        finished_at=job.finished_at,
        last_error=job.last_error,
        **_provisional(job, verdict),
        result=None if verdict is None else _result(verdict),
        links={
            "landing": f"/v1/landings/{job.landing_id}",
            "hot_spots": f"{base}/hot-spots",
            "histories": f"{base}/histories",
            "peak_field": f"{base}/peak-field",
        }
        | ({"model": f"/v1/models/{verdict.model_hash}"} if verdict else {}),
    )


def _provisional(job: AssessmentJob, verdict: VerdictRow | None) -> dict[str, Any]:
    stored = job.provisional
    answer: dict[str, Any] = {
        "provisional": None if stored is None else ProvisionalOut.model_validate(stored)
    }
    if verdict is not None:
        answer["provisional_differs"] = verdict.provisional_differs
        answer["provisional_difference"] = difference(
            stored, Verdict(verdict.verdict), verdict.worst_utilisation
        )
    return answer


def _result(verdict: VerdictRow) -> VerdictOut:
    return VerdictOut.model_validate(
        {**verdict.__dict__, "assessed_at": verdict.created_at}, from_attributes=False
    )


def _finite(values: NDArray[np.float32]) -> list[float | None]:
    if np.isfinite(values).all():
        numbers: list[float | None] = values.tolist()
        return numbers
    return [float(v) if np.isfinite(v) else None for v in values]
