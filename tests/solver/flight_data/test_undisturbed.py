"""Evidence of a shock: recordings drawn from the flight model itself, with and without one."""

from dataclasses import replace

import numpy as np
import pytest

from solver.arrays import Array
from solver.flight_data.alignment import Series
from solver.flight_data.frame_file import packaged_frame
from solver.flight_data.onset import ramp_response
from solver.flight_data.parameter import Parameter
from solver.flight_data.undisturbed import IMPACT, shock_evidence
from solver.flight_data.window import Channel

GRID = np.arange(-1.0, 1.0, 0.01)


def gusty(seed: int, shock: float) -> Series:
    """8 Hz, Matern gusts of 0.03 g and 0.4 s, and a ramp of the given height from time 0 [g]."""
    entry = packaged_frame("business-jet-8").require(Parameter.NORMAL_ACCELERATION)
    rng = np.random.default_rng(seed)
    time = np.arange(-7.0, 2.0, 0.125) + 0.05 * rng.random()
    distance = np.sqrt(3.0) * np.abs(time[:, None] - time[None, :]) / 0.4
    gusts = 0.03**2 * (1 + distance) * np.exp(-distance) + 0.008**2 * np.eye(len(time))
    value = 1.0 + np.linalg.cholesky(gusts) @ rng.standard_normal(len(time))
    value = value + shock * ramp_response(time, 0.05, entry.corner.value)
    channel = Channel(Parameter.NORMAL_ACCELERATION, "", time, value)
    # Filed times are those of the samples: the filter's delay is in the shape of the ramp.
    series = Series(channel, entry, time, value, 0.008)
    return replace(series, time=time - series.lag)


def evidence(shock: float) -> Array:
    """(40, n) of forty recordings."""
    return np.array([shock_evidence(gusty(k, shock), GRID, IMPACT, 5.0) for k in range(40)])


def test_undisturbed_flight_shows_no_shock() -> None:
    none = evidence(0.0)
    # A Bayes factor of more than 10 comes up by chance in less than one time of ten (Markov).
    assert np.mean(none > np.log(10.0)) < 0.1
    assert np.median(none) < 0.0


@pytest.mark.parametrize("shock", [0.2, 0.5])
def test_shock_is_found_when_it_began(shock: float) -> None:
    there = evidence(shock)
    best = GRID[there.argmax(axis=1)]
    assert np.median(there.max(axis=1)) > np.log(100.0)
    # Half a sampling interval.
    assert np.percentile(np.abs(best), 80) < 0.0625


def test_larger_shock_has_larger_evidence() -> None:
    medians = [np.median(evidence(shock).max(axis=1)) for shock in (0.1, 0.3, 0.9)]
    assert np.all(np.diff(medians) > 0)
