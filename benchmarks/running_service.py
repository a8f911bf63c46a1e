"""The service under measurement: servers, API and worker on this machine, and who talks to it."""

import argparse
import http.client
import json
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic, sleep
from typing import Any

from scipy.stats import gamma
from sqlalchemy import Engine, func, select

from app import migrate
from app import models as _all_tables  # noqa: F401 - tables refer to each other by name
from app.assessments.models import PENDING_CLAUSE, AssessmentJob
from app.cli.key import create_key
from app.config import Settings
from app.db import make_engine, reading
from benchmarks.console import ConsoleProgress
from solver.aircraft.bizjet import build_bizjet
from tests import records, servers
from tests.solver.aircraft.mini import write_mini_aircraft
from tests.worker.programs import Programs, descendants, programs

ROOT = Path(__file__).resolve().parents[1]
VAR = ROOT / "var"
CORES = len(os.sched_getaffinity(0))
TICK = os.sysconf("SC_CLK_TCK")

#: Rates and attitudes repeat after so many landings; the solver alone solves the same ones.
KINDS = 40

#: Sink rates of an airliner fleet, mean and standard deviation of 1,218 landings: a gamma
#: distribution with these [ft/s].
FLEET_SINK_RATE, FLEET_SINK_RATE_SD = 126.0 / 60.0, 68.0 / 60.0

#: Programs whose processor time is counted.
PROGRAMS = ("worker", "api", "postgres", "redis", "client")


def landing(aircraft: str, number: int, series: str) -> dict[str, Any]:
    """Return a touchdown record; soft and firm, level and rolled, as a fleet lands."""
    kind = number % KINDS
    shape = (FLEET_SINK_RATE / FLEET_SINK_RATE_SD) ** 2
    # The quantiles in the middles of equal shares, in an order that mixes them.
    share = ((7 * kind) % KINDS + 0.5) / KINDS
    sink_rate = float(gamma.ppf(share, shape, scale=FLEET_SINK_RATE / shape))
    return records.record(
        aircraft={"model_id": aircraft, "tail_token": f"T-{number % 300:04d}"},
        record_id=f"{series}-{number}",
        contacts=[
            records.contact(roll={"value": kind % 5 - 2.0, "unit": "deg"})
            # as well known as a smoother over a recorder window knows it
            | {"sink_rate": {"value": round(sink_rate, 2), "unit": "ft/s", "sd": 0.3}}
        ],
    )


@dataclass
class Bench:
    """The service under measurement and what is known about it."""

    options: argparse.Namespace
    settings: Settings
    engine: Engine
    running: Programs
    servers: dict[str, int]  #: process ids by name
    key: str
    progress: ConsoleProgress = field(default_factory=ConsoleProgress)
    figures: dict[str, Any] = field(default_factory=dict)

    def connect(self) -> http.client.HTTPConnection:
        """Open a connection that is kept for many requests."""
        return http.client.HTTPConnection("127.0.0.1", self.settings.port, timeout=120)

    def headers(self, kind: str = "application/json") -> dict[str, str]:
        """Return headers with the key."""
        return {"X-API-Key": self.key, "Content-Type": kind}

    def record(self, number: int, series: str) -> bytes:
        """Return a record as it is posted."""
        return json.dumps(landing(self.options.aircraft, number, series)).encode()

    def post(self, connection: http.client.HTTPConnection, body: bytes) -> str:
        """Post a landing; returns where its assessment will be."""
        connection.request("POST", "/v1/landings", body, self.headers())
        response = connection.getresponse()
        text = response.read()
        assert response.status == 202, text
        return str(response.headers["Location"])

    def ask(self, connection: http.client.HTTPConnection, place: str) -> dict[str, Any]:
        """Ask where an assessment stands."""
        connection.request("GET", place, headers=self.headers())
        answer: dict[str, Any] = json.loads(connection.getresponse().read())
        return answer

    def answered(self, body: bytes, patience: float = 60.0) -> tuple[float, float]:
        """Seconds from posting a landing to its verdict as its sender sees them; of the solver."""
        connection = self.connect()
        start = monotonic()
        place = self.post(connection, body)
        while (answer := self.ask(connection, place))["state"] in ("queued", "running"):
            if monotonic() - start > patience:
                raise TimeoutError(f"no verdict within {patience:g} s")
            sleep(0.02)  # a dashboard that asks more often would take the cores away
        took = monotonic() - start
        assert answer["state"] == "assessed", answer
        connection.close()
        return took, answer["result"]["timing"]["total"]

    def pending(self) -> int:
        """Count what waits or is being solved."""
        with reading(self.engine) as session:
            statement = select(func.count()).select_from(AssessmentJob).where(PENDING_CLAUSE)
            return session.scalar(statement) or 0

    def assessed(self) -> int:
        """Count what has a verdict."""
        with reading(self.engine) as session:
            statement = select(func.count()).where(AssessmentJob.state == "assessed")
            return session.scalar(statement) or 0

    @contextmanager
    def worker(self) -> Iterator[int]:
        """Run a worker with a process on each core."""
        process = self.running.start_worker(concurrency=CORES)
        yield process.pid
        self.running.kill(process)

    def processor(self) -> dict[str, float]:
        """Processor seconds of every program and of what came from it, so far."""
        found = {name: _seconds(pid) for name, pid in self.servers.items()}
        found["client"] = sum(os.times()[:2])
        return found


def _seconds(pid: int) -> float:
    total = 0
    for member in (pid, *descendants(pid)):
        try:
            words = Path(f"/proc/{member}/stat").read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        total += sum(map(int, words[11:15]))  # its own, and of children that have ended
    return total / TICK


def aircraft_folder(name: str) -> Path:
    """Folder with just the aircraft that is measured with."""
    folder = VAR / "bench" / "aircraft"
    target = folder / name / name
    target.parent.mkdir(parents=True, exist_ok=True)
    write: Callable[[Path], object] = write_mini_aircraft if name == "mini" else build_bizjet
    write(target)  # every time: an earlier version's aircraft would be another one
    return target.parent


@contextmanager
def service(options: argparse.Namespace, folder: Path) -> Iterator[Bench]:
    """Servers and API, on ports of their own; no worker yet."""
    postgres = servers.Postgres(is_durable=True).start()
    broker = servers.Redis().start()
    try:
        settings = Settings(
            _env_file=None,  # type: ignore[call-arg]  # pydantic-settings adds it
            var=folder,
            aircraft_dir=aircraft_folder(options.aircraft),
            cache_dir=VAR / "cache",
            database_url=postgres.create_database("hl_bench"),
            broker_url=broker.url(0),
            port=servers.free_port(),
            auto_migrate=False,
        )
        migrate.upgrade(settings.sqlalchemy_url)
        key = create_key(settings, operator="alpha", scopes=("post", "read"))
        engine = make_engine(settings.sqlalchemy_url)
        with programs(settings, folder) as running:
            api = running.start_api()
            assert postgres.process is not None
            assert broker.process is not None
            ids = {"api": api.pid, "postgres": postgres.process.pid, "redis": broker.process.pid}
            yield Bench(options, settings, engine, running, ids, key)
        engine.dispose()
    finally:
        broker.remove()
        postgres.remove()
