"""The prescribed rigid-body motion, and the amplitudes of the inertia loads that it makes."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.fe.inertia import RATE_PRODUCTS

#: Amplitudes of the inertia loads: specific acceleration 3, rate derivative 3, products 6.
INERTIA_AMPLITUDES = 12

#: Coefficients of the rate operators: rate 3 (on u'), rate derivative 3 and products 6 (on u).
RATE_COEFFICIENTS = 12


def rate_products(rate: Array) -> Array:
    """Products ``w_i w_j`` in the order of `RATE_PRODUCTS`, from (nt, 3) to (nt, 6)."""
    return np.stack([rate[:, i] * rate[:, j] for i, j in RATE_PRODUCTS], axis=1)


@dataclass(frozen=True, slots=True)
class RigidMotion:
    """Motion of the frame that carries the airframe, components in structural axes.

    The acceleration is the inertial one of ``origin``, a point fixed in the frame.
    """

    origin: Array  #: (3,) [m]
    acceleration: Array  #: (nt, 3) [m/s2]
    gravity: Array  #: (nt, 3) [m/s2]
    rate: Array  #: (nt, 3) [rad/s]
    rate_derivative: Array  #: (nt, 3) [rad/s2]

    def at(self, origin: Array) -> "RigidMotion":
        """Return the same motion described at another point of the frame.

        ``a_b = a_a + w' x r + w x (w x r)`` with ``r`` from a to b.
        """
        arm = np.asarray(origin, dtype=np.float64) - self.origin
        acceleration = (
            self.acceleration
            + np.cross(self.rate_derivative, arm)
            + np.cross(self.rate, np.cross(self.rate, arm))
        )
        return RigidMotion(
            np.asarray(origin, dtype=np.float64),
            acceleration,
            self.gravity,
            self.rate,
            self.rate_derivative,
        )

    def inertia_amplitudes(self) -> Array:
        """Amplitudes (nt, 12) of `Inertia.rigid_load_shapes` taken at the same origin."""
        return np.hstack(
            [
                self.acceleration - self.gravity,
                self.rate_derivative,
                rate_products(self.rate),
            ]
        )

    def rate_coefficients(self) -> Array:
        """Coefficients (nt, 12) of the gyroscopic (3), Euler (3) and centrifugal (6) operators."""
        return np.hstack([self.rate, self.rate_derivative, rate_products(self.rate)])
