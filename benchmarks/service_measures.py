"""What `benchmarks.service` measures, one figure after the other."""

import json
import statistics
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import cycle
from multiprocessing import get_context
from pathlib import Path
from time import monotonic, process_time, sleep

from sqlalchemy import select

from app import models as _all_tables  # noqa: F401 - tables refer to each other by name
from app.config import LANES
from app.db import reading, writing
from app.fleet.models import Operator
from app.fleet.registry import AircraftRegistry
from app.landings import arrivals, inputs, repository
from app.landings.intake import parse_record
from app.security import Principal
from benchmarks.running_service import CORES, KINDS, Bench, landing
from solver.assess import AssessmentModel, assess_landing
from tests.worker.programs import children


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
