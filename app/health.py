"""Whether the process lives, whether it can serve, and its figures."""

from typing import Any

from fastapi import APIRouter, Response, status
from fastapi.responses import PlainTextResponse
from prometheus_client.exposition import CONTENT_TYPE_LATEST, generate_latest
from pydantic import BaseModel
from sqlalchemy import text
from sqlalchemy.exc import SQLAlchemyError

from app import migrate
from app.context import Context

router = APIRouter(tags=["health"])


class Health(BaseModel):
    """The process answers."""

    status: str = "alive"


class Readiness(BaseModel):
    """Whether requests should be sent here."""

    is_ready: bool
    database: str
    schema_revision: str | None
    broker: str
    aircraft: list[str]


@router.get("/healthz", operation_id="get_health")
def healthz() -> Health:
    """The process is alive."""
    return Health()


@router.get(
    "/readyz",
    operation_id="get_readiness",
    responses={503: {"model": Readiness, "description": "Not ready"}},
)
def readyz(context: Context, response: Response) -> Readiness:
    """Ready when the database answers and has the newest schema.

    The broker is reported and does not count: without it landings are accepted all the same, and
    taking the service out of rotation would lose them.
    """
    revision = None
    try:
        with context.engine.connect() as connection:
            connection.execute(text("SELECT 1"))
        revision = migrate.current(context.engine)
        is_current = revision == migrate.head()
        database = "ok" if is_current else "the schema is not the newest; run hardlanding migrate"
    except SQLAlchemyError:
        is_current, database = False, "unreachable"
    if not is_current:
        response.status_code = status.HTTP_503_SERVICE_UNAVAILABLE
    return Readiness(
        is_ready=is_current,
        database=database,
        schema_revision=revision,
        broker="ok" if context.nudger.is_reachable() else "unreachable; nudges wait for it",
        aircraft=[aircraft.definition.name for aircraft in context.registry.all()],
    )


@router.get("/metrics", operation_id="get_metrics", response_class=PlainTextResponse)
def metrics(context: Context) -> Response:
    """Figures in the Prometheus text format."""
    figures: Any = generate_latest(context.metrics.registry)
    return Response(figures, media_type=CONTENT_TYPE_LATEST)
