"""What one landing costs, every way and every step side by side in one run (``make bench``).

Full order and nonlinear analysis are measured on a stated part of the landing at the same steps
and, for the whole landing, computed from the measured cost of a step; everything else is measured
on the whole landing.  The
rates of matrix products and of copying, measured in the same run, say what limits the fast path.
"""

import argparse
import json
from collections.abc import Callable
from time import perf_counter, process_time
from typing import TypeVar

import numpy as np
from threadpoolctl import threadpool_limits

from benchmarks.console import ConsoleProgress
from solver.aircraft.airframe import Airframe
from solver.assess import AssessmentModel, assess_landing
from solver.assessment import TouchdownRecord
from solver.errors import SimulationDivergedError
from solver.inertia_relief.accumulate import PeakAccumulator
from solver.inertia_relief.build import airframe_damping
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.full_order import BodyLoads, integrate_full_order
from solver.inertia_relief.landings import landing_peaks, peaks_of_landings
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import LandingLoads, applied_shapes, landing_loads
from solver.inertia_relief.modal_recursion import add_modal_response
from solver.inertia_relief.peak_plan import SearchPlan, plan_search
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.rate_loads import RateLoads
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.response import (
    NEGLIGIBLE,
    RATE_STRIDE,
    SWEEP_TOLERANCE,
    landing_response,
)
from solver.landing.contact import Contact
from solver.landing.history import LandingHistory
from solver.landing.simulate import SimulationOptions, simulate_landing
from solver.nonlinear.landing import nonlinear_landing
from solver.progress import Progress
from verification.cases import CASES, Case
from verification.inertia_relief.landings import random_contact
from verification.run import ROOT, Run

REPEATS = 5
#: Share of its allowable up to which an element's stress does not matter to who samples landings.
FLOOR = 0.8
#: Full-order steps between two samples at which its peaks are as near to their limit for small
#: steps as the reduced ones are (the drawn landings of `make verify` compare both).
ACCURATE_SUBSTEPS = 4
VAR = ROOT / "var"
Result = TypeVar("Result")


def measured(call: Callable[[], Result]) -> tuple[Result, float]:
    """Return a call's result and its least processor time over some repeats [s].

    Processor time, because other processes may share the machine; one thread does all the work.
    """
    result, least = call(), np.inf
    for _ in range(REPEATS):
        start = process_time()
        result = call()
        least = min(least, process_time() - start)
    return result, float(least)


def least_time(call: Callable[[], None], repeats: int) -> float:
    """Least processor time of a long call that has run before [s]."""
    least = np.inf
    for _ in range(repeats):
        start = process_time()
        call()
        least = min(least, process_time() - start)
    return float(least)


def machine_rates() -> dict[str, float]:
    """Single-precision product rate [Gflop/s] and copy rate [GB/s] of this machine, one thread."""
    a = np.random.default_rng(0).random((1536, 1536), dtype=np.float32)
    _, product = measured(lambda: a @ a)
    source = np.zeros(8_000_000)
    target = np.empty_like(source)
    _, copy = measured(lambda: np.copyto(target, source))
    return {
        "product_gflop_s": 2e-9 * len(a) ** 3 / product,
        "copy_gb_s": 2e-9 * source.nbytes / copy,
    }


def full_order_sample(
    airframe: Airframe, case: Case, loads: LandingLoads, substeps: int, progress: Progress
) -> tuple[float, int]:
    """Processor seconds from one sample to the next at full order, and how many were measured."""
    body = free_body(airframe.structure, airframe.inertia(case.factors(airframe)))
    marks: list[float] = []
    peaks = PeakAccumulator(airframe.recovery)

    def consume(first: int, displacements: np.ndarray) -> None:
        peaks(first, displacements)
        marks.append(process_time())

    integrate_full_order(
        body,
        BodyLoads(loads.time, applied_shapes(airframe), loads.applied_amplitudes(), loads.motion),
        airframe_damping(airframe),
        consume,
        substeps,
        block=32,
        progress=progress,
    )
    samples = 32 * (len(marks) - 2)  # the first block holds the factorisation, the last is partial
    return (marks[-2] - marks[0]) / samples, samples


