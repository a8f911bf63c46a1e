"""Lift over weight at the first contact, from the vertical acceleration of the flight before it.

In the air ``m a = L - m g`` along the vertical (thrust and drag have next to no part of it), so
that ``L / (m g) = 1 + a / g``.  What is wanted is that at the contact, which comes part of a
sampling interval and a filter's delay after the last sample that shows flight; and which sample
that is, is known only as well as the time of the contact.
"""

import numpy as np
from scipy.linalg import solve_triangular
from scipy.stats import norm

from solver.arrays import Array
from solver.flight_data.undisturbed import matern
from solver.flight_data.vertical_course import VerticalCourse
from solver.landing.records import GRAVITY

#: Seconds before the contact that show how the aircraft flies.
_HISTORY = 3.0

#: Correlation times [s] and deviations [g] of gusts and controls that are averaged over.
_CORRELATION_TIMES = (0.15, 0.3, 0.6, 1.2, 2.4)
_DEVIATIONS = (0.005, 0.01, 0.02, 0.04, 0.08)

#: The flare: spread of level [g], slope [g/s] and what goes with the square of time [g/s2].  A sink
#: rate that falls by 3 m/s along a cubic over four seconds has up to 0.11, 0.11 and 0.03.
_FLARE = (0.1, 0.1, 0.03)

#: Samples are in doubt from so many deviations of the time before the contact until so many after.
_DOUBTED = 3.0

#: What a sample that already shows the contact is above the last one that does not: mean and
#: standard deviation; from nothing to half a g [g].
_SHOCK = (0.1, 0.2)

#: Least scatter of a sample, which keeps the covariance regular [g].
_LEAST_NOISE = 1e-4

#: Cuts that are less likely are left out.
_LEAST_CHANCE = 1e-6


def flown_lift(vertical: VerticalCourse, time: float, time_sd: float) -> tuple[float, float]:
    """Lift over weight at a contact before which the aircraft flew, and its standard deviation.

    Over the level, slope and curvature of the flare the acceleration is a Gaussian process (Matern
    covariance as in `undisturbed.shock_evidence`); correlation time and deviation are averaged over
    by their likelihood.  Averaged over as well is which sample is the first that shows the contact:
    the filter is causal, so that samples filed before the contact do not know of it.  How likely
    each cut is, follows from the time of the contact, from what the flight before lets expect of
    each sample in doubt, and from what a shock would make of it.

    Parameters
    ----------
    vertical : VerticalCourse
    time, time_sd : float
        Of the contact [s].

    Returns
    -------
    (float, float)

    Notes
    -----
    C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for Machine Learning (2006), eqs 2.25,
    2.26 and 2.30 (prediction and likelihood) and section 2.7 (the flare: basis functions with a
    prior).  The innovations of the Cholesky factor are those of each sample given the ones before
    it, so that one factor serves all cuts.
    """
    recorded = vertical.recorded
    shown = recorded.time + recorded.lag  # a contact before this shows in the sample
    keep = (recorded.time > time - _HISTORY) & (shown < time + _DOUBTED * time_sd)
    passed = recorded.time[keep] - time
    at = int(np.argmin(np.abs(vertical.time - time)))
    flown = (recorded.up[keep] + vertical.bias[at]) / GRAVITY
    # Without any sample the prior stands.
    clean = int(np.searchsorted(shown[keep], time - _DOUBTED * time_sd))
    chance, moment = _cuts(shown[keep][clean:] - time, time_sd)
    rise = flown[clean:] - (flown[clean - 1] if clean else 0.0)
    by_shock = norm.logpdf(rise, *_SHOCK)
    likely = np.flatnonzero(chance > _LEAST_CHANCE)
    noise = max(recorded.sd / GRAVITY, _LEAST_NOISE)
    logs, means, variances = [], [], []
    for length in _CORRELATION_TIMES:
        for deviation in _DEVIATIONS:
            covariance = _covariance(passed, passed, length, deviation)
            covariance += noise**2 * np.eye(len(passed))
            factor = np.linalg.cholesky(covariance)
            innovation = solve_triangular(factor, flown, lower=True)
            by_flight = norm.logpdf(innovation) - np.log(np.diag(factor))
            gain = solve_triangular(
                factor, _covariance(passed, moment, length, deviation), lower=True
            )
            before = np.diag(_covariance(moment, moment, length, deviation))
            for cut in likely:
                used = clean + cut
                logs.append(by_flight[:used].sum() + by_shock[cut:].sum() + np.log(chance[cut]))
                means.append(gain[:used, cut] @ innovation[:used])
                variances.append(before[cut] - gain[:used, cut] @ gain[:used, cut])
    weight = np.exp(np.array(logs) - max(logs))
    weight /= weight.sum()
    mean = weight @ np.array(means)
    variance = weight @ (np.array(variances) + (np.array(means) - mean) ** 2)
    variance += vertical.covariance[at, 2, 2] / GRAVITY**2
    return 1.0 + float(mean), float(np.sqrt(variance))


def _cuts(doubted: Array, sd: float) -> tuple[Array, Array]:
    """Chance that the contact falls before, between and after instants, and its mean time there.

    Parameters
    ----------
    doubted : (n,) array
        Rising, from the likeliest time on [s].
    sd : float
        Of the contact's time [s].

    Returns
    -------
    (n + 1,) array
    (n + 1,) array
        From the likeliest time on [s].

    Notes
    -----
    Mean of a truncated normal distribution: N. L. Johnson, S. Kotz, N. Balakrishnan, Continuous
    Univariate Distributions 1 (1994), section 13.10.1.
    """
    edges = np.concatenate([[-np.inf], doubted, [np.inf]]) / sd
    chance = np.diff(norm.cdf(edges))
    return chance, -sd * np.diff(norm.pdf(edges)) / np.maximum(chance, np.finfo(float).tiny)


def _covariance(one: Array, other: Array, length: float, deviation: float) -> Array:
    """Of the acceleration in flight at times from the contact on, (n, m) [g2]."""
    level, slope, curvature = _FLARE
    product = one[:, None] * other[None, :]
    flare = level**2 + slope**2 * product + curvature**2 * product**2
    return flare + matern(one[:, None] - other[None, :], length, deviation)
