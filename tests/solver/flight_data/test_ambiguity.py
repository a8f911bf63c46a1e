"""Deviations of a mixture of hypotheses: closed forms."""

from dataclasses import replace

import numpy as np
import pytest

from solver.flight_data.ambiguity import widened, widened_state
from solver.flight_data.geometry import Geometry
from solver.flight_data.reconstruction import reconstruct
from solver.flight_data.touchdown import Estimate
from solver.flight_data.window import Window
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS


def test_second_moment_is_about_the_likeliest_value() -> None:
    # 3/4 (1) + 1/4 (1 + 2^2) = 2
    result = widened(Estimate(0.0, 1.0), [(0.25, Estimate(2.0, 1.0))])
    assert result.value == 0.0
    assert result.sd == pytest.approx(np.sqrt(2.0))


def test_normalised_error_squared_of_a_mixture_is_one() -> None:
    # The truth is at the likeliest value with 0.9, and 1.2 s later else.
    others = [(0.1, Estimate(1.2, 0.05))]
    sd = widened(Estimate(0.0, 0.02), others).sd
    rng = np.random.default_rng(3)
    is_other = rng.random(200_000) < 0.1
    truth = np.where(is_other, rng.normal(1.2, 0.05, 200_000), rng.normal(0.0, 0.02, 200_000))
    assert np.mean((truth / sd) ** 2) == pytest.approx(1.0, rel=0.02)


def test_state_keeps_its_values_and_its_deviations_are_those_of_its_covariance(
    window: Window, geometry: Geometry
) -> None:
    state = reconstruct(window, geometry).contacts[0].state
    slower = replace(state, sink_rate=Estimate(state.sink_rate.value - 0.5, state.sink_rate.sd))
    wide = widened_state(state, [(0.2, slower)])
    for index, name in enumerate(CONTACT_COMPONENTS):
        assert getattr(wide, name).value == getattr(state, name).value
        assert getattr(wide, name).sd == pytest.approx(np.sqrt(wide.covariance[index, index]))
    assert wide.sink_rate.sd**2 == pytest.approx(state.sink_rate.sd**2 + 0.2 * 0.5**2)
    assert np.all(np.linalg.eigvalsh(wide.covariance) > 0)


def test_without_other_hypotheses_nothing_changes(window: Window, geometry: Geometry) -> None:
    state = reconstruct(window, geometry).contacts[0].state
    same = widened_state(state, [])
    np.testing.assert_array_equal(same.covariance, state.covariance)
    assert same.gear_sink_rates == state.gear_sink_rates