def nonlinear_step(
    airframe: Airframe, case: Case, history: LandingHistory, duration: float, progress: Progress
) -> tuple[float, int]:
    """Processor seconds of one nonlinear step and the number of steps it was measured on."""
    marks: list[float] = []

    def note(step: str, share: float) -> None:
        if step == "nonlinear integration":
            marks.append(process_time())
        progress(step, share)

    nonlinear_landing(
        airframe, case.factors(airframe), history, duration=duration, substeps=1, progress=note
    )
    steps = len(marks) - 1  # the first step holds the factorisation
    return (marks[-1] - marks[0]) / steps, steps


def reduced_parts(
    airframe: Airframe, model: AssessmentModel, case: Case, loads: LandingLoads
) -> dict[str, float]:
    """Seconds of every part of the reduced path, and its peak search."""
    factors, reduced = case.factors(airframe), model.reduced
    loading, eigen = measured(lambda: assemble(reduced, factors))
    motion = loads.motion.at(reduced.origin)
    amplitudes = np.hstack([loads.applied_amplitudes(), motion.inertia_amplitudes()])
    amplitudes = amplitudes.astype(np.float32)
    step = loading.coefficients(float(loads.time[1] - loads.time[0]))
    at = np.arange(0, len(loads.time), RATE_STRIDE)

    def response_to_loads() -> tuple[np.ndarray, np.ndarray, float]:
        unit_loads = np.hstack([reduced.applied, loading.inertia]).astype(np.float32)
        shapes = unit_loads.T @ loading.modes_with_rigid

        def load(first: int, last: int, out: np.ndarray) -> None:
            np.matmul(amplitudes[first:last], shapes, out=out)

        motion = np.zeros((len(amplitudes), reduced.size), dtype=np.float32)
        return add_modal_response(step, load, motion, at)

    (moved, moving, size), recursion = measured(response_to_loads)
    coefficients, limit = motion.rate_coefficients().T[:, at], NEGLIGIBLE * SWEEP_TOLERANCE * size
    _, rate_sweep = measured(lambda: RateLoads(loading, coefficients, limit).of(moved.T, moving.T))
    response, integration = measured(lambda: landing_response(loading, loads))
    plan, planning = measured(lambda: plan_search(response.coordinates.T / reduced.stress.scale))
    _, peaks = measured(lambda: find_peaks(reduced, response))
    return {
        "assemble_and_eigen_s": eigen,
        "modal_response_s": recursion,
        "w_terms_first_sweep_s": rate_sweep,
        "w_sweeps": response.sweeps,
        "integration_s": eigen + integration,
        "peak_search_plan_s": planning,
        "peak_search_s": peaks,
        "integration_and_peaks_s": eigen + integration + peaks,
        **search_work(reduced, plan),
    }


def search_work(reduced: ReducedModel, plan: SearchPlan) -> dict[str, float]:
    """Arithmetic [Gflop] of the peak search's products, and what it reads at least once [GB]."""
    stress = reduced.stress
    leading = sum(block.shares.shape[0] * block.leading for block in stress.blocks())
    bounds = stress.pattern_norms.size + stress.rest_norms.size
    stored = stress.patterns.size + stress.shares.size + bounds
    products = stress.patterns.size * len(plan.at_grid) + (leading + bounds) * len(plan.knots)
    return {
        "search_gflop": 2e-9 * products,
        "search_gb": 1e-9 * (4 * stored + stress.shell_numbers.nbytes + stress.beam_numbers.nbytes),
    }


def integration_and_peaks(
    airframe: Airframe, reduced: ReducedModel, case: Case, end: float
) -> float:
    """Seconds of the reduced path on another landing."""
    factors, loads = case.factors(airframe), case.loads(airframe, end)
    loading, eigen = measured(lambda: assemble(reduced, factors))
    response, integration = measured(lambda: landing_response(loading, loads))
    _, peaks = measured(lambda: find_peaks(reduced, response))
    return eigen + integration + peaks


