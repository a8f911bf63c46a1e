"""Response of the reduced airframe to a landing: exact modal recursion, W terms by sweeps.

The W terms of eq (15) couple the modes weakly.  They are taken as pseudo loads of the previous
sweep over the whole landing (waveform relaxation), as one matrix product per sweep, until a sweep
changes nothing beyond the stated tolerance; the k-th sweep is of the order (rate / w)^k.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.errors import ModelError
from solver.inertia_relief.loading import ReducedLoading
from solver.inertia_relief.loads import LandingLoads, equilibrium_residual
from solver.inertia_relief.modal_recursion import StepCoefficients, modal_response
from solver.inertia_relief.rate_loads import RateLoads

#: Largest change by the last sweep, relative to the largest displacement, strain-energy norm.
SWEEP_TOLERANCE = 1e-3
#: Share of the tolerance that the pseudo loads of a sweep may leave out.
NEGLIGIBLE = 0.5
MAXIMUM_SWEEPS = 30


@dataclass(frozen=True, slots=True)
class ReducedResponse:
    """Elastic motion of a landing."""

    time: Array  #: (nt,) [s]
    coordinates: Array  #: (m, nt) in the model's K-orthonormal basis
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
    coordinates = (modes @ response.astype(np.float32)).astype(np.float64)
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
    size = _largest(total)
    loads = RateLoads(loading, rate_coefficients, NEGLIGIBLE * tolerance * size)
    for sweep in range(1, MAXIMUM_SWEEPS + 1):
        pseudo = loads.of(displacement, velocity)
        displacement, velocity = modal_response(step, pseudo, pseudo[:, 0])
        total += displacement
        change = _largest(displacement) / size
        if change <= tolerance:
            return total, sweep, change
        if not np.isfinite(change):
            break
    raise ModelError(f"the W terms did not converge in {MAXIMUM_SWEEPS} sweeps")


def _largest(field: Array) -> float:
    """Largest strain-energy norm over time of (m, nt) modal coordinates."""
    return float(np.sqrt(np.einsum("ij,ij->j", field, field).max()))
