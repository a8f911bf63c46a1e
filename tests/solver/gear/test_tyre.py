import math

import numpy as np
import pytest

from solver.errors import ModelError
from solver.gear.parameters import Tyre
from solver.gear.tyre import (
    SLIP_SPEED,
    fiala_forces,
    rolling_moment,
    slips,
    tyre_vertical_force,
    vertical_energy,
    vertical_force,
)

#: C_slip, C_alpha, mu_max, mu_min, width of the example's main tyre.
LAWS = (315823.73, 189494.24, 0.8, 0.5, 0.1416)
NORMAL = 40000.0


def tyre(**changes: object) -> Tyre:
    """22x5.75-12 12PR: catalogue loads 7100 lb at 1.25 in and 21,300 lb at 2.85 in."""
    values: dict[str, object] = {
        "free_radius": 0.27559,
        "vertical_coefficient": 3137586.387933475,
        "vertical_exponent": 1.3329835268010592,
        "longitudinal_stiffness": 315823.73,
        "cornering_stiffness": 189494.24,
        "maximum_friction": 0.8,
        "minimum_friction": 0.5,
        "width": 0.1416,
        "wheel_inertia": 1.1,
        "count": 2,
        "bottoming_deflection": 0.07239,
    }
    return Tyre(**(values | changes))  # type: ignore[arg-type]


def test_vertical_law_meets_the_catalogue_loads_of_both_tyres() -> None:
    force = tyre_vertical_force(np.array([-0.01, 0.03175, 0.07239]), tyre())
    # 7100 lb and 21,300 lb in newton, twice.
    assert force == pytest.approx([0.0, 2 * 31582.37, 2 * 94747.12], rel=1e-6)


def test_bottoming_adds_ten_times_the_tangent_stiffness() -> None:
    one = tyre()
    slope = 94747.12 * 1.3329835268 / 0.07239
    assert one.rim_stiffness == pytest.approx(10 * slope, rel=1e-6)
    law = (one.vertical_coefficient, one.vertical_exponent, 0.07239, one.rim_stiffness)
    step = 1e-7
    below = (vertical_force(0.07239, *law) - vertical_force(0.07239 - step, *law)) / step
    above = (vertical_force(0.07239 + step, *law) - vertical_force(0.07239, *law)) / step
    assert above / below == pytest.approx(11.0, rel=1e-3)


def test_vertical_energy_is_the_integral_of_the_force() -> None:
    law = (3.1e6, 1.33, 0.07, 2.0e7)
    deflections = np.linspace(0.0, 0.09, 40001)
    numeric = np.trapezoid([vertical_force(d, *law) for d in deflections], deflections)
    assert vertical_energy(0.09, *law) == pytest.approx(float(numeric), rel=1e-6)


def test_slopes_at_the_origin_are_the_stiffnesses() -> None:
    small = 1e-6
    assert fiala_forces(NORMAL, small, 0.0, *LAWS)[0] / small == pytest.approx(LAWS[0], rel=1e-9)
    assert fiala_forces(NORMAL, 0.0, small, *LAWS)[1] / small == pytest.approx(-LAWS[1], rel=1e-4)


def test_branches_of_both_forces_meet() -> None:
    low, high = 0.0, 1.0
    for _ in range(60):  # kappa* = U(kappa*) F_z / (2 C_slip), the friction falls with the slip
        middle = (low + high) / 2
        friction = (0.8 - 0.3 * middle) * NORMAL
        low, high = (middle, high) if middle < friction / (2 * LAWS[0]) else (low, middle)
    before = fiala_forces(NORMAL, low * (1 - 1e-9), 0.0, *LAWS)[0]
    after = fiala_forces(NORMAL, low * (1 + 1e-9), 0.0, *LAWS)[0]
    assert before == pytest.approx(after, rel=1e-7)
    low, high = 0.0, 1.0
    for _ in range(60):  # tan(alpha*) = 3 U F_z / C_alpha
        middle = (low + high) / 2
        friction = (0.8 - 0.3 * middle) * NORMAL
        low, high = (middle, high) if middle < 3 * friction / LAWS[1] else (low, middle)
    before, after = (
        fiala_forces(NORMAL, 0.0, low * (1 + sign * 1e-9), *LAWS)[1:] for sign in (-1, 1)
    )
    assert before == pytest.approx(after, rel=1e-6, abs=1e-6)


