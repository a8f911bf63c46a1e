"""`hardlanding serve`"""

import os
import sys
import threading
from pathlib import Path
from typing import Annotated

import typer

from app.cli.envelope import missing_command
from app.cli.migrate import upgrade
from app.cli.supervisor import Program, Supervisor
from app.cli.worker import worker_command
from app.config import Settings, get_settings


def api_command(settings: Settings) -> list[str]:
    """The API as a program of its own, the same under the supervisor and alone."""
    return [
        sys.executable, "-m", "uvicorn", "app.main:create_app", "--factory",
        "--host", settings.host, "--port", str(settings.port),
        "--no-access-log", "--no-server-header", "--timeout-graceful-shutdown", "10",
    ]  # fmt: skip


def serve(
    host: Annotated[str | None, typer.Option(help="Address to listen on.")] = None,
    port: Annotated[int | None, typer.Option(min=0, max=65535)] = None,
    with_worker: Annotated[
        bool, typer.Option("--worker/--no-worker", help="Run a worker beside the API.")
    ] = True,
) -> None:
    """Run the service: API and, unless told otherwise, a worker beside it."""
    given = {"HL_HOST": host, "HL_PORT": port}
    os.environ.update({name: str(value) for name, value in given.items() if value is not None})
    settings = get_settings()
    if settings.auto_migrate:
        upgrade(settings)
    if not with_worker:
        command = api_command(settings)
        os.execv(command[0], command)  # noqa: S606 - becomes the API, so that signals reach it
    typer.echo(f"Serving on http://{settings.host}:{settings.port}, interface at /docs")
    supervise(settings)


def supervise(
    settings: Settings, log: Path | None = None, is_calm: threading.Event | None = None
) -> None:
    """Run API and worker side by side until SIGTERM or SIGINT; they print to ``log`` if given.

    Envelopes that are missing are made beside them, from ``is_calm`` on.
    """
    programs = [
        Program("api", api_command(settings)),
        Program("worker", worker_command(settings.worker_concurrency)),
    ]
    if settings.makes_envelopes:
        programs.append(Program("envelope", missing_command(), is_once=True, may_start=is_calm))
    Supervisor(programs, say=lambda line: typer.echo(line, err=True), log=log).run()
