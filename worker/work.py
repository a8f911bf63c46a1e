"""Claim, solve, finish: working through the queue of landings."""

import os
import signal
import socket
import time

import structlog
from billiard.exceptions import SoftTimeLimitExceeded
from sqlalchemy import Engine

from app import models as _all_tables  # noqa: F401 - tables refer to each other by name
from app.assessments import queue, recording
from app.assessments.queue import Claim
from app.broker import Nudger
from app.config import LANES, Settings
from app.db import reading, writing
from app.landings import inputs
from solver.assessment import Assessment
from solver.errors import RecordError, SimulationDivergedError, SolverError
from worker.solve import solve, undetermined
from worker.warm import Models, NewAircraftError

log = structlog.get_logger(__name__)


def work_off(engine: Engine, settings: Settings, known: Models, nudger: Nudger) -> int:
    """Claim and assess until nothing is due; pass the nudge on when the budget is used up."""
    deadline = time.monotonic() + settings.drain_budget
    count = 0
    while (claimed := _claim(engine, settings)) is not None:
        with structlog.contextvars.bound_contextvars(
            assessment=claimed.assessment_id, landing=claimed.landing_id
        ):
            try:
                assess(engine, settings, known, claimed)
            except NewAircraftError as error:
                log.warning("worker.restart", reason=str(error))
                # The parent has no time limit and shares what it loads with all of its children;
                # the supervisor starts it again.
                os.kill(os.getppid(), signal.SIGTERM)
                break
        count += 1
        if time.monotonic() >= deadline:
            nudger.nudge()
            break
    return count


def _claim(engine: Engine, settings: Settings) -> Claim | None:
    with writing(engine) as session:
        return queue.claim(
            session,
            worker=f"{socket.gethostname()}:{os.getpid()}",
            lanes=tuple(LANES[name] for name in settings.worker_lanes),
            lease=settings.lease_seconds,
            max_attempts=settings.max_attempts,
        )


def assess(engine: Engine, settings: Settings, known: Models, claimed: Claim) -> None:
    """Solve one claimed landing and write its answer."""
    try:
        with reading(engine) as session:
            stored = queue.inputs_of(session, claimed)
        answer = _solve(known, stored)
        _write(engine, settings, claimed, stored, answer)
    except NewAircraftError as error:
        with writing(engine) as session:
            queue.release(session, claimed, str(error))
        raise
    except SoftTimeLimitExceeded:
        _give_up(engine, settings, claimed, f"not done within {settings.soft_time_limit:g} s")
    except SolverError as error:
        # The model or the program is at fault: the same again would end the same way.
        with writing(engine) as session:
            queue.fail(session, claimed, f"{type(error).__name__}: {error}")
        log.error("assessment.failed", error=str(error))
    except Exception as error:
        log.exception("assessment.error")
        _give_up(engine, settings, claimed, f"{type(error).__name__}: {error}")


def _solve(known: Models, stored: dict[str, object]) -> Assessment:
    record = inputs.from_json(stored)
    model = known.get(record.aircraft)
    try:
        return solve(model, record)
    except (RecordError, SimulationDivergedError) as error:
        return undetermined(model, record, error)


def _write(
    engine: Engine,
    settings: Settings,
    claimed: Claim,
    stored: dict[str, object],
    answer: Assessment,
) -> None:
    with writing(engine) as session:
        is_written = recording.record_assessment(
            session, claimed, stored, answer, keeps_arrays_from=settings.keeps_arrays_from
        )
    if is_written:
        log.info("assessment.done", verdict=str(answer.verdict), seconds=answer.timing.total)
    else:
        log.warning("assessment.fenced", attempt=claimed.attempts)


def _give_up(engine: Engine, settings: Settings, claimed: Claim, error: str) -> None:
    with writing(engine) as session:
        queue.give_up(session, claimed, error, settings.max_attempts)
