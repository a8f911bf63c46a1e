"""Building a reduced model from an airframe, once, cached under the hash of what it rests on."""

import hashlib
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Array, Single
from solver.inertia_relief.basis import BasisSettings, build_basis, mass_state
from solver.inertia_relief.compression import compressed, principal_axes
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.loads import applied_shapes
from solver.inertia_relief.motion_measure import motion_measure
from solver.inertia_relief.projection import projected_inertia
from solver.inertia_relief.reduced import FORMAT, ReducedModel, load_reduced_model, rate_norms
from solver.inertia_relief.reduced_stress import no_stress
from solver.inertia_relief.reference_landings import reference_motions
from solver.inertia_relief.stress_rows import reduced_stress_rows
from solver.progress import Progress, silent

if TYPE_CHECKING:
    from solver.aircraft.airframe import Airframe
    from solver.aircraft.assessed_airframe import AssessedAirframe
    from solver.fe.inertia import Inertia
    from solver.fe.stress import StressRecovery
    from solver.fe.structure import Structure

#: Coordinates of usual landings, see `project`.
Motions = Callable[[ReducedModel], list[Single]]


def project(
    structure: "Structure",
    base: "Inertia",
    groups: "tuple[Inertia, ...]",
    applied: Array,
    recovery: "StressRecovery",
    basis: Array,
    damping: RayleighDamping,
    key: str = "",
    motions: Motions = lambda _: [],
    progress: Progress = silent,
) -> ReducedModel:
    """Project inertia, loads and stress on a K-orthonormal ``basis`` (n, m) and the rigid modes.

    Parameters
    ----------
    motions : callable
        Gives the coordinates (m, nt) of usual landings with a model that has no stress yet.  They
        choose the axes in the space of the basis and how the stress is compressed.
    """
    parts = (base, *groups)
    origin = mass_state(base, groups).rigid_body_properties().centre_of_gravity
    full = np.hstack([structure.rigid_modes(origin), basis])
    basis = full[:, 6:]  # on a large airframe each copy takes gigabytes
    masses, operators, inertial = [], [], []
    for index, part in enumerate(parts):
        progress("projection", index / (len(parts) + 1))
        mass, terms = projected_inertia(part, full)
        masses.append(mass)
        operators.append(np.ascontiguousarray(terms.transpose(0, 2, 1), dtype=np.float32))
        inertial.append(full.T @ part.rigid_load_shapes(origin))
    progress("projection", 1.0)
    rates = np.stack(operators)
    model = ReducedModel(
        key=key,
        damping=damping,
        origin=origin,
        mass=np.stack(masses),
        rate_operators=rates,
        rate_norms=rate_norms(rates),
        applied=full.T @ applied,
        inertia=np.stack(inertial),
        stress=no_stress(basis.shape[1]),
    )
    axes, spread = principal_axes(
        motions(model), model.size, lambda moved: motion_measure(recovery, basis, moved)
    )
    progress("compression", 0.0)
    rows = reduced_stress_rows(recovery, basis @ axes)
    stress = compressed(rows, spread)
    progress("compression", 1.0)
    return replace(model.turned(axes), stress=stress)


def model_key(content_hash: str, settings: BasisSettings, damping: RayleighDamping) -> str:
    """Hash of the airframe's content and of everything that shapes its reduced model."""
    values = [sorted(asdict(part).items()) for part in (settings, damping)]
    return hashlib.sha256(f"{content_hash} {FORMAT} {values}".encode()).hexdigest()


def stored_model(
    airframe: "AssessedAirframe",
    cache: Path,
    settings: BasisSettings = BasisSettings(),  # noqa: B008 - frozen
    damping: RayleighDamping | None = None,
) -> ReducedModel | None:
    """Map the reduced model of ``airframe`` from ``cache``; None if it is not there."""
    damping = airframe_damping(airframe) if damping is None else damping
    key = model_key(airframe.content_hash, settings, damping)
    return load_reduced_model(_folder(cache, key), key)


def reduced_model(
    airframe: "Airframe",
    cache: Path | None = None,
    settings: BasisSettings = BasisSettings(),  # noqa: B008 - frozen
    damping: RayleighDamping | None = None,
    progress: Progress = silent,
) -> ReducedModel:
    """Reduced model of ``airframe`` from ``cache``, built and stored there on first use.

    Parameters
    ----------
    cache : Path, optional
        Folder of models, one folder for each key; without it the model is built in memory.
    damping : RayleighDamping, optional
        By default the ratio of the aircraft definition, see `airframe_damping`.
    """
    damping = airframe_damping(airframe) if damping is None else damping
    key = model_key(airframe.content_hash, settings, damping)
    if cache is not None:
        stored = stored_model(airframe, cache, settings, damping)
        if stored is not None:
            return stored
    structure = airframe.structure
    groups = tuple(group.inertia for group in airframe.groups)
    applied = applied_shapes(airframe)
    model = project(
        structure,
        structure.inertia,
        groups,
        applied,
        airframe.recovery,
        build_basis(structure, structure.inertia, groups, applied, settings, progress),
        damping,
        key,
        lambda model: reference_motions(airframe, model, progress),
        progress,
    )
    if cache is None:
        return model
    model.save(_folder(cache, key))
    return load_reduced_model(_folder(cache, key), key) or model


def _folder(cache: Path, key: str) -> Path:
    return cache / key[:16]


def airframe_damping(airframe: "AssessedAirframe") -> RayleighDamping:
    """Damping of the aircraft definition, held at the two frequencies of `RayleighDamping`."""
    return RayleighDamping(ratio=airframe.definition.modal_damping_ratio)
