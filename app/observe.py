"""Logs, request identities and metrics."""

import logging
import sys
import time
from collections.abc import Iterable

import structlog
from asgi_correlation_id import correlation_id
from prometheus_client import CollectorRegistry, Counter, Histogram
from prometheus_client.core import GaugeMetricFamily, Metric
from prometheus_client.registry import Collector
from sqlalchemy import Engine, func, select
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from structlog.typing import EventDict, WrappedLogger

from app.assessments.models import PENDING_CLAUSE, AssessmentJob, VerdictRow
from app.assessments.states import PENDING
from app.config import LANES
from app.db import DatabaseTime, reading
from app.landings.answers import LandingAccepted

log = structlog.get_logger("app.requests")

_METHODS = ("GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS")


def configure_logging(style: str) -> None:
    """One line per event on standard error: JSON for machines, or coloured for people."""
    shared: list[structlog.typing.Processor] = [
        structlog.contextvars.merge_contextvars,
        structlog.stdlib.add_log_level,
        structlog.stdlib.add_logger_name,
        structlog.processors.TimeStamper(fmt="iso", utc=True),
        _add_request_id,
        structlog.processors.format_exc_info,
    ]
    renderer: structlog.typing.Processor = (
        structlog.processors.JSONRenderer()
        if style == "json"
        else structlog.dev.ConsoleRenderer(colors=sys.stderr.isatty())
    )
    structlog.configure(
        processors=[*shared, structlog.stdlib.ProcessorFormatter.wrap_for_formatter],
        logger_factory=structlog.stdlib.LoggerFactory(),
        cache_logger_on_first_use=True,
    )
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(
        structlog.stdlib.ProcessorFormatter(foreign_pre_chain=shared, processor=renderer)
    )
    root = logging.getLogger()
    root.handlers = [handler]
    root.setLevel(logging.INFO)
    for name in ("uvicorn", "uvicorn.error", "uvicorn.access", "celery"):
        logger = logging.getLogger(name)
        logger.handlers, logger.propagate = [], True
    # Requests are logged below, with their identity and duration.
    logging.getLogger("uvicorn.access").setLevel(logging.WARNING)
    logging.getLogger("alembic").setLevel(logging.WARNING)


def _add_request_id(_logger: WrappedLogger, _method: str, event: EventDict) -> EventDict:
    if (request := correlation_id.get()) is not None:
        event["request_id"] = request
    return event


class Metrics:
    """What this process counts, and what the table says when somebody asks."""

    def __init__(self, engine: Engine) -> None:
        self.registry = CollectorRegistry()
        self.landings_received = Counter(
            "hardlanding_landings_received_total",
            "Touchdown records accepted, by whether they were new.",
            ["outcome"],
            registry=self.registry,
        )
        self.provisional_verdicts = Counter(
            "hardlanding_provisional_verdicts_total",
            "Provisional verdicts given to new landings; none where the envelope cannot tell.",
            ["verdict"],
            registry=self.registry,
        )
        self.requests = Histogram(
            "hardlanding_http_request_seconds",
            "Duration of HTTP requests.",
            ["method", "route", "status"],
            registry=self.registry,
        )
        self.nudges = Counter(
            "hardlanding_nudges_total",
            "Nudges sent by the sweeper, by whether the broker took them.",
            ["outcome"],
            registry=self.registry,
        )
        self.registry.register(_QueueCollector(engine))

    def count_accepted(self, accepted: LandingAccepted) -> None:
        """Count a landing that was handed in by itself."""
        self.landings_received.labels("repeated" if accepted.is_repeated else "new").inc()
        if accepted.provisional is not None and not accepted.is_repeated:
            self.provisional_verdicts.labels(accepted.provisional.verdict or "none").inc()


class _QueueCollector(Collector):
    """Queue and verdicts straight from the table: true for all processes together."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine

    def describe(self) -> Iterable[Metric]:
        return []  # or registration would already ask the database

    def collect(self) -> Iterable[Metric]:
        depth = GaugeMetricFamily(
            "hardlanding_queue_depth", "Assessments waiting or running.", labels=["lane", "state"]
        )
        oldest = GaugeMetricFamily(
            "hardlanding_queue_oldest_seconds",
            "Age of the oldest assessment not yet finished.",
            labels=["lane"],
        )
        states = GaugeMetricFamily(
            "hardlanding_assessments", "Assessments by final state.", labels=["state"]
        )
        verdicts = GaugeMetricFamily(
            "hardlanding_verdicts", "Assessments by verdict.", labels=["verdict"]
        )
        provisional = GaugeMetricFamily(
            "hardlanding_provisional_differences",
            "Assessments with a provisional verdict, by whether the full one differs.",
            labels=["differs"],
        )
        with reading(self._engine) as session:
            pending = session.execute(
                select(
                    AssessmentJob.lane,
                    AssessmentJob.state,
                    func.count(),
                    func.min(AssessmentJob.created_at, type_=AssessmentJob.created_at.type),
                )
                .where(PENDING_CLAUSE)
                .group_by(AssessmentJob.lane, AssessmentJob.state)
            ).all()
            now = session.execute(select(DatabaseTime())).scalar_one()
            ended = session.execute(
                select(AssessmentJob.state, func.count())
                .where(AssessmentJob.state.not_in(PENDING))
                .group_by(AssessmentJob.state)
            ).all()
            found = session.execute(
                select(VerdictRow.verdict, func.count()).group_by(VerdictRow.verdict)
            ).all()
            compared = session.execute(
                select(VerdictRow.provisional_differs, func.count())
                .where(VerdictRow.provisional_differs.is_not(None))
                .group_by(VerdictRow.provisional_differs)
            ).all()
        for name, rank in LANES.items():
            rows = [row for row in pending if row[0] == rank]
            for row in rows:
                depth.add_metric([name, row[1]], row[2])
            ages = [(now - row[3]).total_seconds() for row in rows]
            oldest.add_metric([name], max(ages, default=0.0))
        for state, count in ended:
            states.add_metric([state], count)
        for verdict, count in found:
            verdicts.add_metric([verdict], count)
        for differs, count in compared:
            provisional.add_metric(["true" if differs else "false"], count)
        return [depth, oldest, states, verdicts, provisional]


class RequestObserver:
    """Time and log every request under its route, never under its raw path."""

    def __init__(self, app: ASGIApp, metrics: Metrics) -> None:
        self.app = app
        self.metrics = metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        start = time.perf_counter()
        status = 500

        async def observed(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
            await send(message)

        try:
            await self.app(scope, receive, observed)
        finally:
            seconds = time.perf_counter() - start
            route = getattr(scope.get("route"), "path", "(none)")
            # A method of the sender's own making must not make a label of its own.
            method = scope["method"] if scope["method"] in _METHODS else "other"
            self.metrics.requests.labels(method, route, str(status)).observe(seconds)
            log.info(
                "request", method=scope["method"], route=route, status=status,
                seconds=round(seconds, 4),
            )  # fmt: skip
