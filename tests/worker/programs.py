"""The service's programs as real processes, for tests that kill them."""

import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import httpx2

from app.cli.serve import api_command
from app.config import Settings
from tests.servers import wait_until

ROOT = Path(__file__).resolve().parents[2]


def environment(settings: Settings) -> dict[str, str]:
    """The settings as a program finds them."""
    given = settings.model_dump(mode="json", exclude_none=True)
    lanes = given.pop("worker_lanes")
    named = {f"HL_{name.upper()}": str(value) for name, value in given.items()}
    kept = {name: os.environ[name] for name in ("PATH", "HOME", "LANG") if name in os.environ}
    threads = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"), "1")
    return {**kept, **threads, "HL_WORKER_LANES": ",".join(lanes), "PYTHONPATH": str(ROOT), **named}


@dataclass
class Programs:
    """Processes started by a test; all of them end with it."""

    settings: Settings
    log: Path
    running: list["subprocess.Popen[bytes]"] = field(default_factory=list)

    def start(self, command: Sequence[str]) -> "subprocess.Popen[bytes]":
        with self.log.open("ab") as output:
            process = subprocess.Popen(
                command,
                env=environment(self.settings),
                stdout=output,
                stderr=output,
                start_new_session=True,
                cwd=self.settings.var,
            )
        self.running.append(process)
        return process

    def start_api(self) -> "subprocess.Popen[bytes]":
        process = self.start(api_command(self.settings))
        wait_until(lambda: httpx2.get(f"{self.url}/readyz").status_code == 200, "the API")
        return process

    def start_worker(self, concurrency: int = 2) -> "subprocess.Popen[bytes]":
        return self.start_cli("worker", "--concurrency", str(concurrency))

    def start_cli(self, *arguments: str) -> "subprocess.Popen[bytes]":
        return self.start([sys.executable, "-m", "app.cli.main", *arguments])

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.settings.port}"

    def kill(self, process: "subprocess.Popen[bytes]") -> None:
        """kill -9 of a program and of all that came from it."""
        for pid in (process.pid, *descendants(process.pid)):
            kill_at_once(pid)
        process.wait()


@contextlib.contextmanager
def programs(settings: Settings, folder: Path) -> Iterator[Programs]:
    made = Programs(settings, folder / "programs.log")
    try:
        yield made
    except BaseException:
        print(made.log.read_text()[-20_000:] if made.log.exists() else "no log")
        raise
    finally:
        for process in made.running:
            made.kill(process)


def kill_at_once(pid: int) -> None:
    with contextlib.suppress(ProcessLookupError):
        os.kill(pid, signal.SIGKILL)


def children(pid: int) -> list[int]:
    """Process ids of a process's direct children, whichever of its threads made them."""
    found: list[int] = []
    with contextlib.suppress(OSError):
        for listed in Path(f"/proc/{pid}/task").glob("*/children"):
            found += [int(child) for child in listed.read_text().split()]
    return found


def descendants(pid: int) -> list[int]:
    """Children, their children, and so on."""
    return [member for child in children(pid) for member in (child, *descendants(child))]


def is_alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False
