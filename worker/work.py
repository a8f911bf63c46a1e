"""Claim, solve, finish: working through the queue of landings."""

import os
import signal
import socket
import time
from collections.abc import Sequence

import structlog
from billiard.exceptions import SoftTimeLimitExceeded
from sqlalchemy import Engine
from sqlalchemy.exc import SQLAlchemyError

from app import models as _all_tables  # noqa: F401 - tables refer to each other by name
from app.assessments import queue, recording
from app.assessments.queue import Claim
from app.assessments.recording import Answer
from app.broker import Nudger
from app.config import LANES, Settings
from app.db import writing, writing_once
from app.landings import inputs
from solver.assessment import Assessment
from solver.errors import RecordError, SimulationDivergedError, SolverError
from worker.pace import Pace
from worker.solve import solve, undetermined
from worker.warm import Models, NewAircraftError

log = structlog.get_logger(__name__)


def work_off(
    engine: Engine, settings: Settings, known: Models, nudger: Nudger, pace: Pace | None = None
) -> int:
    """Claim and assess until nothing is due; pass the nudge on when the budget is used up."""
    deadline = time.monotonic() + settings.drain_budget
    pace = pace or Pace()
    count = 0
    while batch := _claim(engine, settings, pace):
        try:
            count += work_through(engine, settings, known, pace, batch)
        except NewAircraftError as error:
            log.warning("worker.restart", reason=str(error))
            # The parent has no time limit and shares what it loads with all of its children;
            # the supervisor starts it again.
            os.kill(os.getppid(), signal.SIGTERM)
            break
        if time.monotonic() >= deadline:
            nudger.nudge()
            break
    return count


def _claim(engine: Engine, settings: Settings, pace: Pace) -> list[Claim]:
    with writing_once(engine) as session:
        return queue.claim(
            session,
            worker=f"{socket.gethostname()}:{os.getpid()}",
            lanes=tuple(LANES[name] for name in settings.worker_lanes),
            lease=settings.lease_seconds,
            max_attempts=settings.max_attempts,
            most=pace.batch(within=settings.batch_seconds, most=settings.batch_limit),
        )


def work_through(
    engine: Engine, settings: Settings, known: Models, pace: Pace, batch: Sequence[Claim]
) -> int:
    """Solve claimed landings and write their answers together; returns how many were tried.

    Landings that would make the batch last longer than it may are put back: whoever came with
    priority meanwhile is claimed next.
    """
    start = last = time.monotonic()
    answers: list[Answer] = []
    for place, claimed in enumerate(batch):
        if place and last - start >= settings.batch_seconds:
            _put_back(engine, batch[place:], None)
            batch = batch[:place]
            break
        with structlog.contextvars.bound_contextvars(
            assessment=claimed.assessment_id, landing=claimed.landing_id
        ):
            try:
                answers += _assess(engine, settings, known, claimed)
            except NewAircraftError as error:
                _put_back(engine, batch[place:], str(error))
                _write(engine, settings, answers)
                raise
        now = time.monotonic()
        pace.note(now - last)
        last = now
    _write(engine, settings, answers)
    return len(batch)


def _assess(engine: Engine, settings: Settings, known: Models, claimed: Claim) -> list[Answer]:
    """The answer to one landing, or none where the attempt went wrong and was closed."""
    try:
        assessed = _solve(known, claimed, settings)
        answer = recording.answer(claimed, assessed, keeps_arrays_from=settings.keeps_arrays_from)
    except NewAircraftError:
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
    else:
        return [answer]
    return []


def _solve(known: Models, claimed: Claim, settings: Settings) -> Assessment:
    record = inputs.from_json(claimed.inputs)
    model = known.get(record.aircraft)
    try:
        return solve(
            model,
            record,
            propagate_uncertainty=settings.propagate_uncertainty,
            time_limit=settings.soft_time_limit,
        )
    except (RecordError, SimulationDivergedError) as error:
        return undetermined(model, record, error)


def _write(engine: Engine, settings: Settings, answers: Sequence[Answer]) -> None:
    """Write answers in one transaction; if that fails each alone, so that one fails for itself."""
    if not answers:
        return
    try:
        _record(engine, answers)
    except (SQLAlchemyError, SoftTimeLimitExceeded) as error:
        if len(answers) > 1:
            for answer in answers:
                _write(engine, settings, [answer])
            return
        log.exception("assessment.not_written", assessment=answers[0].claim.assessment_id)
        _give_up(engine, settings, answers[0].claim, f"{type(error).__name__}: {error}")


def _record(engine: Engine, answers: Sequence[Answer]) -> None:
    with writing(engine) as session:
        written = {claimed.token for claimed in recording.record_answers(session, answers)}
    for answer in answers:
        about = {"assessment": answer.claim.assessment_id, "landing": answer.claim.landing_id}
        if answer.claim.token in written:
            timing = answer.verdict["timing"]
            log.info(
                "assessment.done", verdict=str(answer.verdict["verdict"]),
                seconds=timing["total"], **about,
            )  # fmt: skip
        else:
            log.warning("assessment.fenced", attempt=answer.claim.attempts, **about)


def _put_back(engine: Engine, claims: Sequence[Claim], reason: str | None) -> None:
    with writing_once(engine) as session:
        queue.release(session, claims, reason)


def _give_up(engine: Engine, settings: Settings, claimed: Claim, error: str) -> None:
    with writing(engine) as session:
        queue.give_up(session, claimed, error, settings.max_attempts)
