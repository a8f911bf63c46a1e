"""Response of the reduced airframe to a landing: exact modal recursion, W terms by sweeps.

The W terms of eq (15) couple the modes weakly.  They are taken as pseudo loads of the previous
sweep over the whole landing (waveform relaxation), as one matrix product per sweep, until a sweep
changes nothing beyond the stated tolerance; the k-th sweep is of the order (rate / w)^k.
"""

from dataclasses import dataclass

import numba
import numpy as np

from solver.arrays import Array
from solver.errors import ModelError
from solver.inertia_relief.loading import ReducedLoading
from solver.inertia_relief.loads import LandingLoads, equilibrium_residual
from solver.inertia_relief.modal_recursion import StepCoefficients, modal_response
from solver.inertia_relief.reduced import Single

#: Largest change by the last sweep, relative to the largest displacement, strain-energy norm.
SWEEP_TOLERANCE = 1e-6
MAXIMUM_SWEEPS = 30


@dataclass(frozen=True, slots=True)
class ReducedResponse:
    """Elastic motion of a landing."""

    time: Array  #: (nt,) [s]
    coordinates: Array  #: (m, nt) in the model's K-orthonormal basis
    sweeps: int  #: of the W terms
    last_change: float  #: of the last sweep, see `SWEEP_TOLERANCE`
    equilibrium_residual: float  #: see `equilibrium_residual`


@numba.njit(cache=True)
def _weighted_fields(
    coefficients: Single, displacement: Single, velocity: Single, out: Single
) -> None:  # pragma: no cover - compiled
    """Stack the twelve products of a rate coefficient and a field, (12, M, nt)."""
    terms, size, count = out.shape
    for term in range(terms):
        for i in range(size):
            for n in range(count):
                field = velocity[i, n] if term < 3 else displacement[i, n]
                out[term, i, n] = coefficients[term, n] * field


def rate_loads(
    loading: ReducedLoading, coefficients: Single, displacement: Array, velocity: Array
) -> Array:
    """Modal pseudo loads (m, nt) of the W terms on a modal motion (m, nt).

    Single precision is enough: the terms are a small share of the response, and each sweep
    brings a smaller one.
    """
    modes = loading.modes_with_rigid.astype(np.float32)
    count = displacement.shape[1]
    fields: Single = modes @ np.hstack([displacement, velocity]).astype(np.float32)
    stacked = np.empty((len(coefficients), len(fields), count), dtype=np.float32)
    _weighted_fields(
        coefficients,
        np.ascontiguousarray(fields[:, :count]),
        np.ascontiguousarray(fields[:, count:]),
        stacked,
    )
    operators = loading.rate_operators
    wide = np.ascontiguousarray(operators.transpose(1, 0, 2)).reshape(len(fields), -1)
    force = wide @ stacked.reshape(-1, count)
    return -(modes.T @ force).astype(np.float64)


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
    return ReducedResponse(loads.time, loading.modes @ response, sweeps, change, residual)


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
    coefficients = rate_coefficients.astype(np.float32)
    size = _largest(total)
    for sweep in range(1, MAXIMUM_SWEEPS + 1):
        pseudo = rate_loads(loading, coefficients, displacement, velocity)
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
