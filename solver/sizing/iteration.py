"""Sizing of the example aircraft: gauges by the fully-stressed-design ratio method.

    python -m solver.sizing [--sweeps N]

Every bay's thickness or area is multiplied by (utilisation / target)^p, within a largest step and
above its minimum gauge, until no bay asks for a change.  Stresses come from inertia relief at every
sample of the design cases; landings are magnified, element by element, by what the reduced dynamic
analysis of the same landings gave last.  Panels must not buckle, either, and the larger of both
gauges is taken.  The result is ``bizjet/sized.toml``.

Source: Gallagher and Zienkiewicz, Optimum Structural Design (1973), chapter 3 (stress ratio).
"""

import argparse
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from solver.aircraft.airframe import Airframe, load_airframe
from solver.aircraft.bizjet.build import mesh_bizjet, write_bizjet
from solver.aircraft.bizjet.catalogue import SIZED, Bay, read_gauges, write_gauges
from solver.aircraft.bizjet.families import FAMILY
from solver.arrays import Array
from solver.inertia_relief.basis import BasisSettings
from solver.progress import Progress, silent
from solver.sizing.cases import AppliedLoads, design_cases
from solver.sizing.stress import StaticUtilisations, dynamic_utilisations, static_utilisations

TARGET = 0.95  #: utilisation of a fully stressed bay: margin of safety 0.05
KEPT = (0.92, 0.955)  #: a bay with its utilisation in this range is left alone
#: Between membrane (1) and bending (1/2 for a plate, 2/3 for a similar beam); a beam that grows
#: draws load, so beams are hurried on.
EXPONENT = {False: 0.8, True: 1.0}
#: The critical factor of a panel grows with the cube of its gauge where its load is given.
PANEL_EXPONENT = 0.4
#: Factor on the loads up to which panels must not buckle.  On the ground it is that of ultimate
#: loads, 14 CFR 25.303: verdicts rest on linear stress, which is none in a buckled panel, and must
#: hold beyond limit loads to tell how far a landing went beyond them.
GROUND_RESERVE, FLIGHT_RESERVE = 1.5, 1.0
LARGEST_STEP = 1.4  #: factor on a gauge in one sweep
STEPS = {False: 0.05e-3, True: 2e-6}  #: gauges are multiples of these: shells [m], beams [m2]
#: Largest gauge over the family's first one.
LARGEST_GROWTH = 5.0
#: A lighter basis than assessments use: it only has to magnify.
DYNAMIC_BASIS = BasisSettings(modes=60, harmonic_states=((110.0, (0.5,)), (150.0, (0.5,))))
#: Range of the dynamic magnification: a cabin floor near the spring-back frequency has seven.
MAGNIFICATION = (0.5, 20.0)
#: Below this utilisation a ratio of peaks tells nothing.
TELLING = 0.15
#: Last sweeps, in which gauges only grow: a bay whose magnification is told in every other sweep
#: stays with the heavier of its gauges.
SETTLING = 4
#: Sweeps between dynamic analyses.
DYNAMIC_INTERVAL = 2


@dataclass(frozen=True, slots=True)
class Sized:
    """One airframe of the iteration and what it must carry."""

    airframe: Airframe
    cases: list[AppliedLoads]
    bays: list[Bay]  #: of every element
    structural_mass: float  #: of shells and beams [kg]


def sized_airframe(gauges: Mapping[Bay, float], refinement: float = 1.0) -> Sized:
    """Build the airframe with these gauges, and its design cases."""
    parts, groups = mesh_bizjet(refinement, gauges)
    with tempfile.TemporaryDirectory() as name:
        write_bizjet(parts, groups, Path(name), refinement)
        airframe = load_airframe(Path(name))
    used = parts.mesh.catalogue.used
    bays = [used[int(number)] for number in airframe.structure.model.element_properties]
    lumped = airframe.structure.model.point_masses.masses.sum()
    mass = airframe.structure.inertia.rigid_body_properties().mass - float(lumped)
    return Sized(airframe, design_cases(airframe), bays, mass)


def magnification(cases: list[AppliedLoads], static: Array, dynamic: Array) -> Array:
    """Dynamic over quasi-static peak of every element (ne,), over all simulated landings."""
    landings = [k for k, case in enumerate(cases) if case.landing is not None]
    still, moving = static[landings].max(axis=0), dynamic[landings].max(axis=0)
    telling = np.maximum(still, moving) > TELLING
    ratio = np.where(telling, moving / np.maximum(still, 1e-12), 1.0)
    return np.clip(ratio, *MAGNIFICATION)


