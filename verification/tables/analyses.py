"""The same landing three ways: nonlinear, extended inertia relief at full order and reduced.

Nonlinear and full order take the same steps with rules that agree for small motion, and have the
same damping, so that what they differ by is geometry.  The reduced recursion is exact between the
samples of the loads.
"""

from dataclasses import dataclass
from time import process_time

import numpy as np

from solver.aircraft.airframe import Airframe
from solver.arrays import Array, IntArray, Single
from solver.frames import rotation_matrix
from solver.inertia_relief.build import airframe_damping
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.full_order import BodyLoads, integrate_full_order
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import applied_shapes
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.response import landing_response
from solver.nonlinear.landing import nonlinear_landing
from solver.nonlinear.loads import structural_attitude
from verification.run import ROOT, Run
from verification.tables.landings import Landed
from verification.tables.recorder import LinearRecorder

#: Steps between two samples, of the nonlinear analysis and of the full order.
SUBSTEPS = 2

#: What the full order rests on beside its loads.
FULL_ORDER_SOURCES = (
    "solver/fe",
    "solver/aircraft",
    "verification/tables/recorder.py",
    *(
        f"solver/inertia_relief/{name}.py"
        for name in (
            "damping", "factor", "free_body", "full_order", "loads", "motion", "rate_terms",
            "static",
        )
    ),
)  # fmt: skip
#: Statics and buckling take no part in a landing.
NONLINEAR_SOURCES = (
    "solver/fe",
    "solver/aircraft",
    *(
        f"solver/nonlinear/{path.name}"
        for path in sorted((ROOT / "solver" / "nonlinear").glob("*.py"))
        if path.stem not in ("static", "buckling")
    ),
    *(
        f"solver/inertia_relief/{name}.py"
        for name in ("damping", "factor", "free_body", "loads", "motion", "static")
    ),
)


@dataclass(frozen=True, slots=True)
class Analysis:
    """Stresses of one landing by one analysis; von Mises [Pa], elements in the solver's order."""

    peak: Array  #: (ne,) over all samples
    largest: Array  #: (nt,) of all elements
    element: IntArray  #: (nt,) where that is
    fields: Array  #: (nw, ne) at `Landed.wanted`
    seconds: float  #: processor time


@dataclass(frozen=True, slots=True)
class Nonlinear:
    """A nonlinear analysis and what shows how well it was solved."""

    stress: Analysis
    iterations: float  #: evaluations of the internal forces in a step
    energy_error: float
    momentum_error: float
    drift: Array  #: (nt,) angle between its mean frame and the rigid aircraft [rad]


@dataclass(frozen=True, slots=True)
class FullOrder:
    """Extended inertia relief at full order and its membrane state."""

    stress: Analysis
    compression: Array  #: (nw, n_shells) see `LinearRecorder`
    displacements: Array  #: (nw, n_free) in the mean-axis frame [m, rad]


def nonlinear(run: Run, airframe: Airframe, landed: Landed) -> Nonlinear:
    """Follow the landing by nonlinear dynamics; the result is stored and resumable."""
    loads, name = landed.loads, f"tables-nonlinear-{landed.case.name}"
    damping = airframe_damping(airframe)

    def compute() -> dict[str, Array]:
        start = process_time()
        found = nonlinear_landing(
            airframe,
            landed.factors,
            landed.history,
            duration=float(loads.time[-1]),
            substeps=SUBSTEPS,
            stress_times=loads.time[landed.wanted].tolist(),
            damping=damping,
            checkpoint=run.folder / "results" / f"{name}.checkpoint.npz",
            progress=lambda step, share: run.progress(f"{landed.case.name}: {step}", share),
        )
        # What was spent before an interruption is only in the report.
        seconds = max(process_time() - start, found.report.seconds)
        return {
            "peak": found.peak_stress,
            "largest": found.largest_stress,
            "element": found.largest_element,
            "fields": found.stress,
            "seconds": np.array(seconds),
            "iterations": np.array(found.report.iterations / found.report.steps),
            "energy_error": np.array(found.energy_error),
            "momentum_error": found.momentum_error.max(),
            "turn": found.turn,
        }

    kept = run.stored(name, _inputs(airframe, landed), NONLINEAR_SOURCES, compute)
    return Nonlinear(
        _analysis(kept),
        float(kept["iterations"]),
        float(kept["energy_error"]),
        float(kept["momentum_error"]),
        _drift(kept["turn"], landed),
    )


