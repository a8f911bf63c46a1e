"""The service's own worker with a trapped solver; only a worker program may import this."""

import math
import os
import signal
import time
from typing import Any

import worker.work
from solver.assess import AssessmentModel
from solver.assessment import Assessment, TouchdownRecord
from tests.chaos.saboteur import KILLER, SLEEPER
from worker.celery import app
from worker.solve import solve

__all__ = ["app"]


def trapped(model: AssessmentModel, record: TouchdownRecord, **options: Any) -> Assessment:
    drift = round(math.degrees(record.contacts[0].drift), 6)
    if drift == KILLER:
        os.kill(os.getpid(), signal.SIGKILL)
    while drift == SLEEPER:
        time.sleep(0.05)
    return solve(model, record, **options)


worker.work.solve = trapped
