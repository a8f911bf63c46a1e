"""Assessments over HTTP."""

from typing import Annotated, Any, Literal
from uuid import UUID

from fastapi import APIRouter, BackgroundTasks, Header, Query, Response, status

from app.assessments import service
from app.assessments.answers import AssessmentOut, Histories, HotSpots, PeakFieldOut
from app.assessments.states import PENDING
from app.context import Context
from app.errors import responses
from app.security import Reader, Reviewer

router = APIRouter(prefix="/v1/assessments", tags=["assessments"])

BINARY = "application/octet-stream"

Format = Annotated[
    Literal["json", "binary"],
    Query(
        description="`binary` is a container of little-endian arrays: `HLA1`, the header's length "
        "(uint32), a JSON header (name, dtype, shape, unit and offset of each array), the arrays."
    ),
]

_ARRAYS: dict[int | str, dict[str, Any]] = {
    200: {"content": {BINARY: {"schema": {"type": "string", "format": "binary"}}}}
}


@router.get(
    "/{assessment_id}",
    operation_id="get_assessment",
    responses={304: {"description": "Not changed"}, **responses(401, 403, 404, 422)},
    response_model=AssessmentOut,
)
def get_assessment(
    assessment_id: UUID,
    principal: Reader,
    context: Context,
    response: Response,
    if_none_match: Annotated[str | None, Header()] = None,
) -> AssessmentOut | Response:
    """Where an assessment stands; with an entity tag, so that polling is cheap."""
    identifier = str(assessment_id)
    if if_none_match is not None:
        tag = service.current_etag(context.engine, principal, identifier)
        if tag in [known.strip().removeprefix("W/") for known in if_none_match.split(",")]:
            return Response(status_code=status.HTTP_304_NOT_MODIFIED, headers=_headers(tag))
    answer, tag = service.get(context.engine, principal, identifier)
    response.headers.update(_headers(tag))
    if answer.state in PENDING:
        response.headers["Retry-After"] = "1"
    return answer


def _headers(tag: str) -> dict[str, str]:
    return {"ETag": tag, "Cache-Control": "private, no-cache"}


@router.post(
    "/{assessment_id}/retry",
    operation_id="retry_assessment",
    status_code=status.HTTP_202_ACCEPTED,
    responses=responses(401, 403, 404, 409, 422),
)
def retry_assessment(
    assessment_id: UUID, principal: Reviewer, context: Context, after: BackgroundTasks
) -> AssessmentOut:
    """Try a failed or dead assessment again."""
    answer = service.retry(context.engine, principal, str(assessment_id))
    after.add_task(context.nudger.nudge)
    return answer


@router.get(
    "/{assessment_id}/hot-spots",
    operation_id="get_hot_spots",
    responses=responses(401, 403, 404, 409, 422),
)
def get_hot_spots(assessment_id: UUID, principal: Reader, context: Context) -> HotSpots:
    """Where to look, worst first."""
    return service.hot_spots(context.engine, principal, str(assessment_id))


@router.get(
    "/{assessment_id}/histories",
    operation_id="get_histories",
    responses={**_ARRAYS, **responses(401, 403, 404, 409, 422)},
    response_model=Histories,
)
def get_histories(
    assessment_id: UUID,
    principal: Reader,
    context: Context,
    contact: Annotated[int, Query(ge=0, le=11)] = 0,
    format: Format = "json",
) -> Histories | Response:
    """Curves of one contact: gear forces, strokes, accelerations, energies."""
    if format == "binary":
        data = service.history_bytes(context.engine, principal, str(assessment_id), contact)
        return Response(data, media_type=BINARY)
    return service.histories(context.engine, principal, str(assessment_id), contact)


@router.get(
    "/{assessment_id}/peak-field",
    operation_id="get_peak_field",
    responses={**_ARRAYS, **responses(401, 403, 404, 409, 422)},
    response_model=PeakFieldOut,
)
def get_peak_field(
    assessment_id: UUID, principal: Reader, context: Context, format: Format = "json"
) -> PeakFieldOut | Response:
    """Every element's peak, in the order of the model's mesh."""
    if format == "binary":
        data = service.peak_field_bytes(context.engine, principal, str(assessment_id))
        return Response(data, media_type=BINARY)
    return service.peak_field(context.engine, principal, str(assessment_id))
