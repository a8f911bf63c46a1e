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
from solver.inertia_relief.modal_recursion import LoadOf, StepCoefficients, add_modal_response
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
    # as exact as the modes are
    unit_loads = np.hstack([model.applied, loading.inertia]).astype(np.float32)
    shapes = unit_loads.T @ loading.modes_with_rigid
    amplitudes = np.hstack([applied, inertial]).astype(np.float32)

    def load(first: int, last: int, out: Array | Single) -> None:
        np.matmul(amplitudes[first:last], shapes, out=out)

    step = loading.coefficients(float(loads.time[1] - loads.time[0]))
    response = np.zeros((len(loads.time), model.size), dtype=np.float32)
    sweeps, change = add_swept_response(
        loading, step, load, motion.rate_coefficients().T, tolerance, response
    )
    coordinates: Single = (response @ loading.modes.T).T
    return ReducedResponse(loads.time, coordinates, sweeps, change, residual)


def add_swept_response(
    loading: ReducedLoading,
    step: StepCoefficients,
    load: LoadOf,
    rate_coefficients: Array,
    tolerance: float,
    total: Single,
) -> tuple[int, float]:
    """Add the modal response to modal loads with all W terms; give the sweeps and the last change.

    Parameters
    ----------
    rate_coefficients : (12, nt) array
        See `RigidMotion.rate_coefficients`.
    total : (nt, m) array
        Added to.
    """
    last = len(total) - 1
    at = np.append(np.arange(0, last, RATE_STRIDE), last)
    displacement, velocity, size = add_modal_response(step, load, total, at)
    if not np.any(rate_coefficients):
        return 0, 0.0
    loads = RateLoads(loading, rate_coefficients[:, at], NEGLIGIBLE * tolerance * size)
    change = 1.0
    for sweep in range(1, MAXIMUM_SWEEPS + 1):
        some = loads.of(displacement.T, velocity.T)
        if not np.any(some):
            return sweep, 0.0
        displacement, velocity, largest = add_modal_response(step, _between(some.T, at), total, at)
        before, change = change, largest / size
        # the next sweep would change by another such factor
        if change <= tolerance or CAUTION * change**2 <= tolerance * before:
            return sweep, change
        if not np.isfinite(change):
            break
    raise ModelError(f"the W terms did not converge in {MAXIMUM_SWEEPS} sweeps")


def _between(some: Single, at: IntArray) -> LoadOf:
    """Give loads straight between samples ``at``, no more than two apart; (k, m) are known."""
    samples = np.arange(at[-1] + 1)
    left, right = np.searchsorted(at, samples, "right") - 1, np.searchsorted(at, samples)

    def load(first: int, last: int, out: Array | Single) -> None:
        np.add(some[left[first:last]], some[right[first:last]], out=out)
        out /= 2

    return load
