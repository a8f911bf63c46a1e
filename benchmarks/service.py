"""How the service keeps up: everything side by side in one run (``make bench-service``).

A real Postgres that waits for its disk, a real Redis, the API and a worker with a process on each
core, all on this machine, and the client beside them.  The rate that the service is measured by is
that of the solver alone on the same cores, before and after, as other programs may share them.
"""

import argparse
import http.client
import json
import os
import statistics
import tempfile
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import cycle
from multiprocessing import get_context
from pathlib import Path
from time import monotonic, process_time, sleep
from typing import Any

from sqlalchemy import Engine, func, select
from threadpoolctl import threadpool_limits

from app import migrate
from app import models as _all_tables  # noqa: F401 - tables refer to each other by name
from app.assessments.models import PENDING_CLAUSE, AssessmentJob
from app.cli.demo import EXAMPLE_AIRCRAFT
from app.cli.key import create_key
from app.config import LANES, Settings
from app.db import make_engine, reading, writing
from app.fleet.models import Operator
from app.fleet.registry import AircraftRegistry
from app.landings import arrivals, inputs, repository
from app.landings.intake import parse_record
from app.security import Principal
from benchmarks.console import ConsoleProgress
from solver.aircraft.bizjet import build_bizjet
from solver.assess import AssessmentModel, assess_landing, load_assessment_model
from tests import records, servers
from tests.solver.aircraft.mini import write_mini_aircraft
from tests.worker.programs import Programs, children, descendants, programs

ROOT = Path(__file__).resolve().parents[1]
VAR = ROOT / "var"
CORES = len(os.sched_getaffinity(0))
TICK = os.sysconf("SC_CLK_TCK")

#: Rates and attitudes repeat after so many landings; the solver alone solves the same ones.
KINDS = 40

#: Programs whose processor time is counted.
PROGRAMS = ("worker", "api", "postgres", "redis", "client")


