"""Some landings kill their worker: ``python -m tests.chaos.saboteur`` runs it, supervised.

A landing with a drift of exactly 33 degrees kills the process that solves it; one with exactly 34
degrees is never done.
"""

from app.cli.supervisor import Program, Supervisor
from app.cli.worker import worker_command

KILLER = 33.0
SLEEPER = 34.0


if __name__ == "__main__":
    command = worker_command(2, application="tests.chaos.trapped_worker")
    Supervisor([Program("worker", command)], say=print).run()
