"""Most likely parameters of a nonlinear model, given their prior and measurements.

Minimises ``J(z) = (z'z + (y - h(z))' R^-1 (y - h(z))) / 2`` over parameters ``z`` that are
independent and of unit variance a priori, by the method of Gauss and Newton with Levenberg's
damping; derivatives are kept up by Broyden's update between simulations of all of them.

Notes
-----
A. Tarantola, Inverse Problem Theory (2005), sec. 3.2: the iteration and the covariance of the
posterior.  ``2 J`` at the minimum is chi-square with as many degrees of freedom as there are
measurements, if model and uncertainties are right and the model is nearly linear over them
(A. F. Bennett, Inverse Modeling of the Ocean and Atmosphere (2002), sec. 2.3.3).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from solver.arrays import Array

#: (n,) parameters to (m,) predicted measurements; None where the model cannot be evaluated.
Prediction = Callable[[Array], Array | None]

#: Step of the finite differences, in prior standard deviations.
_STEP = 0.2

#: The iteration ends when a step promises to lower ``2 J`` by less than this: no test could tell.
_CONVERGED = 0.1

_MOST_ITERATIONS = 12

#: Share of the promised gain above which the derivatives need not be computed again.
_KEPT = 0.6


@dataclass(frozen=True, slots=True)
class Update:
    """A minimum and its surroundings."""

    parameters: Array  #: (n,) z at the minimum
    covariance: Array  #: (n, n) of z
    straight: Array  #: (n, n) the same for the tangent at the minimum alone
    predicted: Array  #: (m,)
    chi_square: float  #: 2 J
    effective: float  #: measurements that the parameters took up, trace of the influence matrix


def twice_cost(here: Array, predicted: Array, measured: Array, whiten: Array) -> float:
    """``2 J`` of parameters (n,) with what they predict (m,)."""
    residual = whiten @ (measured - predicted)
    return float(here @ here + residual @ residual)


def gauss_newton(
    prediction: Prediction, measured: Array, whiten: Array, start: Array
) -> Update | None:
    """Find the minimum next to a start.

    Parameters
    ----------
    prediction : callable
    measured : (m,) array
    whiten : (m, m) array
        W with ``W'W = R^-1``.
    start : (n,) array
        Where to begin.

    Returns
    -------
    Update or None
        None if the model cannot be evaluated at the start.
    """
    here, identity = start.copy(), np.eye(len(start))
    predicted = prediction(here)
    if predicted is None:
        return None
    jacobian = _jacobian(prediction, here, predicted, whiten)
    least = twice_cost(here, predicted, measured, whiten)
    is_fresh, damping = True, 0.0
    for _ in range(_MOST_ITERATIONS):
        right = jacobian.T @ (whiten @ (measured - predicted)) - here
        normal = identity + jacobian.T @ jacobian
        # What a whole step would gain: a short one must not pass for the end.
        if float(np.linalg.solve(normal, right) @ right) < _CONVERGED:
            break
        step = np.linalg.solve(normal + damping * identity, right)
        promised = float(step @ (2.0 * right - normal @ step))
        trial = prediction(here + step)
        cost = np.inf if trial is None else twice_cost(here + step, trial, measured, whiten)
        if trial is None or cost >= least:
            if is_fresh:
                damping = max(4.0 * damping, 1.0)
            else:
                jacobian = _jacobian(prediction, here, predicted, whiten)
                is_fresh = True
            continue
        # Broyden's rank-one update serves as long as steps gain what they promise.
        is_fresh = least - cost < _KEPT * promised
        moved = whiten @ (trial - predicted)
        here, predicted, least = here + step, trial, cost
        damping = damping / 4.0 if damping > 0.3 else 0.0
        if is_fresh:
            jacobian = _jacobian(prediction, here, predicted, whiten)
        else:
            jacobian = jacobian + np.outer(moved - jacobian @ step, step) / (step @ step)
    covariance = np.asarray(np.linalg.inv(identity + jacobian.T @ jacobian), dtype=np.float64)
    influence = float(np.trace(jacobian @ covariance @ jacobian.T))
    return Update(here, covariance, covariance, predicted, least, influence)


def widened(prediction: Prediction, whiten: Array, update: Update) -> Update:
    """Update with a covariance that holds what a straight line misses over its own width.

    Along each parameter the model is evaluated one standard deviation to either side.  Half the
    sum of both less the middle is its second-order term ``c``; as an error of the straight line it
    has the covariance ``2 c c'``, which is added to that of the measurements.

    Notes
    -----
    Second-order filter with the diagonal of the Hessian: Y. Bar-Shalom, X. R. Li, T. Kirubarajan,
    Estimation with Applications to Tracking and Navigation (2001), sec. 10.3.2.
    """
    here, count = update.parameters, len(update.parameters)
    slopes, bends = np.zeros((2, len(update.predicted), count))
    for index, width in enumerate(np.sqrt(np.diag(update.covariance))):
        step = np.zeros(count)
        step[index] = width
        above, below = prediction(here + step), prediction(here - step)
        above = update.predicted if above is None else above
        below = update.predicted if below is None else below
        slopes[:, index] = whiten @ (above - below) / (2.0 * width)
        bends[:, index] = whiten @ (above + below - 2.0 * update.predicted) / 2.0
    error = np.eye(len(update.predicted)) + 2.0 * bends @ bends.T
    straight = np.linalg.inv(np.eye(count) + slopes.T @ slopes)
    wide = np.linalg.inv(np.eye(count) + slopes.T @ np.linalg.solve(error, slopes))
    return replace(
        update,
        covariance=np.asarray(wide, dtype=np.float64),
        straight=np.asarray(straight, dtype=np.float64),
        effective=float(np.trace(slopes @ straight @ slopes.T)),
    )


def mixed(one: Update, other: Update) -> Update:
    """Likelier of two minima, with a covariance about it that holds the other as well.

    Each weighs as much as the Gaussian around it, ``exp(-J) det(C)^(1/2)`` (method of Laplace).
    """
    likely, rival = sorted((one, other), key=lambda update: update.chi_square)
    apart = rival.parameters - likely.parameters
    if apart @ np.linalg.solve(likely.covariance, apart) < 1.0:
        return likely  # the same minimum, reached twice
    odds = (likely.chi_square - rival.chi_square) / 2.0 + 0.5 * float(
        np.linalg.slogdet(rival.covariance)[1] - np.linalg.slogdet(likely.covariance)[1]
    )
    weight = 1.0 / (1.0 + np.exp(-odds))
    spread = rival.covariance + np.outer(apart, apart)
    return replace(likely, covariance=(1.0 - weight) * likely.covariance + weight * spread)


def _jacobian(prediction: Prediction, here: Array, predicted: Array, whiten: Array) -> Array:
    """Whitened derivative of the prediction, (m, n), by one-sided differences."""
    columns = np.zeros((len(predicted), len(here)))
    for index in range(len(here)):
        for step in (_STEP, -_STEP):
            moved = here.copy()
            moved[index] += step
            there = prediction(moved)
            if there is not None:
                columns[:, index] = (there - predicted) / step
                break
    return np.asarray(whiten @ columns)
