"""The W terms of eq (15) at full order, evaluated at the mass points instead of by matrices.

The force is that of the assembled operators of `Inertia` (gyroscopic, Euler, centrifugal; Lee et
al., eq (15), in the symmetric forms that hold for translations and rotations alike); a test
compares both.  Going through the points costs a tenth of twelve sparse products.
"""

from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_array

from solver.arrays import Array
from solver.frames import skew

if TYPE_CHECKING:
    from solver.fe.inertia import Inertia


class RateTerms:
    """Forces of a turning frame on a displacement seen from it."""

    def __init__(self, inertia: "Inertia") -> None:
        self._interpolation = csr_array(inertia.interpolation)
        self._spread = csr_array(inertia.interpolation.T)
        self._scalar_mass = csr_array(inertia.scalar_mass)
        self._rotary_interpolation = csr_array(inertia.rotary_interpolation)
        self._rotary_spread = csr_array(inertia.rotary_interpolation.T)
        self._rotary = inertia.rotary

    def force(
        self, rate: Array, rate_derivative: Array, displacement: Array, velocity: Array
    ) -> Array:
        """``G(w) u' + (E(w') + C(w, w)) u``, the W terms on the left-hand side.

        Parameters
        ----------
        rate, rate_derivative : (3,) or (k, 3) arrays
            Of one frame, or of as many as there are motions [rad/s], [rad/s2].
        displacement, velocity : (n,) or (n, k) arrays
            Elastic motion in the turning frame.

        Returns
        -------
        (n,) or (n, k) array
            [N, N m]
        """
        if displacement.ndim == 1:
            return self.force(
                rate[None], rate_derivative[None], displacement[:, None], velocity[:, None]
            )[:, 0]
        turn = np.stack([skew(each) for each in rate])
        turn_derivative = np.stack([skew(each) for each in rate_derivative])
        count = len(turn)
        fields = np.hstack([displacement, velocity])
        points = (self._interpolation @ fields).reshape(-1, 3, 2 * count).transpose(2, 1, 0)
        acceleration = (turn_derivative + turn @ turn) @ points[:count]
        acceleration += 2.0 * turn @ points[count:]
        # (points, 3 k) through the masses, then each motion's three directions side by side
        weighed = self._scalar_mass @ acceleration.reshape(3 * count, -1).T
        force: Array = self._spread @ weighed.reshape(-1, count, 3).transpose(0, 2, 1).reshape(
            -1, count
        )
        if len(self._rotary):
            rotations = (self._rotary_interpolation @ fields).reshape(-1, 3, 2 * count)
            inertia = self._rotary
            for k in range(count):
                w, w_dot = turn[k], turn_derivative[k]
                on_rotation = inertia @ w_dot + w @ inertia @ w
                on_spin = inertia @ w + w @ inertia
                moments = np.einsum("kij,kj->ki", on_rotation, rotations[:, :, k])
                moments += np.einsum("kij,kj->ki", on_spin, rotations[:, :, count + k])
                force[:, k] += self._rotary_spread @ moments.ravel()
        return force
