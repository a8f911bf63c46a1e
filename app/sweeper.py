"""The safety net: whatever nudge was lost, the sweeper sends another one."""

import random
import threading

import structlog
from sqlalchemy import Engine
from sqlalchemy.exc import SQLAlchemyError

from app.assessments import queue
from app.broker import Nudger
from app.config import Settings
from app.db import reading, writing
from app.observe import Metrics

log = structlog.get_logger(__name__)


class Sweeper:
    """A thread of the API process; any number of replicas may sweep at once."""

    def __init__(
        self, settings: Settings, engine: Engine, nudger: Nudger, metrics: Metrics
    ) -> None:
        self._settings = settings
        self._engine = engine
        self._nudger = nudger
        self._metrics = metrics
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name="sweeper", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        self._stopping.set()
        self._thread.join(timeout=10.0)

    def sweep(self) -> int:
        """Bury what is beyond help, nudge for what is due; returns how much was due."""
        settings = self._settings
        with reading(self._engine) as session:
            is_anything_lost = queue.is_anything_spent(session, settings.max_attempts)
            due = queue.due(
                session, max_attempts=settings.max_attempts, limit=settings.nudge_window
            )
        if is_anything_lost:
            with writing(self._engine) as session:
                buried = queue.bury(session, settings.max_attempts)
            for assessment_id in buried:
                log.error("assessment.dead", assessment=assessment_id)
        if due:
            is_sent = self._nudger.nudge(due)
            self._metrics.nudges.labels("sent" if is_sent else "failed").inc(due)
        return due

    def _run(self) -> None:
        # Jitter keeps replicas from sweeping in step.
        while not self._stopping.wait(self._settings.sweep_interval * random.uniform(0.7, 1.3)):  # noqa: S311
            try:
                self.sweep()
            except SQLAlchemyError as error:
                log.warning("sweep.failed", error=str(error))
