import numpy as np
import pytest

from solver.errors import ModelError
from solver.gear.oleo import (
    area_ratio,
    friction_force,
    gas_energy,
    gas_force,
    hydraulic_force,
    oleo_force,
    stop_force,
)
from solver.gear.parameters import Strut, hydraulic_coefficient


def strut(**changes: object) -> Strut:
    """Main strut of the example business jet."""
    values: dict[str, object] = {
        "pneumatic_area": 5.39e-3,
        "initial_gas_pressure": 2.58e6,
        "initial_gas_volume": 2.234e-3,
        "polytropic_exponent": 1.1,
        "compression_coefficient": 1.0e4,
        "rebound_coefficient": 4.0e4,
        "full_stroke": 0.38,
        "extended_length": 1.15,
    }
    return Strut(**(values | changes))  # type: ignore[arg-type]


def test_hydraulic_coefficient_of_naca_1154_in_report_units() -> None:
    # 344.8771843716316 lb s2/ft2: an independent evaluation of rho A_h^3 / (2 (C_d A_n)^2).
    value = hydraulic_coefficient(1.67, 0.04708, 0.9, 0.0005585)
    assert value == pytest.approx(344.8771843716316, rel=1e-12)


def test_gas_follows_the_polytropic_law() -> None:
    one = strut()
    half_volume = 0.5 * one.initial_gas_volume / one.pneumatic_area
    force = gas_force(half_volume, 5.39e-3, 2.58e6, 2.234e-3, 1.1)
    assert force == pytest.approx(one.preload * 2**1.1, rel=1e-13)
    assert gas_force(0.0, 5.39e-3, 2.58e6, 2.234e-3, 1.1) == pytest.approx(one.preload, rel=1e-15)


@pytest.mark.parametrize("exponent", [0.5, 1.0, 1.1, 1.4])
def test_gas_energy_is_the_integral_of_its_force(exponent: float) -> None:
    strokes = np.linspace(0.0, 0.38, 20001)
    forces = [gas_force(s, 5.39e-3, 2.58e6, 2.234e-3, exponent) for s in strokes]
    numeric = float(np.trapezoid(forces, strokes))
    assert gas_energy(0.38, 5.39e-3, 2.58e6, 2.234e-3, exponent) == pytest.approx(numeric, rel=1e-6)


def test_oil_has_its_own_orifice_in_rebound() -> None:
    assert hydraulic_force(2.0, 1.0e4, 4.0e4) == pytest.approx(4.0e4)
    assert hydraulic_force(-2.0, 1.0e4, 4.0e4) == pytest.approx(-16.0e4)


def test_metering_pin_divides_by_the_square_of_the_area_ratio() -> None:
    metered = strut(metering=((0.0, 1.0), (0.2, 0.5), (0.38, 0.5)))
    plain = strut()
    at, rate = np.array([0.0, 0.1, 0.2, 0.3]), np.array([1.0, 1.0, 1.0, 1.0])
    extra = oleo_force(at, rate, metered) - oleo_force(at, rate, plain)
    expected = 1.0e4 * (1 / np.array([1.0, 0.75, 0.5, 0.5]) ** 2 - 1)
    assert extra == pytest.approx(expected, abs=1e-6)


def test_area_ratio_is_constant_beyond_the_table() -> None:
    strokes, ratios = np.array([0.1, 0.2]), np.array([0.8, 0.4])
    assert area_ratio(0.0, strokes, ratios, 2) == 0.8
    assert area_ratio(0.15, strokes, ratios, 2) == pytest.approx(0.6)
    assert area_ratio(0.9, strokes, ratios, 2) == 0.4
    assert area_ratio(0.9, strokes, ratios, 0) == 1.0


def test_extension_stop_carries_the_preload_within_a_millimetre() -> None:
    one = strut()
    deflection = one.preload / one.stop_stiffness
    assert deflection < 1e-3
    # The gas has a little more room there: its force falls by n A_a s / V_0, 0.2 %.
    assert oleo_force(np.array([-deflection]), np.array([0.0]), one)[0] == pytest.approx(
        0.0, abs=0.003 * one.preload
    )


def test_closed_stop_is_stiff_and_starts_from_zero() -> None:
    one = strut()
    s = np.array([0.38, 0.381])
    gas = np.array([gas_force(x, 5.39e-3, 2.58e6, 2.234e-3, 1.1) for x in s])
    assert oleo_force(s, np.zeros(2), one) - gas == pytest.approx([0.0, 2.0e4], abs=1e-6)


def test_stop_never_gives_energy_over_a_closed_cycle() -> None:
    generator = np.random.default_rng(1154)
    for _ in range(50):
        phase = np.linspace(0.0, 2 * np.pi, 4001)
        mean, first, second = generator.uniform(-1e-3, 2e-3, 3)
        speed = 10 ** generator.uniform(0, 3)
        depth = mean + first * np.sin(phase) + second * np.sin(2 * phase + mean)
        rate = speed * (first * np.cos(phase) + 2 * second * np.cos(2 * phase + mean))
        damping = generator.uniform(0.0, 5.0)
        force = np.array([stop_force(d, r, 2e7, damping) for d, r in zip(depth, rate, strict=True)])
        assert np.all(force >= 0)
        work_on_the_stop = float(np.trapezoid(force * rate / speed, phase))
        assert work_on_the_stop >= -1e-6 * 2e7 * 1e-6


def test_friction_is_off_by_default_and_opposes_motion() -> None:
    assert strut().seal_friction == 0.0
    assert friction_force(1.0, 500.0, 0.01) == pytest.approx(500.0)
    assert friction_force(-1.0, 500.0, 0.01) == pytest.approx(-500.0)
    assert friction_force(0.0, 500.0, 0.01) == 0.0


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"pneumatic_area": -1.0}, "pneumatic_area must be above 0"),
        ({"rebound_coefficient": float("nan")}, "rebound_coefficient"),
        ({"full_stroke": 0.42}, "gas volume is used up"),
        ({"metering": ((0.2, 1.0), (0.1, 1.0))}, "must ascend"),
        ({"metering": ((0.0, 0.0),)}, "above 0"),
    ],
)
def test_impossible_strut_is_refused(changes: dict[str, object], words: str) -> None:
    with pytest.raises(ModelError, match=words):
        strut(**changes)