def full_order(run: Run, airframe: Airframe, landed: Landed) -> FullOrder:
    """Follow the landing by extended inertia relief with every freedom; the result is stored."""
    loads = landed.loads

    def compute() -> dict[str, Array]:
        start = process_time()
        record = LinearRecorder(airframe.recovery, len(loads.time), landed.wanted)
        integrate_full_order(
            free_body(airframe.structure, airframe.inertia(landed.factors)),
            BodyLoads(
                loads.time, applied_shapes(airframe), loads.applied_amplitudes(), loads.motion
            ),
            airframe_damping(airframe),
            record,
            SUBSTEPS,
            progress=lambda step, share: run.progress(f"{landed.case.name}: {step}", share),
        )
        return {
            "peak": record.peak,
            "largest": record.largest,
            "element": record.element,
            "fields": record.fields,
            "seconds": np.array(process_time() - start),
            "compression": record.compression,
            "displacements": record.displacements,
        }

    name = f"tables-full-order-{landed.case.name}"
    kept = run.stored(name, _inputs(airframe, landed), FULL_ORDER_SOURCES, compute)
    return FullOrder(_analysis(kept), kept["compression"], kept["displacements"])


def reduced(model: ReducedModel, landed: Landed) -> Analysis:
    """Follow the landing in reduced coordinates; the time is that of integration and peaks."""
    for _ in range(2):  # the first call compiles
        start = process_time()
        response = landing_response(assemble(model, landed.factors), landed.loads)
        peaks = find_peaks(model, response)
        seconds = process_time() - start
    count = len(landed.loads.time)
    largest, element = np.zeros(count), np.zeros(count, dtype=np.int64)
    for first in range(0, count, 50):
        part = slice(first, first + 50)
        stress = reduced_stress(model, response.coordinates[:, part])
        largest[part], element[part] = stress.max(axis=0), stress.argmax(axis=0)
    fields = reduced_stress(model, response.coordinates[:, landed.wanted]).T
    return Analysis(peaks.stress, largest, element, fields, seconds)


def reduced_stress(model: ReducedModel, coordinates: Array | Single) -> Array:
    """Von Mises stress (ne, k) of all elements at coordinates (m, k) of a reduced model [Pa]."""
    stress, size = model.stress, len(coordinates)
    scaled = (coordinates / stress.scale[:, None]).astype(np.float32)
    shells = stress.shell_rows.exact().reshape(-1, size) @ scaled
    faces = (shells.reshape(-1, 2, 3, scaled.shape[1]) ** 2).sum(axis=2).max(axis=1)
    rows = stress.beam_rows.exact().reshape(-1, size) @ scaled
    rows = rows.reshape(-1, 6, scaled.shape[1])
    normal = np.asarray(stress.beam_points) @ rows[:, :5]
    points = (normal**2).max(axis=1) + rows[:, 5] ** 2
    return np.sqrt(np.concatenate([faces, points]).astype(np.float64))


def _inputs(airframe: Airframe, landed: Landed) -> list[object]:
    loads = landed.loads
    return [
        airframe.content_hash, landed.factors, airframe_damping(airframe), SUBSTEPS, loads.time,
        loads.applied_amplitudes(), loads.motion, landed.wanted,
    ]  # fmt: skip


def _analysis(kept: dict[str, Array]) -> Analysis:
    return Analysis(
        peak=kept["peak"],
        largest=kept["largest"],
        element=kept["element"].astype(np.int64),
        fields=kept["fields"],
        seconds=float(kept["seconds"]),
    )


def _drift(turn: Array, landed: Landed) -> Array:
    expected = rotation_matrix(structural_attitude(landed.history.attitude[: len(turn)]))
    between = np.einsum("tij,tij->t", turn, expected)
    # The angle's sine, as its cosine says nothing about small ones.
    apart = np.linalg.norm(turn - expected, axis=(1, 2)) / np.sqrt(8.0)
    return np.where(between > 0, 2.0 * np.arcsin(np.clip(apart, 0.0, 1.0)), np.pi)
