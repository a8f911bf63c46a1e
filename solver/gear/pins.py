"""How a gear's resultant is shared among its pins.

The fitting is rigid, each pin elastic along and about the structural axes.  Minimum complementary
energy under the six conditions of equilibrium is the same as the fitting's six small motions q
with K q = wrench, K = sum G_i^T k_i G_i, and the pin loads k_i G_i q.
"""

from collections.abc import Sequence

import numpy as np

from solver.arrays import Array
from solver.errors import ModelError
from solver.frames import skew
from solver.gear.parameters import Pin


def pin_load_matrix(pins: Sequence[Pin], reference_point: Array) -> Array:
    """Matrix that turns a wrench on the fitting into the loads of its pins.

    Parameters
    ----------
    pins : sequence of Pin
    reference_point : (3,) array
        The point about which the wrench's moment is taken, structural axes [m].

    Returns
    -------
    (6 n_pins, 6) array
        Rows: force and moment of each pin on the airframe; columns: force and moment of the
        wrench; structural axes.

    Raises
    ------
    ModelError
        The pins leave the fitting a free motion.
    """
    geometry = np.concatenate([_pin_motion(pin.position - reference_point) for pin in pins])
    stiffness = np.concatenate([np.asarray(pin.stiffness, dtype=np.float64) for pin in pins])
    # Rotations times a length of the fitting's size, so that the check below compares like things.
    spread = np.ptp([pin.position for pin in pins], axis=0)
    size = max(float(np.linalg.norm(spread)), 1e-3)
    scale = np.array([1.0, 1.0, 1.0, 1 / size, 1 / size, 1 / size])
    scaled = geometry * scale
    total = scaled.T @ (stiffness[:, None] * scaled)
    values = np.linalg.eigvalsh(total)
    if not values[0] > 1e-10 * values[-1]:
        names = ", ".join(pin.name for pin in pins)
        raise ModelError(f"pins {names} do not hold their gear: one motion is without stiffness")
    shares = (stiffness[:, None] * scaled) @ np.linalg.inv(total) * scale
    # The inverse carries rounding times its condition; one refinement removes it.
    return np.asarray(shares + shares @ (np.eye(6) - geometry.T @ shares))


def resultant_matrix(pins: Sequence[Pin], reference_point: Array) -> Array:
    """Matrix (6, 6 n_pins) that sums pin loads to their wrench about ``reference_point``."""
    motions = [_pin_motion(pin.position - reference_point) for pin in pins]
    return np.concatenate(motions).T


def _pin_motion(arm: Array) -> Array:
    """(6, 6) motion of a point at ``arm`` from six motions of the fitting."""
    motion = np.eye(6)
    motion[:3, 3:] = -skew(arm)
    return motion
