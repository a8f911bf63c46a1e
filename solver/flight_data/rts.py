"""Fixed-interval smoothing of a linear system: Kalman filter forward, Rauch-Tung-Striebel back."""

from dataclasses import dataclass

import numba
import numpy as np

from solver.arrays import Array, IntArray


@dataclass(frozen=True, slots=True)
class LinearSystem:
    """``x[k+1] = F[k] x[k] + u[k] + w``, ``w ~ N(0, Q[k])``; scalar measurements ``H x + v``."""

    initial: Array  #: (n,)
    initial_covariance: Array  #: (n, n)
    transition: Array  #: (steps, n, n) F, from node k to node k + 1
    noise: Array  #: (steps, n, n) Q
    drive: Array  #: (steps, n) u
    node: IntArray  #: (m,) node of each measurement, rising
    row: Array  #: (m, n) H
    measured: Array  #: (m,)
    variance: Array  #: (m,)


@dataclass(frozen=True, slots=True)
class Smoothed:
    """Mean and covariance of the state at every node, given all measurements."""

    mean: Array  #: (nodes, n)
    covariance: Array  #: (nodes, n, n)
    log_likelihood: float  #: of all measurements


def smooth(system: LinearSystem) -> Smoothed:
    """Estimate the state of every node from all measurements.

    Notes
    -----
    H. E. Rauch, F. Tung, C. T. Striebel, Maximum likelihood estimates of linear dynamic systems,
    AIAA Journal 3 (1965) 1445, eqs 3.28 and 3.29; measurements one by one, as their errors are
    independent.
    """
    mean, covariance, likelihood = _smooth(
        system.initial,
        system.initial_covariance,
        system.transition,
        system.noise,
        system.drive,
        system.node,
        system.row,
        system.measured,
        system.variance,
    )
    return Smoothed(mean, covariance, float(likelihood))


def compile_smoother() -> None:
    """Compile the smoother, or load it from the cache, before anybody waits for it."""
    one = np.ones((1, 1, 1))
    none, single = np.zeros(1), np.ones((1, 1))
    smooth(
        LinearSystem(
            initial=none,
            initial_covariance=single,
            transition=one,
            noise=one,
            drive=single,
            node=np.zeros(1, dtype=np.int64),
            row=single,
            measured=none,
            variance=np.ones(1),
        )
    )


@numba.njit(cache=True)
def _smooth(
    initial: Array,
    initial_covariance: Array,
    transition: Array,
    noise: Array,
    drive: Array,
    node: IntArray,
    row: Array,
    measured: Array,
    variance: Array,
) -> tuple[Array, Array, float]:
    steps, n = drive.shape
    mean = np.zeros((steps + 1, n))
    covariance = np.zeros((steps + 1, n, n))
    expected = np.zeros((steps + 1, n))
    expected_covariance = np.zeros((steps + 1, n, n))
    x, p = initial.copy(), initial_covariance.copy()
    likelihood = 0.0
    at = 0
    for k in range(steps + 1):
        if k > 0:
            f = transition[k - 1]
            x = f @ x + drive[k - 1]
            p = f @ p @ f.T + noise[k - 1]
        expected[k] = x
        expected_covariance[k] = p
        while at < node.size and node[at] == k:
            h = row[at]
            ph = p @ h
            total = h @ ph + variance[at]
            innovation = measured[at] - h @ x
            gain = ph / total
            x = x + gain * innovation
            # Joseph's form keeps the covariance positive.
            keep = np.eye(n) - np.outer(gain, h)
            p = keep @ p @ keep.T + variance[at] * np.outer(gain, gain)
            likelihood -= 0.5 * (innovation**2 / total + np.log(2 * np.pi * total))
            at += 1
        mean[k] = x
        covariance[k] = p
    for k in range(steps - 1, -1, -1):
        f = transition[k]
        back = np.linalg.solve(expected_covariance[k + 1], f @ covariance[k]).T
        mean[k] = mean[k] + back @ (mean[k + 1] - expected[k + 1])
        change = covariance[k + 1] - expected_covariance[k + 1]
        covariance[k] = covariance[k] + back @ change @ back.T
    return mean, covariance, likelihood
