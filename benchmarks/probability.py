"""What the probability of a landing costs: seconds of 256 samples, and one by one against batch.

Wall-clock seconds depend on what else runs; processor seconds do not, and over the cores they are
what a quiet machine takes.  The rates of products and copies, measured in the same run, say how
fast it is.

    python -m benchmarks.probability [--landings 64]
"""

import argparse
import json
import math
from time import perf_counter, process_time

from threadpoolctl import threadpool_limits

from app.cli.demo import EXAMPLE_AIRCRAFT
from benchmarks.console import ConsoleProgress
from benchmarks.landing import VAR, machine_rates
from solver.aircraft.bizjet import build_bizjet
from solver.assess import AssessmentModel, assess_landing, load_assessment_model
from solver.assessment import TouchdownRecord
from solver.landing.batch import available_cores, simulate_landings
from solver.landing.contact import Contact
from solver.landing.contact_uncertainty import ContactUncertainty
from solver.landing.history import LandingHistory
from solver.probability.exceedance import SAMPLE_OPTIONS

DEGREE = math.pi / 180.0

#: What a record has that states no deviations, see `app.landings.quantities`.
UNCERTAINTY = ContactUncertainty.independent(
    sink_rate=0.3,
    pitch=0.5 * DEGREE,
    roll=0.5 * DEGREE,
    drift=1.0 * DEGREE,
    ground_speed=1.03,
    pitch_rate=0.8 * DEGREE,
    roll_rate=0.8 * DEGREE,
    yaw_rate=0.8 * DEGREE,
    lift_fraction=0.1,
)

#: Name and sink rate [m/s]: settled by its corners, near a threshold, at the limit sink rate.
LANDINGS = (("soft", 0.64), ("firm", 2.0), ("limit", 3.048))


def contact(sink_rate: float) -> Contact:
    """Level, three degrees nose up, one degree of roll."""
    return Contact(sink_rate=sink_rate, ground_speed=55.0, pitch=3 * DEGREE, roll=DEGREE)


def timed_landing(model: AssessmentModel, sink_rate: float) -> dict[str, float | str]:
    """Seconds of a landing's assessment without and with its probability."""
    mass = model.airframe.definition.masses.maximum_landing
    certain = TouchdownRecord(model.name, (contact(sink_rate),), mass=mass)
    start = process_time()
    assess_landing(model, certain)
    alone = process_time() - start
    record = TouchdownRecord(
        model.name, (contact(sink_rate),), mass=mass, uncertainties=(UNCERTAINTY,)
    )
    start, wall = process_time(), perf_counter()
    found = assess_landing(model, record)
    processor, wall = process_time() - start, perf_counter() - wall
    known = found.limit_probability
    assert known is not None
    return {
        "sink_rate_m_s": sink_rate,
        "utilisation": found.worst_utilisation,
        "probability": known.probability,
        "upper": known.upper,
        "basis": str(known.basis),
        "samples": known.samples,
        "assessment_alone_processor_s": alone,
        "processor_s": processor,
        "wall_s": wall,
        "processor_s_per_core": processor / available_cores(),
    }


def timed_batch(model: AssessmentModel, count: int) -> dict[str, float]:
    """Wall-clock seconds of a landing simulation alone and in a batch over all cores."""
    aircraft = model.airframe.landing_aircraft(model.airframe.loading_for().factors)
    landings = [(aircraft, contact(1.0 + 2.0 * number / count)) for number in range(count)]

    def last(_: int, history: LandingHistory) -> float:
        return float(history.time[-1])

    figures = {}
    for name, threads in (("one_by_one", 1), ("batch", available_cores())):
        start, wall = process_time(), perf_counter()
        simulate_landings(landings, last, SAMPLE_OPTIONS, threads)
        figures[f"{name}_wall_s"] = (perf_counter() - wall) / count
        figures[f"{name}_processor_s"] = (process_time() - start) / count
    return figures


def main(arguments: list[str] | None = None) -> None:
    """Measure, print and store under ``var/bench``."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--landings", type=int, default=64, help="of the batch")
    options = parser.parse_args(arguments)
    progress = ConsoleProgress()
    with threadpool_limits(1):
        folder = VAR / "aircraft" / EXAMPLE_AIRCRAFT
        build_bizjet(folder, progress=progress)
        model = load_assessment_model(folder, VAR / "cache", progress)
        rates = machine_rates()
        assess_landing(model, TouchdownRecord(model.name, (contact(0.5),)))
        batch = timed_batch(model, options.landings)
        rows = {name: timed_landing(model, sink_rate) for name, sink_rate in LANDINGS}
    results = VAR / "bench"
    results.mkdir(parents=True, exist_ok=True)
    stored = {**rates, "cores": available_cores(), "batch": batch, "landings": rows}
    (results / "probability.json").write_text(json.dumps(stored, indent=1))
    print(
        f"machine: {available_cores()} cores, one core {rates['product_gflop_s']:.0f} Gflop/s "
        f"single-precision products, {rates['copy_gb_s']:.1f} GB/s copies"
    )
    print(f"{'landing':<8}{'samples':>8}{'P':>8}{'processor':>11}{'per core':>10}{'wall':>8}")
    for name, row in rows.items():
        print(
            f"{name:<8}{row['samples']:>8}{row['probability']:>8.3f}{row['processor_s']:>9.2f} s"
            f"{row['processor_s_per_core']:>8.2f} s{row['wall_s']:>6.1f} s   {row['basis']}; "
            f"{row['assessment_alone_processor_s']:.2f} s without"
        )
    print(f"{options.landings} landing simulations, each:")
    for title, name in (("one by one", "one_by_one"), ("batch, all cores", "batch")):
        wall, processor = batch[f"{name}_wall_s"], batch[f"{name}_processor_s"]
        print(f"  {title:<18}{1e3 * wall:6.1f} ms wall, {1e3 * processor:6.1f} ms processor")


if __name__ == "__main__":
    main()
