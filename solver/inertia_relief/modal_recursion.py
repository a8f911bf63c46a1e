"""Damped oscillators under piecewise-linear loads, stepped without any time-step error.

Each mode obeys ``q'' + 2 z w q' + w^2 q = w^2 p(t)`` with ``p`` linear between samples.  Over one
step the particular solution is a straight line and the homogeneous one is known in closed form, so
the recursion below is exact whatever the step (Nigam and Jennings, "Calculation of response
spectra from strong-motion earthquake records", 1969; here for any damping, over-critical too).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numba
import numpy as np

from solver.arrays import Array, IntArray, Single

#: Below this, ``(exp(a) - exp(b)) / (a - b)`` is taken from its series: cancellation.
_SERIES_LIMIT = 1e-3
#: Samples whose loads are held at once.
_SAMPLES_AT_ONCE = 64


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


@numba.njit(cache=True, fastmath={"contract", "reassoc"})
def _square(values: Array) -> float:  # pragma: no cover - compiled
    total = 0.0
    for i in range(len(values)):
        total += values[i] * values[i]
    return total


@numba.njit(cache=True, fastmath={"contract"})
def _advance(
    a: Array,
    b: Array,
    load: Array | Single,
    q: Array,
    v: Array,
    p: Array,
    total: Array | Single,
    slots: IntArray,
    moved: Array | Single,
    moving: Array | Single,
) -> float:  # pragma: no cover - compiled
    """Advance all modes together over some samples; return the largest norm of displacement.

    Parameters
    ----------
    a, b : (4, m) arrays
        Transposed `StepCoefficients`.
    load : (n, m) array
        At each sample.
    q, v, p : (m,) arrays
        Displacement, velocity and load of the sample before, replaced by those of the last one.
    total : (n, m) array
        The displacement is added to it.
    slots : (n,) array
        Where in ``moved`` and ``moving`` to put each sample's motion; negative for nowhere.
    """
    largest = 0.0
    for n in range(len(load)):
        for i in range(len(q)):
            q0, v0, p0, p1 = q[i], v[i], p[i], load[n, i]
            new = a[0, i] * q0 + a[1, i] * v0 + a[2, i] * p0 + a[3, i] * p1
            v[i] = b[0, i] * q0 + b[1, i] * v0 + b[2, i] * p0 + b[3, i] * p1
            q[i], p[i] = new, p1
            total[n, i] += new
        largest = max(largest, _square(q))
        if slots[n] >= 0:
            for i in range(len(q)):
                moved[slots[n], i] = q[i]
                moving[slots[n], i] = v[i]
    return math.sqrt(largest)


#: Writes the modal loads (last - first, m) of the samples from ``first`` before ``last``.
LoadOf = Callable[[int, int, Array | Single], None]


def add_modal_response(
    coefficients: StepCoefficients, load: LoadOf, total: Array | Single, at: IntArray
) -> tuple[Array | Single, Array | Single, float]:
    """Add every mode's displacement, starting at rest under the first sample's load, to ``total``.

    Loads are asked for some samples at a time: all of them at once would cost more in fresh memory
    than the recursion itself.

    Parameters
    ----------
    coefficients : StepCoefficients
        For the sampling step of ``load``.
    load : callable
        See `LoadOf`.
    total : (nt, m) array
        Added to.
    at : (k,) array
        Samples whose motion is returned.

    Returns
    -------
    (k, m) array, (k, m) array, float
        Displacement and velocity [1/s] at those, and the largest norm of the displacement.
    """
    count, modes = total.shape
    slots = np.full(count, -1)
    slots[at] = np.arange(len(at))
    moved, moving = np.empty((2, len(at), modes), dtype=total.dtype)
    a = np.ascontiguousarray(coefficients.displacement.T)
    b = np.ascontiguousarray(coefficients.velocity.T)
    some = np.empty((_SAMPLES_AT_ONCE, modes), dtype=total.dtype)
    load(0, 1, some[:1])
    # at rest: the sample before had the same load, which the displacement followed
    q, v, p = some[0].astype(np.float64), np.zeros(modes), some[0].astype(np.float64)
    total[0] += q
    largest = float(np.linalg.norm(q))
    if slots[0] >= 0:
        moved[slots[0]], moving[slots[0]] = q, v
    for first in range(1, count, _SAMPLES_AT_ONCE):
        last = min(count, first + _SAMPLES_AT_ONCE)
        part = slice(first, last)
        load(first, last, some[: last - first])
        norm = _advance(
            a, b, some[: last - first], q, v, p, total[part], slots[part], moved, moving
        )
        largest = max(largest, norm)
    return moved, moving, largest


def modal_response(coefficients: StepCoefficients, load: Array) -> tuple[Array, Array]:
    """Displacement and velocity of every mode at every sample, starting at rest.

    Parameters
    ----------
    coefficients : StepCoefficients
        For the sampling step of ``load``.
    load : (m, nt) array
        ``p`` of each mode: the displacement it would cause if applied slowly.

    Returns
    -------
    (m, nt) array, (m, nt) array
        Displacement, and velocity [1/s].
    """

    def of(first: int, last: int, out: Array | Single) -> None:
        out[:] = load[:, first:last].T

    displacement = np.zeros(load.T.shape)
    every = np.arange(load.shape[1])
    velocity = add_modal_response(coefficients, of, displacement, every)[1].astype(np.float64)
    return displacement.T, velocity.T
