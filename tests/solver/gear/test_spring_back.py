import math

import numpy as np
import pytest

from solver.errors import ModelError
from solver.gear.parameters import SpringBack
from solver.gear.spring_back import (
    ramp_spring_back_factor,
    rotational_stiffness,
    two_tube_stiffness,
)

STEEL = 205e9


def tube(diameter: float, wall: float) -> float:
    """Bending stiffness of a round steel tube [N m2]."""
    return STEEL * math.pi / 64 * (diameter**4 - (diameter - 2 * wall) ** 4)


@pytest.mark.parametrize(
    ("angle", "factor"),
    # Closed form evaluated by hand elsewhere: free swing after a linear ramp that ends at once.
    [
        (1.0, 0.486),
        (2.0, 0.894),
        (3.0, 1.161),
        (4.0, 1.259),
        (5.0, 1.200),
        (2 * math.pi, 1.0),
        (8.0, 0.888),
        (10.0, 1.070),
    ],
)
def test_ramp_factor_table(angle: float, factor: float) -> None:
    assert ramp_spring_back_factor(angle) == pytest.approx(factor, abs=6e-4)


def test_ramp_factor_is_that_of_an_integrated_oscillator() -> None:
    x, steps = 4.0, 4000
    h = x / steps  # unit frequency: time is the angle
    place, speed = 0.0, 0.0

    def pull(time: float, at: float) -> float:
        return time / x - at

    for i in range(steps):
        t = i * h
        k1, l1 = speed, pull(t, place)
        k2, l2 = speed + h / 2 * l1, pull(t + h / 2, place + h / 2 * k1)
        k3, l3 = speed + h / 2 * l2, pull(t + h / 2, place + h / 2 * k2)
        k4, l4 = speed + h * l3, pull(t + h, place + h * k3)
        place += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        speed += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)
    assert ramp_spring_back_factor(x) == pytest.approx(math.hypot(place, speed), rel=1e-9)


def test_one_tube_is_a_cantilever() -> None:
    rigidity = tube(0.125, 0.008)
    stiffness, _ = two_tube_stiffness(1.1, rigidity, rigidity, 0.4, math.inf)
    assert stiffness == pytest.approx(3 * rigidity / 1.1, rel=1e-13)
    assert SpringBack.from_bending(rigidity, 1.1).stiffness == pytest.approx(stiffness)


def test_two_tube_stiffness_over_the_stroke() -> None:
    # Independent evaluation for steel tubes 125x8 over 95x8 mm, L_0 1.15 m, L_c 0.55 m [MN m/rad].
    spring = SpringBack(
        cylinder_rigidity=tube(0.125, 0.008),
        piston_rigidity=tube(0.095, 0.008),
        cylinder_length=0.55,
    )
    strokes = np.array([0.0, 0.10, 0.20, 0.30, 0.38])
    stiffness = rotational_stiffness(spring, 1.15 - strokes)
    assert stiffness / 1e6 == pytest.approx([2.25, 2.57, 2.96, 3.44, 3.91], rel=2e-3)


def test_slope_is_the_derivative() -> None:
    laws = (tube(0.125, 0.008), tube(0.095, 0.008), 0.55, 5e6)
    step = 1e-6
    for length in (0.5, 0.8, 1.1):
        numeric = (
            two_tube_stiffness(length + step, *laws)[0]
            - two_tube_stiffness(length - step, *laws)[0]
        ) / (2 * step)
        assert two_tube_stiffness(length, *laws)[1] == pytest.approx(numeric, rel=1e-6)


def test_attachment_softens_in_series() -> None:
    rigidity = tube(0.125, 0.008)
    free, _ = two_tube_stiffness(1.0, rigidity, rigidity, 0.5, math.inf)
    both, _ = two_tube_stiffness(1.0, rigidity, rigidity, 0.5, free)
    assert both == pytest.approx(free / 2, rel=1e-13)


def test_frequency_gives_its_stiffness_back() -> None:
    spring = SpringBack.from_frequency(25.0, unsprung_mass=95.0, length=1.07)
    frequency = math.sqrt(spring.stiffness / (95.0 * 1.07**2)) / (2 * math.pi)
    assert frequency == pytest.approx(25.0, rel=1e-13)


def test_spring_back_without_stiffness_is_refused() -> None:
    with pytest.raises(ModelError, match="stiffness"):
        SpringBack()
