"""The smoother and the indicators on their own: closed forms and statistics."""

import numpy as np
import pytest

from solver.flight_data.anti_alias import anti_aliased
from solver.flight_data.onset import indicator, ramp_response
from solver.flight_data.reconstruction import reconstruct
from solver.flight_data.rts import LinearSystem, _smooth, compile_smoother, smooth
from solver.flight_data.vote import first_time_down, vote


def random_walk(measured: np.ndarray, variance: float, noise: float) -> LinearSystem:
    n = len(measured)
    return LinearSystem(
        initial=np.zeros(1),
        initial_covariance=np.eye(1) * 100.0,
        transition=np.ones((n - 1, 1, 1)),
        noise=np.full((n - 1, 1, 1), noise),
        drive=np.zeros((n - 1, 1)),
        node=np.arange(n),
        row=np.ones((n, 1)),
        measured=measured,
        variance=np.full(n, variance),
    )


def test_smoother_solves_the_least_squares_problem_of_all_nodes() -> None:
    # Independent: the normal equations of all states at once.
    rng = np.random.default_rng(1)
    measured = rng.normal(size=7)
    result = smooth(random_walk(measured, 0.5, 0.2))
    precision = np.eye(7) / 0.5
    precision[0, 0] += 1 / 100.0
    for k in range(6):
        precision[k : k + 2, k : k + 2] += np.array([[1, -1], [-1, 1]]) / 0.2
    covariance = np.linalg.inv(precision)
    np.testing.assert_allclose(result.mean[:, 0], covariance @ (measured / 0.5), atol=1e-12)
    np.testing.assert_allclose(result.covariance[:, 0, 0], np.diag(covariance), atol=1e-12)


def test_a_window_is_smoothed_by_what_the_warm_up_compiled(window, geometry) -> None:
    compile_smoother()
    reconstruct(window, geometry)
    assert len(_smooth.nopython_signatures) == 1


def test_likelihood_is_that_of_the_joint_normal_distribution() -> None:
    measured = np.array([0.3, -0.2, 0.9])
    result = smooth(random_walk(measured, 0.5, 0.2))
    joint = np.full((3, 3), 100.0) + 0.2 * np.minimum.outer(np.arange(3), np.arange(3))
    joint += 0.5 * np.eye(3)
    expected = -0.5 * (
        measured @ np.linalg.solve(joint, measured)
        + np.log(np.linalg.det(joint))
        + 3 * np.log(2 * np.pi)
    )
    assert result.log_likelihood == pytest.approx(expected, abs=1e-10)


def test_constant_without_noise_is_the_mean() -> None:
    measured = np.array([1.0, 2.0, 4.0, 5.0])
    result = smooth(random_walk(measured, 1.0, 0.0))
    # Prior of variance 100 about zero: n / (n + 1 / 100) of the mean.
    np.testing.assert_allclose(result.mean[:, 0], 3.0 * 4 / 4.01)


def test_ramp_response_is_that_of_the_filter() -> None:
    step = 1e-4
    time = np.arange(-0.05, 0.5, step)
    ramp = np.clip(time / 0.06, 0.0, 1.0)
    # The discrete filter's bilinear transform leaves an error of the order of the step.
    np.testing.assert_allclose(
        ramp_response(time, 0.06, 4.0), anti_aliased(ramp, 4.0, step), atol=2e-3
    )
    np.testing.assert_allclose(ramp_response(time, 0.06, 0.0), ramp)


def normal(grid: np.ndarray, mean: float, sd: float) -> np.ndarray:
    return np.asarray(-0.5 * ((grid - mean) / sd) ** 2)


def test_agreeing_indicators_combine_as_normal_ones_do() -> None:
    grid = np.arange(-1.0, 1.0, 0.005)
    ones = [indicator(f"{i}", grid, normal(grid, m, 0.05)) for i, m in enumerate((0.0, 0.04))]
    result = vote(grid, ones)
    assert result.time == pytest.approx(0.02, abs=2e-3)
    assert result.sd == pytest.approx(0.05 / np.sqrt(2), rel=0.1)
    assert all(ballot.agrees for ballot in result.ballots)


def test_a_wrong_indicator_is_outvoted() -> None:
    grid = np.arange(-1.0, 1.0, 0.005)
    means = (0.0, 0.01, 0.6)
    result = vote(
        grid, [indicator(f"{i}", grid, normal(grid, m, 0.03)) for i, m in enumerate(means)]
    )
    assert abs(result.time) < 0.03
    assert [ballot.agrees for ballot in result.ballots] == [True, True, False]


def test_wheel_that_comes_down_evenly_is_timed_by_its_height_over_its_speed() -> None:
    # Closed form: height -v t with deviation s passes zero at 0 with deviation s / v.
    grid = np.arange(-2.0, 2.0, 0.01)
    log = first_time_down(grid, -0.5 * grid, np.full(len(grid), 0.1))
    result = indicator("x", grid, log)
    assert result.time == pytest.approx(0.0, abs=1e-3)
    assert result.sd == pytest.approx(0.2, rel=0.02)


def test_wheel_that_was_lower_before_does_not_come_down_for_the_first_time() -> None:
    # Five centimetres under the runway at -0.5 s, up to a metre, and down again at 0.5 s.
    grid = np.arange(-1.0, 1.0, 0.01)
    height = 0.5 * np.cos(2 * np.pi * grid) + 0.45
    log = first_time_down(grid, height, np.full(len(grid), 0.1))
    here, again = np.abs(grid + 0.6).argmin(), np.abs(grid - 0.4).argmin()
    assert height[here] == pytest.approx(height[again], abs=1e-9)
    assert log[here] > log[again] + 1.0
