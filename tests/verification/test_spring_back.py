"""Closed forms of the spring-back chapter."""

import numpy as np
import pytest

from solver.gear.spring_back import ramp_spring_back_factor
from solver.landing.peaks import refined_peak
from verification.spring_back.closed_forms import simulated, spin_up_load, spin_up_time


def test_closed_form_keeps_the_wheel_s_angular_momentum() -> None:
    # The drag of the ramp times the radius, over the spin-up, is I V / r: 1600 * 50 / 20.
    impulse = 0.5 * spin_up_load() * spin_up_time()
    assert impulse * 20.0 == pytest.approx(1600.0 * 50.0 / 20.0)


def test_drag_of_a_stiff_tyre_meets_the_closed_form() -> None:
    history = simulated(1e9)
    time, drag = refined_peak(history.time, -history.gears[0].ground_force[:, 0])
    assert drag == pytest.approx(spin_up_load(), rel=5e-3)
    assert time == pytest.approx(spin_up_time(), rel=5e-3)


@pytest.mark.parametrize("angle", [2.0, 5.0])
def test_elastic_leg_springs_forward_by_the_ramp_factor(angle: float) -> None:
    history = simulated(1e8, angle)
    forward = history.gears[0].wrench[history.time > spin_up_time(), 0].max()
    assert forward / spin_up_load() == pytest.approx(ramp_spring_back_factor(angle), rel=2e-3)


def test_rigid_leg_does_not_spring_forward() -> None:
    history = simulated(1e8)
    assert np.max(history.gears[0].wrench[:, 0]) < 0.01 * spin_up_load()