def magnified(cases: list[AppliedLoads], static: Array, factors: Array) -> Array:
    """Utilisations (n_cases, ne) with the landings magnified."""
    landing = np.array([case.landing is not None for case in cases])
    return np.where(landing[:, None], static * factors, static)


def bay_utilisations(bays: list[Bay], utilisation: Array) -> dict[Bay, float]:
    """Worst utilisation of each bay, over both sides."""
    worst: dict[Bay, float] = {}
    for bay, value in zip(bays, utilisation, strict=True):
        worst[bay] = max(worst.get(bay, 0.0), float(value))
    return worst


def asked_of_bays(
    sized: Sized, found: StaticUtilisations, factors: Array
) -> tuple[dict[Bay, float], dict[Bay, float]]:
    """Worst utilisation of each bay in stress, and in buckling of its panels."""
    stress = magnified(sized.cases, found.stress, factors).max(axis=0)
    reserve = [FLIGHT_RESERVE if case.in_flight else GROUND_RESERVE for case in sized.cases]
    panels = np.array(reserve)[:, None] * magnified(sized.cases, found.panels, factors)
    return (
        bay_utilisations(sized.bays, stress),
        bay_utilisations(sized.bays, panels.max(axis=0)),
    )


def resized(bay: Bay, gauge: float, utilisation: float, exponent: float | None = None) -> float:
    """Next gauge of a bay, on the grid of gauges and within its limits.

    The exponent is that of stress if not given.
    """
    if KEPT[0] <= utilisation <= KEPT[1]:
        return gauge
    family = FAMILY[bay.family]
    power = EXPONENT[family.is_beam] if exponent is None else exponent
    factor = (max(utilisation, 1e-6) / TARGET) ** power
    factor = min(max(factor, 1 / LARGEST_STEP), LARGEST_STEP)
    wanted = min(max(gauge * factor, family.minimum), LARGEST_GROWTH * family.gauge)
    step = STEPS[family.is_beam]
    return float(np.ceil(round(wanted / step, 6)) * step)


def size(
    sweeps: int = 15,
    refinement: float = 1.0,
    table: Path = SIZED,
    progress: Progress = silent,
) -> dict[Bay, float]:
    """Iterate from the gauges of ``table`` (without one, the families'); writes it every sweep."""
    gauges: dict[Bay, float] = read_gauges(table)
    factors: Array | None = None
    for sweep in range(sweeps):
        sized = sized_airframe(gauges, refinement)
        found = static_utilisations(sized.airframe, sized.cases)
        if sweep % DYNAMIC_INTERVAL == 0:
            dynamic = dynamic_utilisations(sized.airframe, sized.cases, DYNAMIC_BASIS)
            factors = magnification(sized.cases, found.stress, dynamic)
        assert factors is not None  # noqa: S101 - the first sweep has set it
        worst, weakest = asked_of_bays(sized, found, factors)
        mass = sized.structural_mass
        gauges = {bay: gauges.get(bay, FAMILY[bay.family].gauge) for bay in sorted(worst, key=str)}
        critical = max(worst.items(), key=lambda item: item[1])
        updated = {
            bay: max(
                resized(bay, gauges[bay], worst[bay]),
                resized(bay, gauges[bay], weakest[bay], PANEL_EXPONENT),
            )
            for bay in gauges
        }
        if sweep >= sweeps - SETTLING:
            updated = {bay: max(gauge, gauges[bay]) for bay, gauge in updated.items()}
        change = max(abs(updated[bay] / gauges[bay] - 1) for bay in gauges)
        above = sum(value > 1.0 for value in worst.values())
        buckling = sum(value > 1.0 for value in weakest.values())
        progress(
            f"sweep {sweep}: worst {critical[1]:.3f} ({critical[0]}), {above} bays above 1, "
            f"{buckling} buckle, the first at {1 / max(weakest.values()):.2f} of the loads asked, "
            f"largest change {change:.1%}, structure {mass:.0f} kg",
            (sweep + 1) / sweeps,
        )
        gauges = updated
        write_gauges(gauges, table)
    return gauges


def _say(step: str, share: float) -> None:
    sys.stdout.write(f"{share:5.0%}  {step}\n")
    sys.stdout.flush()


def main() -> None:
    """Size the example aircraft and write its table."""
    parser = argparse.ArgumentParser(description="Size the example aircraft.")
    parser.add_argument("--sweeps", type=int, default=15)
    arguments = parser.parse_args()
    size(arguments.sweeps, progress=_say)
