"""A worker that some landings kill: the service's own, with a trapped solver.

``python -m tests.chaos.saboteur`` runs it under the supervisor.  A landing with a drift of exactly
33 degrees kills the process that solves it; one with exactly 34 degrees is never done.
"""

import math
import os
import signal
import time

import worker.work
from app.cli.supervisor import Program, Supervisor
from app.cli.worker import worker_command
from solver.assess import AssessmentModel
from solver.assessment import Assessment, TouchdownRecord
from worker.celery import app
from worker.solve import solve

__all__ = ["app"]

KILLER = 33.0
SLEEPER = 34.0


def trapped(model: AssessmentModel, record: TouchdownRecord) -> Assessment:
    drift = round(math.degrees(record.contacts[0].drift), 6)
    if drift == KILLER:
        os.kill(os.getpid(), signal.SIGKILL)
    while drift == SLEEPER:
        time.sleep(0.05)
    return solve(model, record)


if __name__ == "__main__":
    command = worker_command(2, application="tests.chaos.saboteur")
    Supervisor([Program("worker", command)], say=print).run()
else:
    worker.work.solve = trapped
