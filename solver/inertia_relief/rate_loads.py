"""The W terms of eq (15) in reduced coordinates, as pseudo loads of a motion already known.

All twelve operators act in one matrix product per sweep, in single precision: the terms are a small
share of the response and each sweep brings a smaller one.  Coordinates whose part in the loads is
provably negligible are left out; in a basis of modes those are most of the fast ones.
"""

import numba
import numpy as np

from solver.arrays import Array, IntArray
from solver.inertia_relief.loading import ReducedLoading
from solver.inertia_relief.reduced import Single


@numba.njit(cache=True)
def _weighted_fields(
    coefficients: Single, displacement: Single, velocity: Single, out: Single
) -> None:  # pragma: no cover - compiled
    """Stack the twelve products (12, a, nt) of a coefficient's history and a field."""
    terms, size, count = out.shape
    for term in range(terms):
        for i in range(size):
            if term < 3:
                for n in range(count):
                    out[term, i, n] = coefficients[term, n] * velocity[i, n]
            else:
                for n in range(count):
                    out[term, i, n] = coefficients[term, n] * displacement[i, n]


class RateLoads:
    """Pseudo loads of one landing's rates on modal motions of one loading.

    Parameters
    ----------
    coefficients : (12, nt) array
        See `RigidMotion.rate_coefficients`.
    negligible : float
        Largest norm of the loads that may be left out.
    """

    def __init__(
        self, loading: ReducedLoading, coefficients: Array, negligible: float = 0.0
    ) -> None:
        self._operators = loading.rate_operators
        self._modes = loading.modes_with_rigid.astype(np.float32)
        self._coefficients = coefficients.astype(np.float32)
        self._negligible = negligible
        weights = np.abs(coefficients).max(axis=1)[:, None] * loading.rate_norms
        self._on_velocity = weights[:3].sum(axis=0)
        self._on_displacement = weights[3:].sum(axis=0)

    def of(self, displacement: Array, velocity: Array) -> Array:
        """Modal pseudo loads (m, nt) of the modal motion (m, nt), [1/s] for the velocity."""
        count = displacement.shape[1]
        motion = np.hstack([displacement, velocity]).astype(np.float32)
        fields: Single = self._modes @ motion
        active = self._active(fields, count)
        stacked = np.empty((len(self._coefficients), len(active), count), dtype=np.float32)
        fields = fields[active]
        _weighted_fields(self._coefficients, fields[:, :count], fields[:, count:], stacked)
        columns = self._operators[:, :, active].transpose(1, 0, 2)
        force = columns.reshape(len(columns), -1) @ stacked.reshape(-1, count)
        return -(self._modes.T @ force).astype(np.float64)

    def _active(self, fields: Single, count: int) -> IntArray:
        """Coordinates whose loads, bounded by norms, together matter."""
        slow = np.abs(fields[:, :count]).max(axis=1)
        fast = np.abs(fields[:, count:]).max(axis=1)
        share = self._on_displacement * slow + self._on_velocity * fast
        order = np.argsort(share)
        dropped = np.searchsorted(np.cumsum(share[order]), self._negligible, side="right")
        return np.sort(order[dropped:])
