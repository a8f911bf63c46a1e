"""How the cost of a landing grows with the airframe (``make bench-scaling``).

The same aircraft is meshed with every bay divided 1, 2 and 4 times in both directions.  What is
built is kept below ``var/bench/scaling``; a run that is stopped goes on with the size it was at.
Each is measured in a process of its own, one thread, processor time.

Resident memory is the largest that a process had while it assessed a landing: all of it, and
without the mapped files.  Those pages are shared by all processes on a machine and dropped when it
is short of memory; what is left is what each worker process costs.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path
from time import process_time

from threadpoolctl import threadpool_limits

from benchmarks.console import ConsoleProgress
from benchmarks.landing import measured
from solver.aircraft.airframe import load_airframe
from solver.aircraft.bizjet import build_bizjet
from solver.assess import assess_landing, load_assessment_model
from solver.assessment import TouchdownRecord
from solver.inertia_relief.build import reduced_model
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import landing_loads
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.response import landing_response
from solver.landing.simulate import SimulationOptions, simulate_landing
from verification.cases import CASES
from verification.run import ROOT

FOLDER = ROOT / "var" / "bench" / "scaling"
#: Divisions of every bay: about 10,000, 30,000 and 100,000 elements.
SIZES = (1, 2, 4)
DURATION = 1.0  #: of the landing [s]
_GIGA = 2**20  #: kB in a GB
_COLUMNS = (
    ("elements", "elements", ",.0f", 1.0),
    ("freedoms", "freedoms", ",.0f", 1.0),
    ("coordinates", "coordinates", ".0f", 1.0),
    ("simulation", "simulation_s", ".0f", 1e3),
    ("integration", "integration_s", ".0f", 1e3),
    ("peaks", "peaks_s", ".0f", 1e3),
    ("in all [ms]", "landing_s", ".0f", 1e3),
    ("resident", "resident_gb", ".2f", 1.0),
    ("unshared [GB]", "unshared_gb", ".2f", 1.0),
    ("start [s]", "start_s", ".2f", 1.0),
    ("build [s]", "build_s", ".0f", 1.0),
    ("its peak [GB]", "build_peak_gb", ".1f", 1.0),
)


def memory(name: str) -> float:
    """Memory of this process by its name in ``/proc/self/status`` [GB]."""
    for line in Path("/proc/self/status").read_text().splitlines():
        words = line.split()
        if words[0] == f"{name}:":
            return int(words[1]) / _GIGA
    return 0.0


def build(size: int) -> None:
    """Mesh the airframe and build its reduced model; writes what that took beside them."""
    folder, progress = FOLDER / str(size), ConsoleProgress()
    build_bizjet(folder, float(size), progress=progress)
    start = process_time()
    airframe = load_airframe(folder, progress)
    reduced = reduced_model(airframe, FOLDER / "cache", progress=progress)
    cost = {
        "freedoms": airframe.structure.n_free,
        "build_s": process_time() - start,
        "build_peak_gb": memory("VmHWM"),
    }
    (folder / "build.json").write_text(json.dumps({"key": reduced.key, "cost": cost}))


def measure(size: int) -> dict[str, float]:
    """Figures of one size; the model is there already."""
    folder, cache = FOLDER / str(size), FOLDER / "cache"
    built = json.loads((folder / "build.json").read_text())
    load_assessment_model(folder, cache)  # leaves the airframe stored
    model, start = measured(lambda: load_assessment_model(folder, cache))
    if model.reduced.key != built["key"]:
        raise SystemExit(f"{folder} was built by another version: remove it and run again")
    airframe, reduced, case = model.airframe, model.reduced, CASES[0]
    assess_landing(model, TouchdownRecord(aircraft=model.name, contacts=(case.contact,)))
    Path("/proc/self/clear_refs").write_text("5")  # the largest so far is forgotten
    factors = case.factors(airframe)
    options = SimulationOptions(time_limit=DURATION, stop_when_settled=False)
    aircraft = airframe.landing_aircraft(factors)
    history, simulation = measured(lambda: simulate_landing(aircraft, case.contact, options))
    loads = landing_loads(airframe, history)
    response, integration = measured(lambda: landing_response(assemble(reduced, factors), loads))
    _, peaks = measured(lambda: find_peaks(reduced, response))
    resident, files = memory("VmHWM"), memory("RssFile") + memory("RssShmem")
    return {
        "size": size,
        "elements": reduced.element_count,
        "coordinates": reduced.size,
        "simulation_s": simulation,
        "integration_s": integration,
        "peaks_s": peaks,
        "landing_s": simulation + integration + peaks,
        "resident_gb": resident,
        "unshared_gb": resident - files,
        "start_s": start,
        **built["cost"],
    }


def report(rows: list[dict[str, float]]) -> None:
    """Print the figures of every size, and how each stands to the smallest."""
    print(f"{CASES[0].title}, {DURATION:g} s; one thread, processor time")
    print("".join(f"{title:>15}" for title, *_ in _COLUMNS))
    for row in rows:
        print("".join(f"{row[key] * scale:>15{form}}" for _, key, form, scale in _COLUMNS))
    first = rows[0]
    for row in rows[1:]:
        names = ("elements", "landing_s", "peaks_s", "resident_gb", "unshared_gb", "build_s")
        ratios = ", ".join(f"{name.rsplit('_', 1)[0]} {row[name] / first[name]:.1f}"
                           for name in names)  # fmt: skip
        print(f"{row['elements']:,.0f} elements against {first['elements']:,.0f}: {ratios} times")


def main(arguments: list[str] | None = None) -> None:
    """Build what is missing, measure every size in a process of its own, print and store."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, help="divisions of a bay")
    parser.add_argument("--build", type=int, help="build one size and end")
    parser.add_argument("--measure", type=int, help="measure one size, print JSON and end")
    options = parser.parse_args(arguments)
    with threadpool_limits(1):
        if options.build is not None:
            return build(options.build)
        if options.measure is not None:
            print(json.dumps(measure(options.measure)))
            return None
    rows = []
    for size in options.sizes:
        if not (FOLDER / str(size) / "build.json").exists():
            print(f"building with every bay divided {size} times", file=sys.stderr)
            subprocess.run(
                [sys.executable, "-m", "benchmarks.scaling", f"--build={size}"], check=True
            )
        found = subprocess.run(
            [sys.executable, "-m", "benchmarks.scaling", f"--measure={size}"],
            check=True,
            capture_output=True,
            text=True,
        )
        rows.append(json.loads(found.stdout))
        (FOLDER / "scaling.json").write_text(json.dumps(rows, indent=1))
    report(rows)
    return None


if __name__ == "__main__":
    main()
