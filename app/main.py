"""The web application."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

import structlog
from asgi_correlation_id import CorrelationIdMiddleware
from fastapi import FastAPI
from pydantic.json_schema import models_json_schema
from sqlalchemy.exc import SQLAlchemyError
from starlette.middleware import Middleware

import solver
from app import errors
from app.assessments.endpoints import router as assessments
from app.body_limit import BodyLimit
from app.broker import Nudger
from app.config import Settings, get_settings
from app.context import ServiceContext
from app.db import make_engine
from app.fleet.endpoints import router as fleet
from app.fleet.envelopes import Envelopes
from app.fleet.registry import AircraftRegistry
from app.fleet.service import remember_models
from app.flight_data.endpoints import router as flight_data
from app.health import router as health
from app.landings.endpoints import BULK_PATH
from app.landings.endpoints import router as landings
from app.observe import Metrics, RequestObserver, configure_logging
from app.sweeper import Sweeper
from solver.flight_data.rts import compile_smoother

log = structlog.get_logger(__name__)

DESCRIPTION = """
Hand in a touchdown record; the landing is simulated, the airframe's stress computed, and a verdict
given: NORMAL, FIRM, INSPECT, HARD or UNDETERMINED.

**Advisory only:** approved maintenance data for the aircraft type remain the authority for return
to service.

Every number in a record carries its unit.  Every error is a problem document (RFC 9457).
"""


def create_app(settings: Settings | None = None) -> FastAPI:
    """Application with its own engine, registry and sweeper."""
    settings = settings or get_settings()
    configure_logging(settings.log_format)
    if settings.database_url is None:
        settings.var.mkdir(parents=True, exist_ok=True)
    engine = make_engine(settings.sqlalchemy_url)
    metrics = Metrics(engine)
    nudger = Nudger(settings)
    registry = AircraftRegistry(settings.aircraft_folder)
    envelopes = Envelopes(registry, settings.cache_folder)

    @asynccontextmanager
    async def lifespan(_app: FastAPI) -> AsyncIterator[None]:
        compile_smoother()
        try:
            remember_models(engine, registry)
        except SQLAlchemyError as error:
            # Not migrated or not reachable: /readyz says so, and the process is there to say it.
            log.warning("models.not_remembered", error=str(error))
        sweeper = Sweeper(settings, engine, nudger, metrics)
        sweeper.start()
        yield
        sweeper.stop()
        nudger.close()
        engine.dispose()

    app = FastAPI(
        title="Hard-landing monitor",
        version=solver.__version__,
        description=DESCRIPTION,
        lifespan=lifespan,
        middleware=[
            Middleware(CorrelationIdMiddleware),
            Middleware(RequestObserver, metrics=metrics),
            Middleware(
                BodyLimit,
                limit=settings.max_body_bytes,
                discard=settings.discard_body_bytes,
                streams={BULK_PATH: settings.max_bulk_bytes},
            ),
        ],
    )
    app.state.context = ServiceContext(settings, engine, registry, envelopes, nudger, metrics)
    for router in (landings, flight_data, assessments, fleet, health):
        app.include_router(router)
    errors.install(app)
    _describe_problems(app)
    return app


def _describe_problems(app: FastAPI) -> None:
    """Put the problem document into the interface description, in place of the framework's own."""
    described = app.openapi

    def openapi() -> dict[str, Any]:
        document = described()
        schemas = document["components"]["schemas"]
        for name in ("HTTPValidationError", "ValidationError", "Problem"):
            schemas.pop(name, None)
        _, problem = models_json_schema(
            [(errors.ProblemDocument, "serialization")],
            ref_template="#/components/schemas/{model}",
        )
        schemas.update(problem["$defs"])
        return document

    app.openapi = openapi  # type: ignore[method-assign]
