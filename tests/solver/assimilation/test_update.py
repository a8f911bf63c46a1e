"""Gauss-Newton against closed forms: linear models have theirs, others a minimum of their own."""

import numpy as np
import pytest
from scipy.optimize import minimize

from solver.arrays import Array
from solver.assimilation.update import Update, gauss_newton, mixed, twice_cost, widened

RNG = np.random.default_rng(5)
SLOPE = RNG.normal(size=(7, 4))
NOISE = np.diag(RNG.uniform(0.2, 2.0, 7))
MEASURED = RNG.normal(size=7)
WHITEN = np.linalg.inv(np.sqrt(NOISE))


def linear(z: Array) -> Array:
    return np.asarray(SLOPE @ z)


def found(update: Update | None) -> Update:
    assert update is not None
    return update


class TestLinearModel:
    """The Kalman filter's update is the exact answer (Bar-Shalom, Li & Kirubarajan, 5.2.3)."""

    innovation = SLOPE @ SLOPE.T + NOISE
    gain = SLOPE.T @ np.linalg.inv(innovation)

    @pytest.mark.parametrize("start", [np.zeros(4), np.full(4, 3.0)])
    def test_minimum_and_covariance_are_the_filters(self, start: Array) -> None:
        update = found(gauss_newton(linear, MEASURED, WHITEN, start))
        np.testing.assert_allclose(update.parameters, self.gain @ MEASURED, atol=1e-9)
        expected = np.eye(4) - self.gain @ SLOPE
        np.testing.assert_allclose(update.covariance, expected, atol=1e-9)

    def test_twice_the_cost_is_the_innovations_chi_square(self) -> None:
        update = found(gauss_newton(linear, MEASURED, WHITEN, np.zeros(4)))
        expected = MEASURED @ np.linalg.solve(self.innovation, MEASURED)
        assert update.chi_square == pytest.approx(expected, rel=1e-9)

    def test_effective_parameters_are_the_trace_of_the_influence(self) -> None:
        update = found(gauss_newton(linear, MEASURED, WHITEN, np.zeros(4)))
        assert update.effective == pytest.approx(np.trace(SLOPE @ self.gain), rel=1e-9)

    def test_a_straight_model_is_not_widened(self) -> None:
        update = found(gauss_newton(linear, MEASURED, WHITEN, np.zeros(4)))
        wide = widened(linear, WHITEN, update)
        np.testing.assert_allclose(wide.covariance, update.covariance, atol=1e-9)

    def test_measurements_without_weight_leave_the_prior(self) -> None:
        update = found(gauss_newton(linear, MEASURED, 1e-6 * WHITEN, np.zeros(4)))
        np.testing.assert_allclose(update.parameters, 0.0, atol=1e-6)
        np.testing.assert_allclose(update.covariance, np.eye(4), atol=1e-6)


def curved(z: Array) -> Array:
    return np.array([np.exp(z[0] / 2), z[0] * z[1], np.sin(z[1])])


CURVED_MEASURED = np.array([1.9, 0.4, 0.3])
CURVED_WHITEN = np.diag([4.0, 3.0, 5.0])


class TestCurvedModel:
    def test_minimum_is_that_of_another_method(self) -> None:
        update = found(gauss_newton(curved, CURVED_MEASURED, CURVED_WHITEN, np.zeros(2)))
        other = minimize(
            lambda z: twice_cost(z, curved(z), CURVED_MEASURED, CURVED_WHITEN),
            np.zeros(2),
            method="Nelder-Mead",
            options={"xatol": 1e-8, "fatol": 1e-10},
        )
        # The iteration ends when it can gain no more than 0.1.
        assert update.chi_square == pytest.approx(other.fun, abs=0.1)
        np.testing.assert_allclose(update.parameters, other.x, atol=0.1)

    def test_a_bent_model_knows_less_than_its_tangent(self) -> None:
        def bent(z: Array) -> Array:
            return np.array([z[0] + 2.0 * z[0] ** 2])

        update = found(gauss_newton(bent, np.zeros(1), np.array([[2.0]]), np.zeros(1)))
        wide = widened(bent, np.array([[2.0]]), update)
        # Closed form at zero: whitened slope 2, and twice the whitened bend over one deviation.
        assert wide.straight[0, 0] == pytest.approx(1.0 / 5.0)
        bend = 2.0 * 2.0 * update.covariance[0, 0]
        expected = 1.0 / (1.0 + 4.0 / (1.0 + 2.0 * bend**2))
        assert wide.covariance[0, 0] == pytest.approx(expected)

    def test_a_model_that_cannot_be_evaluated_is_left_alone(self) -> None:
        assert gauss_newton(lambda _: None, CURVED_MEASURED, CURVED_WHITEN, np.zeros(2)) is None

    def test_steps_into_the_impossible_are_shortened(self) -> None:
        def walled(z: Array) -> Array | None:
            return None if z[0] > 0.5 else 10.0 * z

        update = found(gauss_newton(walled, np.array([8.0]), np.array([[1.0]]), np.zeros(1)))
        assert 0.3 < update.parameters[0] <= 0.5


class TestTwoMinima:
    @staticmethod
    def gaussian(place: float, chi_square: float) -> Update:
        narrow = 0.01 * np.eye(1)
        return Update(np.array([place]), narrow, narrow, np.zeros(1), chi_square, 0.0)

    def test_the_likelier_one_is_taken_and_the_other_kept_in_its_covariance(self) -> None:
        both = mixed(self.gaussian(-1.0, 5.0), self.gaussian(1.0, 4.0))
        assert both.parameters[0] == 1.0
        # Weights of two equally wide Gaussians, the second moment about the likelier.
        weight = np.exp(-0.5) / (1.0 + np.exp(-0.5))
        assert both.covariance[0, 0] == pytest.approx(0.01 + 4.0 * weight)

    def test_one_minimum_reached_twice_is_one(self) -> None:
        once = self.gaussian(1.0, 4.0)
        assert mixed(once, self.gaussian(1.05, 4.1)) == once
