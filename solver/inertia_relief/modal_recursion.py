"""Damped oscillators under piecewise-linear loads, stepped without any time-step error.

Each mode obeys ``q'' + 2 z w q' + w^2 q = w^2 p(t)`` with ``p`` linear between samples.  Over one
step the particular solution is a straight line and the homogeneous one is known in closed form, so
the recursion below is exact whatever the step (Nigam and Jennings, "Calculation of response
spectra from strong-motion earthquake records", 1969; here for any damping, over-critical too).
"""

from dataclasses import dataclass

import numba
import numpy as np

from solver.arrays import Array

#: Below this, ``(exp(a) - exp(b)) / (a - b)`` is taken from its series: cancellation.
_SERIES_LIMIT = 1e-3


@dataclass(frozen=True, slots=True)
class StepCoefficients:
    """One row of coefficients for each mode: new displacement and velocity from old and load."""

    displacement: Array  #: (m, 4) factors of q0, v0, p0, p1
    velocity: Array  #: (m, 4) factors of q0, v0, p0, p1


def step_coefficients(
    circular_frequency: Array, damping_ratio: Array, time_step: float
) -> StepCoefficients:
    """Closed-form coefficients of one step.

    Parameters
    ----------
    circular_frequency : (m,) array
        Undamped, positive [rad/s].
    damping_ratio : (m,) array
        Of critical damping; may exceed one.
    time_step : float
        [s]
    """
    w, h = circular_frequency, time_step
    decay = -damping_ratio * w
    half_gap = np.sqrt((decay * decay - w * w).astype(np.complex128))
    upper, lower = np.exp((decay + half_gap) * h), np.exp((decay - half_gap) * h)
    mean = ((upper + lower) / 2).real
    gap = half_gap * h
    small = np.abs(gap) < _SERIES_LIMIT
    safe = np.where(small, 1.0, half_gap)
    # sinh(gap) / half_gap times the decay, or its series h (1 + gap^2 / 6 + gap^4 / 120)
    series = h * np.exp(decay * h) * (1 + gap**2 / 6 + gap**4 / 120)
    difference = np.where(small, series, (upper - lower) / (2 * safe)).real
    # homogeneous solution: q = c11 q0 + c12 v0, v = c21 q0 + c22 v0
    c11, c12 = mean - decay * difference, difference
    c21, c22 = -w * w * difference, mean + decay * difference
    # particular solution p0 + (p1 - p0) t / h - lag, with lag = 2 z / w times the slope
    slope = 1.0 / h
    lag = 2 * damping_ratio / w * slope
    displacement = np.stack(
        [
            c11,
            c12,
            -c11 * (1 + lag) + c12 * slope + lag,
            1 - lag + c11 * lag - c12 * slope,
        ],
        axis=1,
    )
    velocity = np.stack(
        [
            c21,
            c22,
            -c21 * (1 + lag) + c22 * slope - slope,
            slope + c21 * lag - c22 * slope,
        ],
        axis=1,
    )
    return StepCoefficients(displacement, velocity)


@numba.njit(cache=True, fastmath={"contract"})
def _recur(
    a: Array, b: Array, load: Array, q: Array, v: Array
) -> None:  # pragma: no cover - compiled
    modes, count = load.shape
    # several modes advance together: one recursion alone would wait on its own latency
    for start in range(0, modes, 8):
        stop = min(start + 8, modes)
        for n in range(1, count):
            for i in range(start, stop):
                q0, v0, p0, p1 = q[i, n - 1], v[i, n - 1], load[i, n - 1], load[i, n]
                q[i, n] = a[i, 0] * q0 + a[i, 1] * v0 + a[i, 2] * p0 + a[i, 3] * p1
                v[i, n] = b[i, 0] * q0 + b[i, 1] * v0 + b[i, 2] * p0 + b[i, 3] * p1


def modal_response(
    coefficients: StepCoefficients, load: Array, initial: Array
) -> tuple[Array, Array]:
    """Displacement and velocity of every mode at every sample, starting at rest.

    Parameters
    ----------
    coefficients : StepCoefficients
        For the sampling step of ``load``.
    load : (m, nt) array
        ``p`` of each mode: the displacement it would cause if applied slowly.
    initial : (m,) array
        Displacement at the first sample; the velocity there is zero.

    Returns
    -------
    (m, nt) array, (m, nt) array
        Displacement, and velocity [1/s].
    """
    displacement = np.empty(load.shape)
    velocity = np.empty(load.shape)
    displacement[:, 0] = initial
    velocity[:, 0] = 0.0
    _recur(
        coefficients.displacement,
        coefficients.velocity,
        np.ascontiguousarray(load),
        displacement,
        velocity,
    )
    return displacement, velocity
