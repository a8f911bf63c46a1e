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
        rate, rate_derivative : (3,) arrays
            [rad/s], [rad/s2]
        displacement, velocity : (n,) arrays
            Elastic motion in the turning frame.

        Returns
        -------
        (n,) array
            [N, N m]
        """
        turn, turn_derivative = skew(rate), skew(rate_derivative)
        fields = np.stack([displacement, velocity], axis=1)
        points = self._interpolation @ fields
        acceleration = (
            points[:, 0].reshape(-1, 3) @ (turn_derivative + turn @ turn).T
            + points[:, 1].reshape(-1, 3) @ (2.0 * turn).T
        )
        force: Array = self._spread @ (self._scalar_mass @ acceleration).ravel()
        if len(self._rotary):
            rotations = self._rotary_interpolation @ fields
            inertia = self._rotary
            on_rotation = inertia @ turn_derivative + turn @ inertia @ turn
            on_spin = inertia @ turn + turn @ inertia
            moments = np.einsum("kij,kj->ki", on_rotation, rotations[:, 0].reshape(-1, 3))
            moments += np.einsum("kij,kj->ki", on_spin, rotations[:, 1].reshape(-1, 3))
            force = force + self._rotary_spread @ moments.ravel()
        return force
