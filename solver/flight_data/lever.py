"""Heights and vertical speeds of points of a rigid aircraft, from those of one point."""

import numpy as np

from solver.arrays import Array


def rise(arm: Array, pitch: Array | float, roll: Array | float) -> Array:
    """How much higher a point is than the reference point.

    Parameters
    ----------
    arm : (3,) array
        From the reference point, body axes [m].
    pitch, roll : float or (n,) array
        [rad].

    Returns
    -------
    (n,) array
        [m].

    Notes
    -----
    Less the third row of the turn from body to earth axes (ISO 1151-1) times the arm.
    """
    x, y, z = arm
    return np.asarray(
        np.sin(pitch) * x - np.sin(roll) * np.cos(pitch) * y - np.cos(roll) * np.cos(pitch) * z
    )


def rise_rate(arm: Array, pitch: float, roll: float, pitch_rate: float, roll_rate: float) -> float:
    """How much faster a point rises than the reference point [m/s].

    ``pitch_rate`` and ``roll_rate`` are those of the Euler angles; heading does not matter.
    Derivative of `rise`.
    """
    x, y, z = arm
    by_pitch = np.cos(pitch) * x + np.sin(pitch) * (np.sin(roll) * y + np.cos(roll) * z)
    by_roll = np.cos(pitch) * (np.sin(roll) * z - np.cos(roll) * y)
    return float(by_pitch * pitch_rate + by_roll * roll_rate)
