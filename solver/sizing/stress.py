"""Utilisations of the airframe under its design cases, by inertia relief and dynamically."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from solver.aircraft.airframe import Airframe
from solver.arrays import Array
from solver.inertia_relief.basis import BasisSettings
from solver.inertia_relief.build import reduced_model
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import applied_shapes
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.response import landing_response
from solver.inertia_relief.static import inertia_relief
from solver.progress import Progress, silent
from solver.sizing.cases import LOADINGS, AppliedLoads, fill_factors
from solver.sizing.panels import panels

#: Samples whose stress is evaluated together.
BLOCK = 64


@dataclass(frozen=True, slots=True)
class StaticUtilisations:
    """What the design cases ask of every element by inertia relief."""

    stress: Array  #: (n_cases, ne) largest stress over the allowable
    panels: Array  #: (n_cases, ne) one over the critical factor of shells; zero for beams


def static_utilisations(
    airframe: Airframe, cases: Sequence[AppliedLoads], progress: Progress = silent
) -> StaticUtilisations:
    """Largest utilisations of every element in every case by inertia relief."""
    shapes = applied_shapes(airframe)
    result = np.zeros((len(cases), len(airframe.allowables)))
    buckled = np.zeros_like(result)
    plates = panels(airframe.structure.model)
    for loading in LOADINGS:
        chosen = [k for k, case in enumerate(cases) if case.loading == loading.name]
        if not chosen:
            continue
        inertia = airframe.inertia(fill_factors(airframe, loading))
        relief = inertia_relief(free_body(airframe.structure, inertia))
        displacement = relief.displacement(shapes)
        shell = airframe.recovery.shell_operator @ displacement
        beam = airframe.recovery.beam_operator @ displacement
        for k in chosen:
            progress(cases[k].name, k / len(cases))
            amplitudes = cases[k].amplitudes
            for first in range(0, len(amplitudes), BLOCK):
                block = amplitudes[first : first + BLOCK].T
                rows = shell @ block
                stress = airframe.recovery.von_mises(rows, beam @ block).max(axis=1)
                result[k] = np.maximum(result[k], stress / airframe.allowables)
                faces = rows.reshape(-1, 2, 3, block.shape[1])
                used = plates.utilisation(faces.mean(axis=1)).max(axis=1)
                buckled[k, : len(used)] = np.maximum(buckled[k, : len(used)], used)
    return StaticUtilisations(result, buckled)


def dynamic_utilisations(
    airframe: Airframe,
    cases: Sequence[AppliedLoads],
    settings: BasisSettings,
    progress: Progress = silent,
) -> Array:
    """Largest utilisation of every element in every simulated landing, (n_cases, ne).

    Reduced extended inertia relief over the whole landing; zero for the other cases.
    """
    model = reduced_model(airframe, settings=settings, progress=progress)
    result = np.zeros((len(cases), len(airframe.allowables)))
    assembled = {
        loading.name: assemble(model, fill_factors(airframe, loading)) for loading in LOADINGS
    }
    for k, case in enumerate(cases):
        if case.landing is not None:
            response = landing_response(assembled[case.loading], case.landing)
            result[k] = find_peaks(model, response).stress / airframe.allowables
    return result
