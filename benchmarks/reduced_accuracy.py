"""Reduced against full-order extended inertia relief on the full-size example aircraft.

``python -m benchmarks.reduced_accuracy`` integrates four landings at loadings outside the basis
with both, from the same loads, and compares every element's peak.  A full-order run takes minutes;
its peaks are kept under ``var/verify`` and used again as long as aircraft, landing, damping and
time step are the same, so that an interrupted or repeated run resumes.  The exit status is 1 if an
element above 20 % of the global peak differs by more than 1 %.
"""

import argparse
import hashlib
import json
import sys
from dataclasses import asdict
from time import perf_counter

import numpy as np
from threadpoolctl import threadpool_limits

from benchmarks.cases import CACHE, CASES, VAR, Case, example_airframe
from benchmarks.console import ConsoleProgress
from solver.aircraft.airframe import Airframe
from solver.arrays import Array
from solver.inertia_relief.accumulate import PeakAccumulator
from solver.inertia_relief.build import airframe_damping, reduced_model
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.full_order import BodyLoads, integrate_full_order
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import LandingLoads, applied_shapes
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.response import landing_response
from solver.progress import Progress

FOLDER = VAR / "verify"
#: Elements whose peak exceeds this share of the global one must agree.
STRESSED = 0.2
#: Largest admissible difference of their peaks.
TOLERANCE = 0.01


def full_order_peaks(
    airframe: Airframe, case: Case, loads: LandingLoads, substeps: int, progress: Progress
) -> tuple[Array, float]:
    """Peaks (ne,) of the full-order integration and its seconds, from store if it has them."""
    damping = airframe_damping(airframe)
    text = f"{airframe.content_hash} {case} {asdict(damping)} {substeps} {len(loads.time)}"
    digest = hashlib.sha256(text.encode())
    for part in (loads.pin_loads, loads.air_loads, loads.motion.acceleration, loads.motion.rate):
        digest.update(np.ascontiguousarray(part).tobytes())
    path = FOLDER / f"full-order-{case.name}-{digest.hexdigest()[:16]}.npz"
    if path.exists():
        with np.load(path) as stored:
            return stored["stress"], float(stored["seconds"])
    start = perf_counter()
    peaks = PeakAccumulator(airframe.recovery)
    body = free_body(airframe.structure, airframe.inertia(case.factors(airframe)))
    integrate_full_order(
        body,
        BodyLoads(loads.time, applied_shapes(airframe), loads.applied_amplitudes(), loads.motion),
        damping,
        peaks,
        substeps,
        progress=progress,
    )
    seconds = perf_counter() - start
    np.savez(path, stress=peaks.stress, seconds=seconds)
    return peaks.stress, seconds


def reduced_peaks(model: ReducedModel, factors: Array, loads: LandingLoads) -> tuple[Array, float]:
    """Peaks (ne,) of the reduced integration and its seconds."""
    for _ in range(2):  # the first call compiles
        start = perf_counter()
        peaks = find_peaks(model, landing_response(assemble(model, factors), loads))
        seconds = perf_counter() - start
    return peaks.stress, seconds


def compare(reference: Array, found: Array) -> dict[str, float]:
    """Differences of ``found`` from ``reference`` peaks (ne,), relative to each element's own."""
    largest = float(reference.max())
    difference = np.abs(found / np.where(reference > 0, reference, np.inf) - 1)
    stressed, mild = reference > STRESSED * largest, reference > 0.05 * largest
    return {
        "global_peak_pa": largest,
        "global_peak_difference": abs(float(found.max()) / largest - 1),
        "stressed_elements": int(stressed.sum()),
        "stressed_largest_difference": float(difference[stressed].max()),
        "stressed_median_difference": float(np.median(difference[stressed])),
        "above_5_percent_99th_percentile": float(np.quantile(difference[mild], 0.99)),
        "above_5_percent_largest_difference": float(difference[mild].max()),
    }


def main(arguments: list[str] | None = None) -> int:
    """Compare all cases, write the figures, say whether they hold."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--duration", type=float, default=1.0, help="of each landing [s]")
    parser.add_argument("--substeps", type=int, default=4, help="full-order steps in 1 ms")
    parser.add_argument(
        "--step-error",
        action="store_true",
        help="also integrate the first case with half as many steps and state the difference",
    )
    options = parser.parse_args(arguments)
    FOLDER.mkdir(parents=True, exist_ok=True)
    progress = ConsoleProgress()
    with threadpool_limits(1):
        airframe = example_airframe(progress)
        model = reduced_model(airframe, CACHE, progress=progress)
        print(
            f"{airframe.definition.name}: {airframe.structure.n_free} freedoms, "
            f"{model.element_count} elements; reduced model: {model.size} coordinates"
        )
        holds = True
        for index, case in enumerate(CASES):
            loads = case.loads(airframe, options.duration)
            full, seconds = full_order_peaks(airframe, case, loads, options.substeps, progress)
            fast, fast_seconds = reduced_peaks(model, case.factors(airframe), loads)
            figures: dict[str, object] = {
                "case": case.title,
                "aircraft": airframe.content_hash,
                "duration_s": float(loads.time[-1]),
                "full_order_step_s": float(loads.time[1]) / options.substeps,
                "full_order_s": seconds,
                "reduced_s": fast_seconds,
                "coordinates": model.size,
                **compare(full, fast),
            }
            if options.step_error and index == 0:
                half, _ = full_order_peaks(airframe, case, loads, options.substeps // 2, progress)
                figures["full_order_change_from_doubled_step"] = compare(full, half)
            figures["holds"] = compare(full, fast)["stressed_largest_difference"] <= TOLERANCE
            holds = holds and bool(figures["holds"])
            (FOLDER / f"reduced-{case.name}.json").write_text(json.dumps(figures, indent=1))
            report(case, figures)
    return 0 if holds else 1


def report(case: Case, figures: dict[str, object]) -> None:
    """Print one case."""
    print(f"{case.name}: {case.title}")
    for name, value in figures.items():
        if name not in ("case", "aircraft"):
            print(f"  {name}: {value:.6g}" if isinstance(value, float) else f"  {name}: {value}")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
