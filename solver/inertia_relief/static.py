"""Conventional inertia relief, eq (10) of Lee et al., and the steady state a landing starts from.

The loads are put in equilibrium by rigid acceleration; then any statically determinate support
carries no reaction, and the stress does not depend on which six freedoms it takes away.  The
displacement is handed back in the mean-axis frame, where nothing of the support is left.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import qr

from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.inertia_relief.factor import factorise
from solver.inertia_relief.free_body import FreeBody
from solver.inertia_relief.rate_terms import RateTerms

#: Change between sweeps of the steady state's rate terms, relative to the displacement.
STEADY_TOLERANCE = 1e-12
MAXIMUM_SWEEPS = 50


def determinate_support(rigid_modes: Array, length: float) -> IntArray:
    """Choose six freedoms that hold the body without constraining its strain.

    Pivoted QR of the rigid modes (rotations scaled by ``length`` [m]) picks freedoms far apart, so
    the supported stiffness is about as well conditioned as it can be.
    """
    scaled = rigid_modes / np.array([1.0, 1.0, 1.0, length, length, length])
    _, _, order = qr(scaled.T, mode="economic", pivoting=True)
    return np.sort(np.asarray(order[:6], dtype=np.int64))


@dataclass(frozen=True, slots=True)
class InertiaRelief:
    """Static solver of a free body; factorised once."""

    body: FreeBody
    support: IntArray  #: (6,) freedoms held
    _free: IntArray
    _factor: Any

    def displacement(self, loads: Array) -> Array:
        """Mean-axis displacement under ``loads`` (n,) or (n, k) and the inertia they call up."""
        balanced = self.body.self_equilibrated(loads)
        solution = np.zeros_like(balanced)
        solution[self._free] = self._factor.solve(np.ascontiguousarray(balanced[self._free]))
        return self.body.mean_axis(solution)


def inertia_relief(body: FreeBody, support: IntArray | None = None) -> InertiaRelief:
    """Prepare the static solver on ``support``, six freedoms, or on a good choice of its own.

    Raises
    ------
    ModelError
        The support is not statically determinate.
    """
    if support is None:
        support = determinate_support(body.rigid_modes, body.gyration_radius)
    scale = np.array([1.0] * 3 + [body.gyration_radius] * 3)
    held = body.rigid_modes[support] / scale
    if len(support) != 6 or np.linalg.cond(held) > 1e8:
        raise ModelError(f"freedoms {support.tolist()} are not a statically determinate support")
    free = np.setdiff1d(np.arange(body.stiffness.shape[0]), support)
    factor = factorise(body.stiffness[free][:, free])
    return InertiaRelief(body, np.asarray(support), free, factor)


def steady_state(
    solver: InertiaRelief, rhs: Array, rate: Array, rate_derivative: Array
) -> tuple[Array, int]:
    """Shape at rest in the turning frame, ``(K + W terms) u = rhs``, and the sweeps it took.

    Parameters
    ----------
    rhs : (n,) array
        Balanced right-hand side of eq (15) [N, N m].
    rate, rate_derivative : (3,) arrays
        Structural axes [rad/s], [rad/s2].

    Raises
    ------
    ModelError
        The rotation is so fast that the sweeps diverge.
    """
    displacement = solver.displacement(rhs)
    if not (np.any(rate) or np.any(rate_derivative)):
        return displacement, 0
    terms = RateTerms(solver.body.inertia)
    rest = np.zeros_like(displacement)
    for sweep in range(1, MAXIMUM_SWEEPS + 1):
        force = terms.force(rate, rate_derivative, displacement, rest)
        updated = solver.displacement(rhs - force)
        change = np.linalg.norm(updated - displacement)
        displacement = updated
        if change <= STEADY_TOLERANCE * np.linalg.norm(displacement):
            return displacement, sweep
    raise ModelError(
        f"steady state of a frame turning at {np.linalg.norm(rate):.3g} rad/s did not converge "
        f"in {MAXIMUM_SWEEPS} sweeps"
    )
