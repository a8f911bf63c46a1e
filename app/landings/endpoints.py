"""Landings over HTTP."""

from typing import Annotated, Literal
from uuid import UUID

from fastapi import APIRouter, BackgroundTasks, Header, Query, Response, status

from app.context import Context
from app.errors import responses
from app.landings import service
from app.landings.answers import LandingAccepted, LandingDetail, LandingFilter, LandingSummary
from app.landings.schemas import TouchdownRecordIn
from app.paging import Page
from app.security import Poster, Reader

router = APIRouter(prefix="/v1/landings", tags=["landings"])

IdempotencyHeader = Annotated[
    str | None,
    Header(
        alias="Idempotency-Key",
        min_length=1,
        max_length=255,
        pattern=r"^[\x21-\x7e]+$",
        description="Any text of the sender's; the same key and body is the same landing.",
    ),
]


@router.post(
    "",
    operation_id="post_landing",
    status_code=status.HTTP_202_ACCEPTED,
    responses=responses(401, 403, 409, 413, 422),
)
def post_landing(
    record: TouchdownRecordIn,
    principal: Poster,
    context: Context,
    response: Response,
    after: BackgroundTasks,
    lane: Annotated[
        Literal["interactive", "bulk"],
        Query(description="Somebody waits for it, or it is part of a back-fill."),
    ] = "interactive",
    idempotency_key: IdempotencyHeader = None,
) -> LandingAccepted:
    """Hand in a touchdown record; the answer says where its assessment will be."""
    accepted = service.accept(
        context.engine,
        context.settings,
        context.registry,
        principal,
        record,
        lane=lane,
        idempotency_key=idempotency_key,
    )
    response.headers["Location"] = accepted.links["assessment"]
    response.headers["Retry-After"] = "1"
    context.metrics.landings_received.labels("repeated" if accepted.is_repeated else "new").inc()
    after.add_task(context.nudger.nudge)
    return accepted


@router.get("", operation_id="list_landings", responses=responses(401, 403, 422))
def list_landings(
    principal: Reader,
    context: Context,
    wanted: Annotated[LandingFilter, Query()],
) -> Page[LandingSummary]:
    """Landings of the operator, latest first."""
    return service.page(context.engine, principal, wanted)


@router.get("/{landing_id}", operation_id="get_landing", responses=responses(401, 403, 404, 422))
def get_landing(landing_id: UUID, principal: Reader, context: Context) -> LandingDetail:
    """A landing with its record."""
    return service.get(context.engine, principal, str(landing_id))
