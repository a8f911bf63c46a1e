"""The closed-form recursion against the matrix exponential of each oscillator."""

import itertools

import numpy as np
import pytest
from scipy.linalg import expm

from solver.arrays import Array
from solver.inertia_relief.modal_recursion import modal_response, step_coefficients


def exact_response(w: float, z: float, load: Array, step: float) -> Array:
    """Displacement and velocity (2, nt) by the exponential of the augmented system."""
    generator = np.zeros((4, 4))
    generator[:2, :2] = np.array([[0.0, 1.0], [-w * w, -2 * z * w]]) * step
    generator[1, 2] = w * w * step
    generator[2, 3] = 1.0
    advance = expm(generator)[:2]
    states = [np.array([load[0], 0.0])]
    for now, then in itertools.pairwise(load):
        states.append(advance @ np.array([*states[-1], now, then - now]))
    return np.array(states).T


@pytest.mark.parametrize(
    ("frequency", "ratio"),
    [
        (2.0, 0.02),
        (50.0, 0.0),
        (500.0, 0.5),
        (400.0, 1.0),
        (400.0, 1.0 + 1e-9),
        (3e3, 2.5),
        (2e4, 8.0),
    ],
)
def test_recursion_is_exact_for_piecewise_linear_loads(frequency, ratio):
    rng = np.random.default_rng(4)
    load = rng.standard_normal(60).cumsum()
    step = 1e-3
    coefficients = step_coefficients(np.array([frequency]), np.array([ratio]), step)
    q, v = modal_response(coefficients, load[None])
    expected = exact_response(frequency, ratio, load, step)
    np.testing.assert_allclose(q[0], expected[0], atol=1e-11 * np.abs(expected[0]).max())
    np.testing.assert_allclose(v[0], expected[1], atol=1e-9 * np.abs(expected[1]).max())


def test_many_modes_advance_as_each_would_alone():
    rng = np.random.default_rng(5)
    frequency, ratio = rng.uniform(1.0, 3000.0, 21), rng.uniform(0.0, 1.5, 21)
    load = rng.standard_normal((21, 40))
    together, _ = modal_response(step_coefficients(frequency, ratio, 2e-3), load)
    for mode in range(21):
        one = slice(mode, mode + 1)
        alone, _ = modal_response(step_coefficients(frequency[one], ratio[one], 2e-3), load[one])
        np.testing.assert_array_equal(together[one], alone)


def test_constant_load_keeps_a_mode_at_its_static_displacement():
    load = np.full((3, 100), 2.5)
    coefficients = step_coefficients(np.array([1.0, 40.0, 4e4]), np.array([0.0, 0.03, 3.0]), 1e-3)
    q, v = modal_response(coefficients, load)
    np.testing.assert_allclose(q, 2.5, rtol=1e-9)
    np.testing.assert_allclose(v / np.array([[1.0], [40.0], [4e4]]), 0.0, atol=1e-9)
