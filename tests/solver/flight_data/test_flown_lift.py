"""Lift at the first contact: closed forms, and flights drawn from the model itself."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import truncnorm

from solver.arrays import Array
from solver.flight_data.flown_lift import _cuts, flown_lift
from solver.flight_data.onset import ramp_response
from solver.flight_data.vertical_course import RecordedAcceleration, VerticalCourse
from solver.landing.records import GRAVITY

NOISE, LAG, CORNER = 0.008, 0.0563, 4.0


def course(time: Array, up: Array, bias: float = 0.0, bias_sd: float = 0.0) -> VerticalCourse:
    """Samples at 8 Hz behind a filter of 4 Hz, [g] in."""
    recorded = RecordedAcceleration(time, up * GRAVITY, NOISE * GRAVITY, 0.125, LAG)
    covariance = np.zeros((len(time), 3, 3))
    covariance[:, 2, 2] = (bias_sd * GRAVITY) ** 2
    zero = np.zeros_like(time)
    return VerticalCourse(
        time, zero, zero, covariance, up * GRAVITY, zero + bias * GRAVITY, recorded
    )


def test_steady_flight_has_the_lift_of_its_acceleration() -> None:
    time = np.arange(-4.0, 1.0, 0.125)
    lift, sd = flown_lift(course(time, np.full_like(time, 0.05), bias=-0.02), 0.4, 0.01)
    # 1 + a / g, drawn towards 1 by a prior a tenth of a g wide.
    assert lift == pytest.approx(1.03, abs=0.003)
    assert sd < NOISE


def test_error_of_the_bias_adds_to_that_of_the_lift() -> None:
    time = np.arange(-4.0, 1.0, 0.125)
    still = np.zeros_like(time)
    _, without = flown_lift(course(time, still), 0.4, 0.01)
    _, with_bias = flown_lift(course(time, still, bias_sd=0.03), 0.4, 0.01)
    assert with_bias == pytest.approx(np.hypot(without, 0.03), rel=1e-9)


def test_a_sample_that_shows_the_contact_is_not_taken_for_lift() -> None:
    time = np.arange(-4.0, 1.0, 0.125)
    rng = np.random.default_rng(5)
    flight = NOISE * rng.standard_normal(len(time))
    # The contact is taken for later than it was: by its time alone the shock would be flight.
    struck = flight + np.where(time > 0.3, 0.25, 0.0)
    known, _ = flown_lift(course(time, flight), 0.35, 0.02)
    taken, _ = flown_lift(course(time, struck), 0.46, 0.05)
    assert taken == pytest.approx(known, abs=NOISE)


def test_cuts_have_the_chances_and_means_of_a_truncated_normal_distribution() -> None:
    doubted = np.array([-0.04, 0.01, 0.06])
    chance, mean = _cuts(doubted, 0.03)
    assert chance.sum() == pytest.approx(1.0)
    edges = np.array([-np.inf, *doubted, np.inf]) / 0.03
    np.testing.assert_allclose(mean, 0.03 * truncnorm.mean(edges[:-1], edges[1:]), rtol=1e-6)


def test_lift_is_as_uncertain_as_stated_in_flights_of_the_model() -> None:
    # Gusts of any strength and pace the model averages over, a flare, a contact whose time is known
    # to 0.03 s, a shock behind the filter.  Honest errors have a mean square of 1 that scatters by
    # sqrt(2 / 150) = 0.12; the gust between the last sample and the contact is most of them.
    rng = np.random.default_rng(11)
    squared = []
    for _ in range(150):
        grid = np.arange(-3.5, 0.5, 0.125) + 0.125 * rng.random()
        time = np.append(grid, 0.0)
        length, deviation = rng.choice([0.15, 0.3, 0.6, 1.2, 2.4]), rng.choice([0.01, 0.02, 0.04])
        apart = np.sqrt(3.0) * np.abs(time[:, None] - time[None, :]) / length
        gusts = deviation**2 * (1 + apart) * np.exp(-apart) + 1e-12 * np.eye(len(time))
        flown = np.linalg.cholesky(gusts) @ rng.standard_normal(len(time))
        flown += np.stack([time**0, time, time**2]).T @ (rng.standard_normal(3) * [0.1, 0.1, 0.03])
        shock = rng.normal(0.4, 0.15) * ramp_response(grid + LAG, 0.05, CORNER)
        shown = flown[:-1] + NOISE * rng.standard_normal(len(grid)) + shock
        lift, sd = flown_lift(course(grid, shown), 0.03 * rng.standard_normal(), 0.03)
        squared.append(((lift - 1.0 - flown[-1]) / sd) ** 2)
    assert 0.65 < np.mean(squared) < 1.35


def test_without_a_sample_of_flight_the_prior_stands() -> None:
    # A tenth of a g about one, and the mean square of the gusts' deviations, all as likely.
    time = np.arange(5.0, 9.0, 0.125)
    lift, sd = flown_lift(course(time, np.full_like(time, 0.4)), 0.0, 0.02)
    gusts = np.mean(np.square([0.005, 0.01, 0.02, 0.04, 0.08]))
    assert lift == 1.0
    assert sd == pytest.approx(np.sqrt(0.1**2 + gusts), rel=1e-6)


def test_samples_without_noise_leave_the_lift_finite() -> None:
    time = np.arange(-4.0, 1.0, 0.125)
    steady = course(time, np.full_like(time, 0.05))
    still = replace(steady, recorded=replace(steady.recorded, sd=0.0))
    lift, sd = flown_lift(still, 0.4, 0.01)
    assert lift == pytest.approx(1.05, abs=0.003)
    assert 0.0 < sd < NOISE
