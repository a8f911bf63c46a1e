"""The low-pass filter before a recorder's sampler."""

import numpy as np
from scipy.signal import butter, lfilter

from solver.arrays import Array


def anti_aliased(values: Array, corner: float, interval: float) -> Array:
    """Filter by a second-order Butterworth low-pass that is at rest on the first value.

    Parameters
    ----------
    values : (n,) array
    corner : float
        0: no filter [Hz].
    interval : float
        Of the values [s].
    """
    if corner <= 0:
        return values
    numerator, denominator = butter(2, corner, fs=1.0 / interval)
    return np.asarray(values[0] + lfilter(numerator, denominator, values - values[0]))


def filter_delay(corner: float) -> float:
    """Delay of `anti_aliased` at low frequency [s].

    Notes
    -----
    ``sqrt(2) / (2 pi corner)``: slope of the phase of ``1 / (s^2 + sqrt(2) s + 1)`` at zero.
    """
    return float(np.sqrt(2.0) / (2.0 * np.pi * corner)) if corner > 0 else 0.0