def one_by_one_and_together(
    airframe: Airframe, model: ReducedModel, factors: np.ndarray, count: int
) -> dict[str, float]:
    """Seconds of a landing, simulation included, by itself and among ``count`` of one loading.

    The landings are drawn at random; by itself each finds the modes of its loading anew.
    """
    random, aircraft = np.random.default_rng(7), airframe.landing_aircraft(factors)
    limited = SimulationOptions(time_limit=1.0, stop_when_settled=False)
    contacts: list[Contact] = []
    while len(contacts) < count:
        contact = random_contact(random)
        try:
            simulate_landing(aircraft, contact, limited)
        except SimulationDivergedError:  # harder than the gears can take
            continue
        contacts.append(contact)

    def loads_of(contact: Contact) -> LandingLoads:
        return landing_loads(airframe, simulate_landing(aircraft, contact, limited))

    def one_by_one() -> None:
        for contact in contacts:
            landing_peaks(model, factors, loads_of(contact))

    def together(floor: np.ndarray | float) -> None:
        loading = assemble(model, factors)
        for _ in peaks_of_landings(loading, map(loads_of, contacts), floor):
            pass

    for call in (one_by_one, lambda: together(0.0)):  # compiles, and reads the model
        call()
    floor = FLOOR * airframe.allowables
    return {
        "batch_landings": count,
        "one_by_one_s": least_time(one_by_one, 2) / count,
        "together_s": least_time(lambda: together(0.0), 2) / count,
        "together_with_floor_s": least_time(lambda: together(floor), 2) / count,
    }


