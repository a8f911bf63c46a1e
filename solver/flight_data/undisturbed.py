"""Whether a recorded quantity goes on as it did in flight, or a shock began at some time."""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve, solve_triangular

from solver.arrays import Array
from solver.flight_data.alignment import Series
from solver.flight_data.onset import ramp_response

#: Correlation times [s] and deviations [g] tried for what gusts and controls do to the quantity.
_CORRELATION_TIMES = (0.15, 0.4, 1.2)
_DEVIATIONS = (0.01, 0.03, 0.08)

#: Its level in the approach [g].
_LEVEL_SD = 0.3

#: What is taken for the deviation per correlation time where too few samples show it.
_USUAL = (0.4, 0.03)

#: Least number of samples from which both are taken.
_LEAST_SAMPLES = 12

#: Times over which the load of a gear comes up [s].
_RISES = (0.02, 0.05, 0.1)

#: Samples so long after the beginning show a shock; later ones the course of the oleo [s].
_SHOWN = 0.12

#: Share of the samples after the first shock in which the ground acts.
_MOVED = 0.2

#: Scatter of what a landing does after its first shock, per median height of one.
_LANDED = 1.0

#: How far the true course of a shock leaves a ramp, per unit of its height.
_MISFIT = 0.3


@dataclass(frozen=True, slots=True)
class Shock:
    """What shocks are like before anything is known: log-normal height."""

    sign: float
    median: float  #: [g]
    spread: float  #: standard deviation of the logarithm


#: Of the normal acceleration: a tenth of a g at the softest touches to more than a g.
IMPACT = Shock(1.0, 0.3, 0.9)

#: Of the longitudinal one: wheels that are brought to speed.
SPIN_UP_PULL = Shock(-1.0, 0.12, 0.7)


def shock_evidence(series: Series, grid: Array, shock: Shock, history: float) -> Array:
    """Log likelihood ratio of a shock that begins at each time against undisturbed flight.

    In flight the quantity is a stationary Gaussian process around its level, with the covariance
    ``s^2 (1 + sqrt(3) d / l) exp(-sqrt(3) d / l)`` at a distance d (Matern, exponent 3/2), s and l
    by largest likelihood from the seconds before the grid, and white noise of the sensor.  The
    Cholesky factor of the covariance turns the samples into independent ones in order of time
    without looking ahead, so that each time is judged by what came before it.

    Parameters
    ----------
    series : Series
    grid : (n,) array
        Times, rising [s].
    shock : Shock
    history : float
        Before the grid [s].

    Returns
    -------
    (n,) array
        0 where no sample speaks.

    Notes
    -----
    C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for Machine Learning (2006), eqs 2.30 and
    4.17; the ratio integrated over height and rise time is a Bayes factor: R. E. Kass, A. E.
    Raftery, J. Am. Stat. Assoc. 90 (1995) 773, eq. 2.
    """
    filed = series.time + series.lag
    keep = (filed > grid[0] - history) & (filed < grid[-1] + _SHOWN + series.interval)
    time, value = filed[keep], shock.sign * series.value[keep]
    if len(time) < 4:
        return np.zeros(len(grid))
    noise = max(series.sd, 1e-4)
    quiet = time < grid[0]
    length, deviation = _fitted(time[quiet], value[quiet], noise)
    factor = np.linalg.cholesky(_covariance(time, length, deviation, noise))
    innovation = solve_triangular(factor, value - value[0], lower=True)
    heights = shock.median * np.exp(shock.spread * np.linspace(-2.0, 2.0, 9))
    prior = -0.5 * np.linspace(-2.0, 2.0, 9) ** 2
    prior -= np.logaddexp.reduce(prior)
    shapes = [
        ramp_response(time[:, None] - grid[None, :], rise, series.entry.corner.value)
        for rise in _RISES
    ]
    whitened = np.array([solve_triangular(factor, shape, lower=True) for shape in shapes])
    first = np.searchsorted(time, grid, side="right")
    last = np.searchsorted(time, grid + _SHOWN + series.interval, side="right")
    # (times, samples) that show the shock of each time, and which of them there are.
    rows = first[:, None] + np.arange(int((last - first).max(initial=0)))
    shown = rows < last[:, None]
    rows = np.minimum(rows, len(time) - 1)
    times = np.arange(len(grid))[:, None]
    flown = innovation[rows]
    expected = heights[:, None, None, None] * whitened[:, rows, times]
    variance = 1.0 + (_MISFIT * expected) ** 2
    ratio = 0.5 * (flown**2 - (flown - expected) ** 2 / variance - np.log(variance))
    total = (ratio * shown).sum(axis=3) + prior[:, None, None]
    evidence = np.logaddexp.reduce(total.reshape(-1, len(grid)), axis=0) - np.log(len(_RISES))
    # After its beginning a landing may do anything, also fly on.
    widened = 1.0 + (_LANDED * heights[4] / np.diag(factor)) ** 2
    broad = 0.5 * innovation**2 * (1.0 - 1.0 / widened) - 0.5 * np.log(widened)
    landed = np.append(
        np.cumsum(np.logaddexp(broad + np.log(_MOVED), np.log(1.0 - _MOVED))[::-1])[::-1], 0.0
    )
    return np.asarray(evidence + landed[last])


def _covariance(time: Array, length: float, deviation: float, noise: float) -> Array:
    moved = matern(time[:, None] - time[None, :], length, deviation)
    return np.asarray(moved + _LEVEL_SD**2 + noise**2 * np.eye(len(time)))


def matern(apart: Array, length: float, deviation: float) -> Array:
    """Matern covariance (exponent 3/2) of values so far apart; source as of `shock_evidence`."""
    distance = np.sqrt(3.0) * np.abs(apart) / length
    return np.asarray(deviation**2 * (1.0 + distance) * np.exp(-distance))


def _fitted(time: Array, value: Array, noise: float) -> tuple[float, float]:
    """Correlation time and deviation that make the samples likeliest."""
    if len(time) < _LEAST_SAMPLES:
        return _USUAL
    best, found = -np.inf, _USUAL
    for length in _CORRELATION_TIMES:
        for deviation in _DEVIATIONS:
            factor = cho_factor(_covariance(time, length, deviation, noise), lower=True)
            residual = value - value[0]
            likelihood = -0.5 * residual @ cho_solve(factor, residual)
            likelihood -= np.log(np.diag(factor[0])).sum()
            if likelihood > best:
                best, found = likelihood, (length, deviation)
    return found
