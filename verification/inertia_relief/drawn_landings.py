"""Landings and loadings drawn at random, by full order and reduced.

The landings of a loading are integrated side by side, so that they share the factors, and at
several step sizes, whose limit the reduced peaks are held against.
"""

from dataclasses import dataclass
from time import process_time

import numpy as np

from solver.arrays import Array
from solver.errors import SimulationDivergedError
from solver.inertia_relief.build import airframe_damping
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.full_order import BodyLoads
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import LandingLoads, applied_shapes
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.response import landing_response
from solver.landing.contact import Contact
from verification.inertia_relief.landings import random_contact, simulated_loads
from verification.inertia_relief.time_converged import ConvergedPeaks, converged_peaks
from verification.run import Run

SEED = 1523
#: Change of the W terms between iterations, relative to the load, where iteration stops.
TOLERANCE = 1e-6

#: What full-order peaks rest on beside their loads.
FULL_ORDER_SOURCES = (
    "solver/fe",
    "solver/aircraft",
    *(
        f"solver/inertia_relief/{name}.py"
        for name in (
            "accumulate",
            "damping",
            "factor",
            "free_body",
            "full_order",
            "loads",
            "motion",
            "rate_terms",
            "static",
        )
    ),
)


@dataclass(frozen=True, slots=True)
class DrawnLanding:
    """One landing by both ways."""

    loading: int  #: number of the loading
    mass: float  #: [kg]
    contact: Contact
    full: Array  #: (ne,) full order, in the limit of small steps [Pa]
    full_error: Array  #: (ne,) of that limit, estimated, relative
    fast: Array  #: (ne,) reduced [Pa]

    def worst(self, share: float) -> float:
        """Largest relative difference of elements above a share of the largest peak."""
        stressed = self.full > share * self.full.max()
        return float(np.abs(self.fast / self.full - 1)[stressed].max())


def drawn_landings(
    run: Run, loadings: int, landings: int, duration: float, substeps: tuple[int, ...]
) -> list[DrawnLanding]:
    """Draw, integrate by both ways, and compare; ``landings`` of each of ``loadings``.

    A touchdown that cannot be simulated (harder than the gears can take) is drawn again.

    Parameters
    ----------
    substeps : tuple of int
        Full-order steps between two samples, see `converged_peaks`.
    """
    found = []
    for number in range(loadings):
        random = np.random.default_rng((SEED, number))
        factors = random.uniform(0.0, 1.0, len(run.airframe.groups))
        drawn = [_draw(run, factors, random, duration) for _ in range(landings)]
        loads = [each for _, each in drawn]
        full = _full_order(run, number, factors, loads, substeps)
        loading = assemble(run.reduced, factors)
        for k, (contact, each) in enumerate(drawn):
            fast = find_peaks(run.reduced, landing_response(loading, each)).stress
            found.append(
                DrawnLanding(number, loading.mass, contact, full.stress[k], full.error[k], fast)
            )
    return found


def _draw(
    run: Run, factors: Array, random: np.random.Generator, duration: float
) -> tuple[Contact, LandingLoads]:
    while True:
        contact = random_contact(random)
        try:
            return contact, simulated_loads(run.airframe, factors, contact, duration)
        except SimulationDivergedError:
            continue


def _full_order(
    run: Run,
    number: int,
    factors: Array,
    landings: list[LandingLoads],
    substeps: tuple[int, ...],
) -> ConvergedPeaks:
    """Peaks of the full-order integration."""
    airframe = run.airframe
    damping = airframe_damping(airframe)

    def compute() -> dict[str, Array]:
        start = process_time()
        shapes = applied_shapes(airframe)
        peaks = converged_peaks(
            free_body(airframe.structure, airframe.inertia(factors)),
            [
                BodyLoads(loads.time, shapes, loads.applied_amplitudes(), loads.motion)
                for loads in landings
            ],
            damping,
            airframe.recovery,
            substeps,
            TOLERANCE,
            progress=lambda step, share: run.progress(f"loading {number + 1}: {step}", share),
        )
        return {
            "stress": peaks.stress,
            "error": peaks.error,
            "seconds": np.array(process_time() - start),
        }

    inputs = [
        airframe.content_hash, factors, damping, substeps, TOLERANCE, landings,
    ]  # fmt: skip
    sources = (*FULL_ORDER_SOURCES, "verification/inertia_relief/time_converged.py")
    found = run.stored(f"full-order-drawn-{number + 1}", inputs, sources, compute)
    return ConvergedPeaks(found["stress"], found["error"])
