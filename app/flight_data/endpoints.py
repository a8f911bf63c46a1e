"""Recorder windows over HTTP."""

from typing import Annotated

from fastapi import APIRouter, BackgroundTasks, Body, Query, Response, status

from app.context import Context
from app.errors import responses
from app.flight_data import service
from app.flight_data.answers import WindowAccepted
from app.flight_data.schemas import WindowQuery
from app.landings.endpoints import IdempotencyHeader
from app.security import Poster

router = APIRouter(prefix="/v1/flight-data", tags=["flight data"])


@router.post(
    "",
    operation_id="post_flight_data",
    status_code=status.HTTP_202_ACCEPTED,
    responses=responses(401, 403, 409, 413, 422),
)
def post_flight_data(
    content: Annotated[
        bytes,
        Body(
            media_type="text/csv",
            description="Window at native rates: CSV in long or wide form, or Parquet.",
        ),
    ],
    wanted: Annotated[WindowQuery, Query()],
    principal: Poster,
    context: Context,
    response: Response,
    after: BackgroundTasks,
    idempotency_key: IdempotencyHeader = None,
) -> WindowAccepted:
    """Hand in a recorder window; its contacts are found and assessed as a posted record's."""
    accepted = service.accept(
        context.engine,
        context.settings,
        context.registry,
        context.envelopes,
        principal,
        content,
        wanted,
        idempotency_key=idempotency_key,
    )
    response.headers["Location"] = accepted.links["assessment"]
    response.headers["Retry-After"] = "1"
    context.metrics.count_accepted(accepted)
    after.add_task(context.nudger.nudge)
    return accepted
