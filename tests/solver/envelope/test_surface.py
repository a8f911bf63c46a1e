"""The interpolation against functions known in closed form."""

import numpy as np
import pytest
from scipy.stats import qmc

from solver.arrays import Array
from solver.envelope.surface import CAP, Surface, fit, worth_keeping


def places(count: int, dimensions: int = 3, seed: int = 0) -> Array:
    cube: Array = qmc.Sobol(dimensions, seed=seed).random(count)
    return 2.0 * cube - 1.0


def parts(at: Array) -> Array:
    """Two smooth parts whose largest has a kink; the third coordinate does nothing."""
    return np.column_stack([np.exp(0.5 * at[:, 0]) * 0.6, 0.7 - 0.3 * at[:, 0] + 0.1 * at[:, 1]])


def fitted(count: int, sweeps: int = 1) -> Surface:
    at = places(count)
    return fit(at, parts(at), np.full((count, 1), 0.5), np.ones(3), sweeps)


def error(surface: Surface) -> float:
    at = places(128, seed=7)
    found, _ = surface(at)
    return float(np.abs(found / parts(at).max(axis=1) - 1.0).max())


def test_the_largest_of_smooth_parts_is_met_across_its_kink() -> None:
    assert error(fitted(128)) < 0.02


def test_more_landings_come_closer() -> None:
    assert error(fitted(256, sweeps=0)) < 0.5 * error(fitted(32, sweeps=0))


def test_a_coordinate_that_does_nothing_is_pressed_together() -> None:
    stretch = fitted(128).stretch
    assert stretch[2] < stretch[0]


def test_stops_are_interpolated_beside() -> None:
    _, stops = fitted(64)(places(8, seed=3))
    assert stops == pytest.approx(0.5, abs=1e-6)


def test_far_beyond_the_limits_all_is_alike() -> None:
    at = places(64)
    surface = fit(at, 10.0 * parts(at), np.full((64, 1), 0.5), np.ones(3), sweeps=0)
    assert surface.utilisations.max() == CAP


def test_parts_that_never_come_near_the_largest_are_left_out() -> None:
    used = np.array([[0.9, 0.8, 0.2], [0.5, 0.6, 0.1], [5.0, 0.1, 6.0]])
    # The third leads only where all is HARD anyway.
    assert worth_keeping(used).tolist() == [True, True, False]