def landing(aircraft: str, number: int, series: str) -> dict[str, Any]:
    """Return a touchdown record; soft and hard, level and rolled, as they come."""
    kind = number % KINDS
    return records.record(
        aircraft={"model_id": aircraft, "tail_token": f"T-{number % 300:04d}"},
        record_id=f"{series}-{number}",
        contacts=[
            records.contact(
                round(1.0 + 0.2 * kind, 2), roll={"value": kind % 5 - 2.0, "unit": "deg"}
            )
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


def solver_rate(model: AssessmentModel, seconds: float) -> tuple[float, float]:
    """Landings per second of the solver alone, a process on each core; processor time of each."""
    context = get_context("fork")  # shares the model
    total, processor = context.Value("i", 0), context.Value("d", 0.0)
    barrier = context.Barrier(CORES + 1)

    def solve() -> None:
        kinds = [landing(model.name, number, "alone") for number in range(KINDS)]
        fleet = {model.name: model.airframe.definition}
        taken = [
            inputs.from_json(arrivals.check(parse_record(kind), _NOBODY, fleet).inputs)
            for kind in kinds
        ]
        assess_landing(model, taken[0])
        barrier.wait()
        count, end, begun = 0, monotonic() + seconds, process_time()
        for record in cycle(taken):
            assess_landing(model, record)
            count += 1
            if monotonic() >= end:
                break
        with total.get_lock():
            total.value += count
            processor.value += process_time() - begun

    processes = [context.Process(target=solve) for _ in range(CORES)]
    for process in processes:
        process.start()
    barrier.wait()
    start = monotonic()
    for process in processes:
        process.join()
    return float(total.value) / (monotonic() - start), processor.value / total.value


_NOBODY = Principal("", "alpha", "", frozenset())


def idle_latency(bench: Bench) -> None:
    """One landing at a time, nothing else to do."""
    count = bench.options.idle
    for number in range(3):
        bench.answered(bench.record(number, "warm"))
    times, beside = [], []
    for number in range(count):
        sleep(0.15)
        took, solving = bench.answered(bench.record(number, "idle"))
        times.append(took)
        beside.append(took - solving)
        bench.progress("one landing at a time", (number + 1) / count)
    bench.figures |= {
        "idle_landings": count,
        "idle_p50_s": statistics.median(times),
        "idle_p95_s": _p95(times),
        "idle_beside_the_solver_p50_s": statistics.median(beside),
        "idle_beside_the_solver_p95_s": _p95(beside),
    }


def _p95(times: Sequence[float]) -> float:
    return sorted(times)[min(len(times) - 1, int(0.95 * len(times)))]


def throughput(bench: Bench, count: int) -> None:
    """From the first POST to the last verdict."""
    bodies = [bench.record(number, "many") for number in range(count)]
    before, done = bench.processor(), bench.assessed()
    start = monotonic()

    def send(share: Sequence[bytes]) -> None:
        connection = bench.connect()
        for body in share:
            bench.post(connection, body)
        connection.close()

    with ThreadPoolExecutor(4) as pool:
        list(pool.map(send, [bodies[n::4] for n in range(4)]))
    posted = monotonic() - start
    while (left := bench.pending()) > 0:
        bench.progress("post to last verdict", 1.0 - left / count)
        sleep(0.2 if left > 20 else 0.02)
    took = monotonic() - start
    bench.progress("post to last verdict", 1.0)
    assert bench.assessed() - done == count
    after = bench.processor()
    bench.figures |= {
        "posted": count,
        "posting_s": posted,
        "post_to_last_verdict_s": took,
        "service_landings_per_s": count / took,
        **{
            f"{name}_processor_ms_per_landing": 1e3 * (after[name] - before[name]) / count
            for name in before
        },
    }


def memory_of_children(bench: Bench) -> None:
    """Memory that each of the worker's processes has for itself, and what it shares."""
    (worker,) = children(bench.servers["worker"])
    found = []
    for child in children(worker):
        lines = Path(f"/proc/{child}/smaps_rollup").read_text().splitlines()[1:]
        sizes = {name: int(size.split()[0]) for name, size in (line.split(":") for line in lines)}
        own = sizes["Private_Clean"] + sizes["Private_Dirty"]
        found.append((own / 1024, (sizes["Rss"] - own) / 1024))
    bench.figures |= {
        "worker_processes_own_mb": [own for own, _ in found],
        "worker_processes_shared_mb": [shared for _, shared in found],
    }


def bulk_intake(bench: Bench, count: int) -> None:
    """Measure a back-fill over HTTP, nothing else running."""
    body = b"".join(bench.record(number, "bulk") + b"\n" for number in range(count))
    before = bench.processor()
    connection = bench.connect()
    start = monotonic()
    pieces = (body[at : at + 65536] for at in range(0, len(body), 65536))
    connection.request(
        "POST", "/v1/landings/bulk", pieces, bench.headers("application/x-ndjson"),
        encode_chunked=True,
    )  # fmt: skip
    answer = connection.getresponse().read().splitlines()
    took = monotonic() - start
    end = json.loads(answer[-1])
    assert end["accepted"] == count, end
    after = bench.processor()
    bench.figures |= {
        "bulk_records": count,
        "bulk_bytes": len(body),
        "bulk_records_per_s": count / took,
        **{
            f"bulk_{name}_processor_us_per_record": 1e6 * (after[name] - before[name]) / count
            for name in ("api", "postgres", "client")
        },
    }


def fill(bench: Bench, count: int) -> None:
    """Queue landings in the bulk lane until so many wait, straight into the tables."""
    with reading(bench.engine) as session:
        operator = session.scalars(select(Operator.id)).one()
    principal = Principal(operator, "alpha", "bench", frozenset())
    fleet = arrivals.fleet(AircraftRegistry(bench.settings.aircraft_folder))
    missing, number, chunk = count - bench.pending(), 0, 2000
    while number < missing:
        size = min(chunk, missing - number)
        arrived = [
            arrivals.check(parse_record(bench.record(n, "fill")), principal, fleet)
            for n in range(number, number + size)
        ]
        with writing(bench.engine) as session:
            repository.store(session, principal, arrived, LANES["bulk"])
        number += size
        bench.progress("filling the queue", number / missing)
    with writing(bench.engine) as session:
        repository.count_anew(session)  # as a stream of so many would have


def behind_the_queue(bench: Bench) -> None:
    """Single landings that somebody waits for, behind a back-fill that is being worked off."""
    queued, start = bench.pending(), bench.assessed()
    while bench.assessed() - start < 4 * CORES:
        sleep(0.1)
    times = []
    for number in range(bench.options.waiting):
        times.append(bench.answered(bench.record(number, "waiting"))[0])
        bench.progress("one landing behind the queue", (number + 1) / bench.options.waiting)
        sleep(0.1)
    bench.figures |= {
        "queued": queued,
        "still_queued": bench.pending(),
        "waiting_landings": len(times),
        "waiting_p50_s": statistics.median(times),
        "waiting_worst_s": max(times),
    }


def aircraft_folder(name: str) -> Path:
    """Folder with just the aircraft that is measured with."""
    folder = VAR / "bench" / "aircraft"
    target = folder / name / name
    if not (target / "definition.toml").exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        write: Callable[[Path], object] = write_mini_aircraft if name == "mini" else build_bizjet
        write(target)
    return target.parent


@contextmanager
def service(options: argparse.Namespace, folder: Path) -> Iterator[Bench]:
    """Servers and API, on ports of their own; no worker yet."""
    postgres = servers.Postgres(is_durable=True).start()
    broker = servers.Redis().start()
    try:
        settings = Settings(
            _env_file=None,
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


def main(arguments: list[str] | None = None) -> None:
    """Measure, print and store under ``var/bench``."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--aircraft", choices=(EXAMPLE_AIRCRAFT, "mini"), default=EXAMPLE_AIRCRAFT)
    parser.add_argument("--landings", type=int, default=2000, help="posted and waited for")
    parser.add_argument("--seconds", type=float, default=420.0, help="fewer, if they took longer")
    parser.add_argument("--alone", type=float, default=10.0, help="of the solver, twice [s]")
    parser.add_argument("--idle", type=int, default=40, help="landings one at a time")
    parser.add_argument("--bulk", type=int, default=20_000, help="records of the back-fill")
    parser.add_argument("--queued", type=int, default=100_000, help="landings in the bulk lane")
    parser.add_argument("--waiting", type=int, default=10, help="landings behind the queue")
    options = parser.parse_args(arguments)
    start = monotonic()
    with threadpool_limits(1), tempfile.TemporaryDirectory(prefix="hl-bench-") as folder:
        model = load_assessment_model(
            aircraft_folder(options.aircraft) / options.aircraft, VAR / "cache", ConsoleProgress()
        )
        before, least = solver_rate(model, options.alone)
        count = max(KINDS, min(options.landings, int(0.5 * before * options.seconds)))
        with service(options, Path(folder)) as bench:
            figures = bench.figures
            figures |= {"aircraft": options.aircraft, "cores": CORES, "servers": servers.describe()}
            with bench.worker() as pid:
                bench.servers["worker"] = pid
                idle_latency(bench)
                throughput(bench, count)
                memory_of_children(bench)
                del bench.servers["worker"]
            after, again = solver_rate(model, options.alone)
            bulk_intake(bench, options.bulk)
            fill(bench, options.queued)
            with bench.worker():
                behind_the_queue(bench)
    rate, alone = 0.5 * (before + after), 0.5 * (least + again)
    spent = sum(figures[f"{name}_processor_ms_per_landing"] for name in PROGRAMS)
    figures |= {
        "solver_processor_ms_per_landing": 1e3 * alone,
        "share_of_the_processor": 1e3 * alone / spent,
        "solver_landings_per_s_before": before,
        "solver_landings_per_s_after": after,
        "solver_landings_per_s": rate,
        "share_of_the_solver": figures["service_landings_per_s"] / rate,
        "took_s": monotonic() - start,
    }
    target = VAR / "bench"
    target.mkdir(parents=True, exist_ok=True)
    (target / "service.json").write_text(json.dumps(figures, indent=1))
    report(figures)


def report(figures: dict[str, Any]) -> None:
    """Print the figures as a table."""
    print(f"{figures['aircraft']} on {figures['cores']} cores; {figures['servers']}")
    rows = [
        (
            "solver alone, a process on each core, before and after",
            f"{figures['solver_landings_per_s_before']:.2f}, "
            f"{figures['solver_landings_per_s_after']:.2f} landings/s",
        ),
        (
            f"POST of {figures['posted']} landings to the last verdict",
            f"{figures['post_to_last_verdict_s']:.1f} s, "
            f"{figures['service_landings_per_s']:.2f} landings/s",
        ),
        ("  share of the solver's rate", f"{figures['share_of_the_solver']:.0%} (goal 60 %)"),
        (
            "  processor time of the solver alone, and its share of all below",
            f"{figures['solver_processor_ms_per_landing']:.1f} ms, "
            f"{figures['share_of_the_processor']:.0%}",
        ),
        *(
            (
                f"  processor time of {name} for each landing",
                f"{figures[f'{name}_processor_ms_per_landing']:.1f} ms",
            )
            for name in PROGRAMS
        ),
        (
            f"idle, POST to verdict, {figures['idle_landings']} landings",
            f"p50 {figures['idle_p50_s']:.3f} s, p95 {figures['idle_p95_s']:.3f} s (goal 0.5 s)",
        ),
        (
            "  of it beside the solver's own time",
            f"p50 {figures['idle_beside_the_solver_p50_s']:.3f} s, "
            f"p95 {figures['idle_beside_the_solver_p95_s']:.3f} s",
        ),
        (
            f"one landing behind {figures['queued']} queued, {figures['waiting_landings']} times",
            f"p50 {figures['waiting_p50_s']:.2f} s, worst {figures['waiting_worst_s']:.2f} s "
            "(goal 2 s)",
        ),
        (
            f"back-fill of {figures['bulk_records']} records over HTTP",
            f"{figures['bulk_records_per_s']:.0f} records/s (goal 2,000)",
        ),
        *(
            (
                f"  processor time of {name} for each record",
                f"{figures[f'bulk_{name}_processor_us_per_record']:.0f} us",
            )
            for name in ("api", "postgres", "client")
        ),
    ]
    own, shared = (
        ", ".join(f"{size:.0f}" for size in figures[f"worker_processes_{kind}_mb"])
        for kind in ("own", "shared")
    )
    rows.append(("memory of each worker process", f"own {own} MB, shared {shared} MB"))
    for title, value in rows:
        print(f"  {title:<66}{value}")
    print(f"{figures['took_s']:.0f} s in all")


if __name__ == "__main__":
    main()