def test_locked_wheel_brakes_with_the_sliding_friction() -> None:
    # Closed form: -(U_min F_z - (U_min F_z)^2 / (4 C_slip)) at kappa = -1.
    available = 0.5 * NORMAL
    expected = -(available - available**2 / (4 * LAWS[0]))
    assert fiala_forces(NORMAL, -1.0, 0.0, *LAWS)[0] == pytest.approx(expected, rel=1e-13)


def test_forces_are_odd_in_their_slips() -> None:
    for kappa, tangent in ((0.02, 0.05), (0.4, 0.1), (-0.9, 0.3)):
        x, y, z = fiala_forces(NORMAL, kappa, tangent, *LAWS)
        assert fiala_forces(NORMAL, -kappa, tangent, *LAWS) == pytest.approx((-x, y, z))
        assert fiala_forces(NORMAL, kappa, -tangent, *LAWS) == pytest.approx((x, -y, -z))


def test_resultant_stays_within_the_friction_circle() -> None:
    generator = np.random.default_rng(1)
    for _ in range(500):
        kappa, tangent = generator.uniform(-1, 1, 2)
        friction = 0.8 - 0.3 * min(1.0, math.hypot(kappa, tangent))
        x, y, _ = fiala_forces(NORMAL, kappa, tangent, *LAWS)
        assert math.hypot(x, y) <= friction * NORMAL * (1 + 1e-12)


def test_sliding_locked_wheel_is_pushed_against_its_sliding() -> None:
    # A locked wheel in a drift of 1 deg slides almost straight ahead: hardly any side force.
    x, y, _ = fiala_forces(NORMAL, -1.0, math.tan(math.radians(1.0)), *LAWS)
    assert abs(y / x) < 0.05
    rolling = fiala_forces(NORMAL, 0.0, math.tan(math.radians(1.0)), *LAWS)[1]
    assert abs(y) < 0.3 * abs(rolling)


def test_aligning_moment_turns_the_wheel_into_its_motion() -> None:
    _, side, moment = fiala_forces(NORMAL, 0.0, 0.03, *LAWS)
    assert side < 0 < moment
    assert fiala_forces(NORMAL, 0.0, 0.9, *LAWS)[2] == 0.0


def test_slips_are_regular_through_standstill() -> None:
    assert slips(50.0, 50.0, 0.0) == (-1.0, 0.0)
    assert slips(50.0, 0.0, 5.0) == pytest.approx((0.0, 0.1))
    assert slips(0.0, 0.0, 0.0) == (0.0, 0.0)
    assert slips(0.1 * SLIP_SPEED, 0.1 * SLIP_SPEED, 0.0) == pytest.approx((-0.1, 0.0))


def test_rolling_resistance_opposes_rolling_and_fades_at_rest() -> None:
    assert rolling_moment(1e4, 20.0, 0.005) == pytest.approx(50.0)
    assert rolling_moment(1e4, -20.0, 0.005) == pytest.approx(-50.0)
    assert rolling_moment(1e4, 0.0, 0.005) == 0.0


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"minimum_friction": 0.9}, "must not exceed"),
        ({"vertical_exponent": 0.5}, "vertical_exponent"),
        ({"count": 0}, "count"),
        ({"wheel_inertia": 0.0}, "wheel_inertia"),
    ],
)
def test_impossible_tyre_is_refused(changes: dict[str, object], words: str) -> None:
    with pytest.raises(ModelError, match=words):
        tyre(**changes)