def main(arguments: list[str] | None = None) -> None:
    """Measure, print and store under ``var/bench``."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--duration", type=float, default=1.0, help="of the landing [s]")
    parser.add_argument("--full-order", type=float, default=0.25, help="full-order part [s]")
    parser.add_argument("--fine-full-order", type=float, default=0.13, help="at fine steps [s]")
    parser.add_argument("--batch", type=int, default=32, help="landings measured of a batch")
    parser.add_argument("--nonlinear", type=float, default=0.06, help="nonlinear part [s]")
    options = parser.parse_args(arguments)
    progress, case = ConsoleProgress(), CASES[0]
    with threadpool_limits(1):
        run = Run(VAR / "verify", progress=progress)
        airframe, model = run.airframe, AssessmentModel(run.airframe, run.reduced)
        rates = machine_rates()
        aircraft = airframe.landing_aircraft(case.factors(airframe))
        limited = SimulationOptions(time_limit=options.duration, stop_when_settled=False)
        history, simulation = measured(lambda: simulate_landing(aircraft, case.contact, limited))
        loads = landing_loads(airframe, history)
        parts = reduced_parts(airframe, model, case, loads)
        record = TouchdownRecord(aircraft=model.name, contacts=(case.contact,))
        assessment, whole = measured(lambda: assess_landing(model, record))
        others = {
            f"{other.name}_integration_and_peaks_s": integration_and_peaks(
                airframe, model.reduced, other, options.duration
            )
            for other in CASES[1:]
        }
        batch = one_by_one_and_together(
            airframe, model.reduced, case.factors(airframe), options.batch
        )
        step, steps = full_order_sample(
            airframe, case, loads.until(options.full_order), 1, progress
        )
        fine, fine_samples = full_order_sample(
            airframe, case, loads.until(options.fine_full_order), ACCURATE_SUBSTEPS, progress
        )
        slow, slow_steps = nonlinear_step(airframe, case, history, options.nonlinear, progress)
    count = len(loads.time) - 1
    settled = float(assessment.histories[0].time[-1])
    figures: dict[str, float] = {
        **rates,
        "freedoms": airframe.structure.n_free,
        "elements": model.reduced.element_count,
        "coordinates": model.reduced.size,
        "landing_s": float(loads.time[-1]),
        "simulation_s": simulation,
        **parts,
        "full_order_steps_measured": steps,
        "full_order_step_s": step,
        "full_order_landing_s": step * count,
        "fine_full_order_samples_measured": fine_samples,
        "fine_full_order_landing_s": fine * count,
        "fine_full_order_over_reduced": fine * count / parts["integration_and_peaks_s"],
        "nonlinear_steps_measured": slow_steps,
        "nonlinear_step_s": slow,
        "nonlinear_landing_s": slow * count,
        "nonlinear_over_full_order": slow / step,
        "nonlinear_over_reduced": slow * count / parts["integration_and_peaks_s"],
        "full_order_over_reduced": step * count / parts["integration_and_peaks_s"],
        **others,
        **batch,
        "assessment_landing_s": settled,
        "assessment_s": whole,
    }
    folder = VAR / "bench"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "landing.json").write_text(json.dumps(figures, indent=1))
    report(figures, case)


def report(figures: dict[str, float], case: Case) -> None:
    """Print the figures as a table."""
    print(f"{case.title}; one thread, processor time, least of {REPEATS}")
    print(
        f"{figures['freedoms']:.0f} freedoms, {figures['elements']:.0f} elements, "
        f"{figures['coordinates']:.0f} reduced coordinates, {figures['landing_s']:.2f} s landing"
    )
    print(
        f"machine: {figures['product_gflop_s']:.0f} Gflop/s single-precision products, "
        f"{figures['copy_gb_s']:.1f} GB/s copies"
    )
    rows = [
        ("landing simulation", "simulation_s"),
        (
            f"nonlinear, 1 ms steps ({figures['nonlinear_steps_measured']:.0f} measured, "
            "whole landing computed)",
            "nonlinear_landing_s",
        ),
        ("  one step, stress of all elements included", "nonlinear_step_s"),
        (
            f"full order, 1 ms steps ({figures['full_order_steps_measured']:.0f} measured, "
            "whole landing computed)",
            "full_order_landing_s",
        ),
        ("  one step, stress of all elements included", "full_order_step_s"),
        (
            f"full order as accurate as the reduced, {1 / ACCURATE_SUBSTEPS:g} ms steps "
            f"({figures['fine_full_order_samples_measured']:.0f} ms measured)",
            "fine_full_order_landing_s",
        ),
        ("reduced: integration", "integration_s"),
        ("  mass of the loading and its modes", "assemble_and_eigen_s"),
        ("  modal loads and recursion, once", "modal_response_s"),
        ("  W terms, first sweep", "w_terms_first_sweep_s"),
        ("peak search, all elements", "peak_search_s"),
        ("  plan of the search", "peak_search_plan_s"),
        ("reduced: integration and peaks", "integration_and_peaks_s"),
        (
            f"whole assessment, {figures['assessment_landing_s']:.2f} s until it rolls",
            "assessment_s",
        ),
    ]
    for title, name in rows:
        print(f"  {title:<66}{figures[name] * 1e3:12.1f} ms")
    for other in CASES[1:]:
        name = f"{other.name}_integration_and_peaks_s"
        print(f"  {'the same: ' + other.title:<66}{figures[name] * 1e3:12.1f} ms")
    print(
        f"nonlinear : full order : reduced = {figures['nonlinear_over_reduced']:.0f} : "
        f"{figures['full_order_over_reduced']:.0f} : 1, at equal accuracy full order : reduced = "
        f"{figures['fine_full_order_over_reduced']:.0f} : 1, nonlinear over full order "
        f"{figures['nonlinear_over_full_order']:.1f} times"
    )
    alone = figures["one_by_one_s"]
    print(
        f"1,000 landings of one loading ({figures['batch_landings']:.0f} measured), simulation "
        f"included: one by one {1e3 * alone:.1f} ms each, together "
        f"{1e3 * figures['together_s']:.1f} ms ({alone / figures['together_s']:.1f} times faster), "
        f"with floors at {FLOOR:.0%} of the allowables "
        f"{1e3 * figures['together_with_floor_s']:.1f} ms "
        f"({alone / figures['together_with_floor_s']:.1f} times)"
    )
    whole = figures["simulation_s"] + figures["integration_and_peaks_s"]
    print(
        f"simulation, integration and peaks: {1e3 * whole:.1f} ms, the time of "
        f"{whole * figures['product_gflop_s']:.1f} Gflop of products"
    )
    arithmetic = figures["search_gflop"] / figures["product_gflop_s"]
    reading = figures["search_gb"] / figures["copy_gb_s"]
    print(
        f"the peak search takes {figures['peak_search_s'] / max(arithmetic, reading):.1f} times "
        "the larger of its two limits"
    )
    print(
        f"limit: the products of the peak search are {figures['search_gflop']:.1f} Gflop, "
        f"{1e3 * figures['search_gflop'] / figures['product_gflop_s']:.0f} ms at this machine's "
        f"rate; reading what it reads once, {figures['search_gb'] * 1e3:.0f} MB, takes "
        f"{1e3 * figures['search_gb'] / figures['copy_gb_s']:.0f} ms"
    )


if __name__ == "__main__":
    _start = perf_counter()
    main()
    print(f"{perf_counter() - _start:.0f} s in all")
