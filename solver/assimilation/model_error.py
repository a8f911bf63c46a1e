"""How far a perfect recording would be from the simulation of the true contact."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.flight_data.parameter import Parameter


@dataclass(frozen=True, slots=True)
class ModelError:
    """Errors of the simulation besides those of its parameters; assumptions but for the share.

    The share is that of a flexible airframe, which takes 0 to 6 % off the loads of the main struts
    (method, section 9); its errors are alike over half a period of the wing's first bending.
    """

    response: float = 0.03  #: share of the largest response so far
    response_memory: float = 0.15  #: over which that error stays alike [s]
    normal_air: float = 0.025  #: gusts [g]
    lateral_air: float = 0.02  #: [g]
    longitudinal_air: float = 0.04  #: thrust and drag, which the simulation does not know [g]
    air_memory: float = 0.5  #: [s]
    control: float = 3e-4  #: spectral density of the pilot's angular acceleration [rad2/s3]

    def air(self, parameter: Parameter) -> float:
        """Look up the standard deviation of what the air does to an acceleration [g]."""
        return {
            Parameter.NORMAL_ACCELERATION: self.normal_air,
            Parameter.LATERAL_ACCELERATION: self.lateral_air,
            Parameter.LONGITUDINAL_ACCELERATION: self.longitudinal_air,
        }[parameter]


def acceleration_error(
    parameter: Parameter, after: Array, value: Array, model: ModelError
) -> Array:
    """Covariance of the simulation's error of an acceleration.

    Parameters
    ----------
    parameter : Parameter
    after : (n,) array
        Time after the contact [s].
    value : (n,) array
        As recorded [g].
    model : ModelError

    Returns
    -------
    (n, n) array
        Both parts are Ornstein-Uhlenbeck processes, that of the response with a size that follows
        the recorded change since the contact.
    """
    apart = np.abs(after[:, None] - after[None, :])
    before = value[after <= 0.0]
    rest = float(before[-1]) if len(before) else float(value[0])
    change = np.where(after > 0.0, np.abs(value - rest), 0.0)
    size = model.response * np.maximum.accumulate(change)
    response = np.outer(size, size) * np.exp(-apart / model.response_memory)
    return np.asarray(response + model.air(parameter) ** 2 * np.exp(-apart / model.air_memory))


def turned(after: Array, density: float) -> Array:
    """Covariance of an angle under white angular acceleration from the contact on, (n, n).

    Notes
    -----
    Twice integrated Wiener process between two instants, ``q t1^2 (t2 / 2 - t1 / 6)`` for
    ``t1 <= t2``; for ``t1 = t2`` the ``q t^3 / 3`` of Bar-Shalom, Li & Kirubarajan, Estimation with
    Applications to Tracking and Navigation (2001), sec. 6.2.2.
    """
    from_contact = np.maximum(after, 0.0)
    early = np.minimum(from_contact[:, None], from_contact[None, :])
    late = np.maximum(from_contact[:, None], from_contact[None, :])
    return np.asarray(density * early**2 * (late / 2.0 - early / 6.0))
