"""Landings over HTTP."""

from typing import Annotated, Any, Literal
from uuid import UUID

from fastapi import APIRouter, BackgroundTasks, Header, Query, Request, Response, status

from app.context import Context
from app.errors import responses, unsupported_type
from app.landings import service
from app.landings.answers import (
    BulkEnd,
    BulkOutcome,
    LandingAccepted,
    LandingDetail,
    LandingFilter,
    LandingSummary,
)
from app.landings.bulk import BulkIntake
from app.landings.schemas import TouchdownRecordIn
from app.ndjson import LINE_TYPES, MULTIPART, NDJSON, Conversation, content_type
from app.paging import Page
from app.security import Poster, Reader

router = APIRouter(prefix="/v1/landings", tags=["landings"])

BULK_PATH = f"{router.prefix}/bulk"

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
        context.envelopes,
        principal,
        record,
        lane=lane,
        idempotency_key=idempotency_key,
    )
    response.headers["Location"] = accepted.links["assessment"]
    response.headers["Retry-After"] = "1"
    context.metrics.count_accepted(accepted)
    after.add_task(context.nudger.nudge)
    return accepted


_OUTCOMES: dict[int | str, dict[str, Any]] = {
    200: {
        "content": {
            NDJSON: {
                "schema": {
                    "oneOf": [
                        {"$ref": f"#/components/schemas/{model.__name__}"}
                        for model in (BulkOutcome, BulkEnd)
                    ]
                }
            }
        }
    }
}
_LINES = {"type": "string", "description": "A touchdown record in each line."}


@router.post(
    "/bulk",
    operation_id="post_landings_in_bulk",
    status_code=status.HTTP_200_OK,
    response_model=BulkOutcome | BulkEnd,
    response_class=Conversation,
    response_description="One JSON line for each record, in their order, and one at the end.",
    responses={**_OUTCOMES, **responses(401, 403, 413, 415)},
    openapi_extra={
        "requestBody": {
            "required": True,
            "content": {
                NDJSON: {"schema": _LINES},
                MULTIPART: {
                    "schema": {
                        "type": "object",
                        "properties": {"file": {**_LINES, "format": "binary"}},
                    }
                },
            },
        }
    },
)
async def post_landings_in_bulk(
    request: Request, principal: Poster, context: Context
) -> Conversation:
    """Hand in a back-fill: records as JSON lines, as a stream or as an uploaded file.

    Each line is a record as `POST /v1/landings` takes it and has its own outcome; a bad one does
    not touch the others. Sending a file again is safe: what was stored is found. The landings wait
    in the bulk lane, behind those that somebody waits for.
    """
    kind, boundary = content_type(request.headers.get("content-type"))
    if kind not in LINE_TYPES and not (kind == MULTIPART and boundary):
        raise unsupported_type(kind, (*LINE_TYPES, f"{MULTIPART}; boundary=..."))
    intake = BulkIntake(context, principal, boundary if kind == MULTIPART else None)
    return Conversation(intake.outcomes)


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
