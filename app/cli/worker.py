"""`hardlanding worker`"""

import os
import sys
from typing import Annotated

import typer

from app.cli.supervisor import Program, Supervisor
from app.config import LANES, get_settings


def worker_command(concurrency: int, application: str = "worker.celery") -> list[str]:
    """The worker as a program of its own."""
    return [
        sys.executable, "-m", "celery", "--app", application, "--quiet", "worker",
        "--pool", "prefork", "--concurrency", str(concurrency), "--loglevel", "INFO",
        # Workers have nothing to say to each other: the table tells all.
        "--without-gossip", "--without-mingle", "--without-heartbeat",
    ]  # fmt: skip


def worker(
    lanes: Annotated[
        str | None, typer.Option(help=f"Comma-separated, of: {', '.join(LANES)}.")
    ] = None,
    concurrency: Annotated[int | None, typer.Option(min=1, help="Processes.")] = None,
) -> None:
    """Assess queued landings until stopped."""
    if lanes is not None:
        os.environ["HL_WORKER_LANES"] = lanes
    settings = get_settings()
    command = worker_command(concurrency or settings.worker_concurrency)
    # Under a supervisor, as a pool that has lost a process may have to be made anew.
    supervisor = Supervisor(
        [Program("worker", command)], say=lambda line: typer.echo(line, err=True)
    )
    supervisor.run()
