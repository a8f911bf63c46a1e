"""How the service keeps up: everything side by side in one run (``make bench-service``).

A real Postgres that waits for its disk, a real Redis, the API and a worker with a process on each
core, all on this machine, and the client beside them.  The rate that the service is measured by is
that of the solver alone on the same cores, before and after, as other programs may share them.
"""

import argparse
import json
import tempfile
from pathlib import Path
from time import monotonic
from typing import Any

from threadpoolctl import threadpool_limits

from app import models as _all_tables  # noqa: F401 - tables refer to each other by name
from app.cli.demo import EXAMPLE_AIRCRAFT
from benchmarks.console import ConsoleProgress
from benchmarks.running_service import CORES, KINDS, PROGRAMS, VAR, aircraft_folder, service
from benchmarks.service_measures import (
    behind_the_queue,
    bulk_intake,
    fill,
    idle_latency,
    memory_of_children,
    solver_rate,
    throughput,
)
from solver.assess import load_assessment_model
from tests import servers


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
