"""Compile the samples' kernels before anybody waits for them."""

import numpy as np

from solver.probability.watched_kernels import fill_departures, fill_peaks


def compile_kernels() -> None:
    """Compile, or load from the cache, the kernels in the forms in which they are called."""
    coefficients, load = np.zeros((4, 2)), np.zeros((3, 2))
    wide = np.zeros((3, 3), dtype=np.float32)
    for out in (np.zeros((3, 2), dtype=np.float32), wide[:, 1:]):
        fill_departures(coefficients, coefficients, load, out)
    rows, points = np.zeros((12, 3), dtype=np.float32), np.zeros((1, 8, 5), dtype=np.float32)
    fill_peaks(rows, points, 1, np.zeros(3), np.zeros(2))
