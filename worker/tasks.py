"""What a nudge sets off."""

from functools import cache

from app.broker import DRAIN_TASK, Nudger
from app.db import get_engine
from worker.celery import app, settings
from worker.pace import Pace
from worker.warm import models
from worker.work import work_off

#: Of this process: each child learns its own.
_pace = Pace()


@app.task(name=DRAIN_TASK)
def drain() -> int:
    """Assess due landings until none is left or the time budget is used up; returns how many."""
    return work_off(get_engine(), settings, models(settings), _nudger(), _pace)


@cache
def _nudger() -> Nudger:
    """The nudger of this process; made on first use, after the fork."""
    return Nudger(settings)
