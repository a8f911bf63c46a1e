"""Smoothing of an angle: its rate at the contact is as uncertain as stated."""

from dataclasses import replace

import numpy as np

from solver.flight_data.alignment import Series, best
from solver.flight_data.course import smooth_course
from solver.flight_data.parameter import Parameter
from solver.flight_data.window import Window

#: Spectral density of the angular acceleration in flight [rad2/s3].
BUSY = 0.012


def drawn(series: Series, rng: np.random.Generator) -> tuple[Series, float]:
    """An angle of a busy approach that stays as it is from time 0 on, and its rate just before."""
    step = 0.01
    time = np.arange(-9.0, 7.0, step)
    flying = time < 0.0
    rate = np.cumsum(np.sqrt(BUSY * step) * rng.standard_normal(len(time)) * flying)
    angle = np.cumsum(np.where(flying, rate, 0.0)) * step
    filed = np.arange(-9.0 + 0.25 * rng.random(), 6.9, 0.25)
    value = np.interp(filed, time, angle) + series.sd * rng.standard_normal(len(filed))
    return replace(series, time=filed, value=value), float(rate[flying][-1])


def test_an_aircraft_that_rolls_quietly_does_not_make_its_approach_look_quiet(
    window: Window,
) -> None:
    series = best(window, Parameter.ROLL)
    assert series is not None
    rng = np.random.default_rng(8)
    nodes = np.array([-9.0, 0.0, 6.9])
    shock = ((0.0, 0.3, 10.0),)  # the rate breaks off at once
    told: list[float] = []
    fooled: list[float] = []
    for _ in range(150):
        sampled, truth = drawn(series, rng)
        for squared, ground in ((told, (0.0, 1e-3)), (fooled, (np.inf, 0.0))):
            mean, covariance = smooth_course((sampled,), nodes, shock, ground=ground).state(0.0)
            squared.append(float((mean[1] - truth) ** 2 / covariance[1, 1]))
    # The mean of 150 squares of normal errors scatters by sqrt(2 / 150) = 0.12 about one.
    assert abs(np.mean(told) - 1.0) < 0.36
    assert np.mean(fooled) > np.mean(told) + 0.15
