"""Response of the reduced airframe to a landing: exact modal recursion, W terms by sweeps.

The W terms of eq (15) couple the modes weakly.  They are taken as pseudo loads of the previous
sweep over the whole landing (waveform relaxation), as one matrix product per sweep, until a sweep
changes nothing beyond the stated tolerance; the k-th sweep is of the order (rate / w)^k.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array, IntArray, Single
from solver.errors import ModelError
from solver.inertia_relief.loading import ReducedLoading
from solver.inertia_relief.loads import LandingLoads, equilibrium_residual
from solver.inertia_relief.modal_recursion import StepCoefficients, modal_response
from solver.inertia_relief.rate_loads import RateLoads

#: Largest change by the last sweep, relative to the largest displacement, strain-energy norm.
SWEEP_TOLERANCE = 1e-3
#: Samples between two at which the W terms are evaluated; between them they are straight.
RATE_STRIDE = 2
#: Share of the tolerance that the pseudo loads of a sweep may leave out.
NEGLIGIBLE = 0.5
#: A further sweep is left out if, shrinking as the last one did, it would change by this factor
#: less than the tolerance.
CAUTION = 10.0
MAXIMUM_SWEEPS = 30


@dataclass(frozen=True, slots=True)
class ReducedResponse:
    """Elastic motion of a landing."""

    time: Array  #: (nt,) [s]
    coordinates: Single  #: (m, nt), sample by sample in memory, in the model's K-orthonormal basis
    sweeps: int  #: of the W terms
    last_change: float  #: of the last sweep, see `SWEEP_TOLERANCE`
    equilibrium_residual: float  #: see `equilibrium_residual`


def landing_response(
    loading: ReducedLoading, loads: LandingLoads, tolerance: float = SWEEP_TOLERANCE
) -> ReducedResponse:
    """Integrate the reduced eq (15) from its steady state, on the loads' own time grid.

    Raises
    ------
    EquilibriumError
        The loads do not balance the motion; see `solver.inertia_relief.loads`.
    ModelError
        The sweeps of the W terms do not converge.
    """
    model = loading.model
    motion = loads.motion.at(model.origin)
    applied, inertial = loads.applied_amplitudes(), motion.inertia_amplitudes()
    residual = equilibrium_residual(
        loading.rigid_transfer @ model.applied[:6],
        applied,
        loading.rigid_transfer @ loading.inertia[:6],
        inertial,
        loading.mass * np.linalg.norm(motion.gravity, axis=1),
        loading.gyration_radius,
    )
    shapes = loading.modes_with_rigid.T @ np.hstack([model.applied, loading.inertia])
    load = shapes @ np.hstack([applied, inertial]).T
    step = loading.coefficients(float(loads.time[1] - loads.time[0]))
    response, sweeps, change = swept_response(
        loading, step, load, motion.rate_coefficients().T, tolerance
    )
    modes = loading.modes.astype(np.float32)
    coordinates: Single = (response.T.astype(np.float32) @ modes.T).T
    return ReducedResponse(loads.time, coordinates, sweeps, change, residual)


def swept_response(
    loading: ReducedLoading,
    step: StepCoefficients,
    load: Array,
    rate_coefficients: Array,
    tolerance: float,
) -> tuple[Array, int, float]:
    """Modal response (m, nt) to modal loads with all W terms, the sweeps and the last change."""
    displacement, velocity = modal_response(step, load, load[:, 0])
    total = displacement
    if not np.any(rate_coefficients):
        return total, 0, 0.0
    size, change = _largest(total), 1.0
    at = np.arange(0, load.shape[1], RATE_STRIDE)
    if at[-1] != load.shape[1] - 1:
        at = np.append(at, load.shape[1] - 1)
    loads = RateLoads(loading, rate_coefficients[:, at], NEGLIGIBLE * tolerance * size)
    for sweep in range(1, MAXIMUM_SWEEPS + 1):
        some = loads.of(displacement[:, at], velocity[:, at])
        if not np.any(some):
            return total, sweep, 0.0
        pseudo = _between(some, at)
        displacement, velocity = modal_response(step, pseudo, pseudo[:, 0])
        total += displacement
        before, change = change, _largest(displacement) / size
        # the next sweep would change by another such factor
        if change <= tolerance or CAUTION * change**2 <= tolerance * before:
            return total, sweep, change
        if not np.isfinite(change):
            break
    raise ModelError(f"the W terms did not converge in {MAXIMUM_SWEEPS} sweeps")


def _largest(field: Array) -> float:
    """Largest strain-energy norm over time of (m, nt) modal coordinates."""
    return float(np.sqrt(np.einsum("ij,ij->j", field, field).max()))


def _between(some: Array, at: IntArray) -> Array:
    """History (m, nt) that is straight between samples ``at``, no more than two apart."""
    every = np.empty((len(some), at[-1] + 1))
    every[:, at] = some
    between = np.flatnonzero(np.diff(at) > 1)
    every[:, at[between] + 1] = (some[:, between] + some[:, between + 1]) / 2
    return every
