"""The drop test against a converged solution of its equations and an independent integration.

The reference figures are a converged solution (relative tolerance 1e-13; four independent codes
agree to 7 digits) of the equations of NACA Report 1154 for the parameters of the example file.
They are not values measured or plotted in the report.
"""

import json
from pathlib import Path

import pytest

from app.cli.drop_test import DropTestFile
from solver.errors import RecordError, StrutBottomedError
from solver.gear.drop_test import GRAVITY, DropTestParameters, DropTestResult, drop_test
from tests.solver.gear.stopper_form import stopper_form

EXAMPLE = Path(__file__).parents[3] / "examples" / "drop_test_naca1154.json"


def given(**changes: float) -> dict[str, float]:
    values: dict[str, float] = json.loads(EXAMPLE.read_text())
    return values | changes


def run(**changes: float) -> DropTestResult:
    return drop_test(DropTestFile.model_validate(given(**changes)).parameters())


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("breakout_time", 0.007779224057116814),
        ("peak_ground_force", 28872.124114448885),
        ("peak_ground_force_time", 0.10069241838763579),
        ("maximum_stroke", 0.1605928622358049),
        ("maximum_stroke_time", 0.19273100991527575),
        ("peak_tyre_deflection", 0.1383782180721162),
        ("maximum_closure_speed", 1.2013958658508077),
        ("peak_upper_acceleration", 2.557976358480361 * GRAVITY),
    ],
)
def test_agrees_with_the_converged_solution(name: str, value: float) -> None:
    # The parameter file rounds the report's units to ten digits, the reference to fewer.
    assert getattr(run(), name) == pytest.approx(value, rel=2e-6)


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"contact_speed_m_s": 3.5448},
        {"contact_speed_m_s": 1.2},
        {"lift_ratio": 2 / 3},
        {"lift_ratio": 0.0},
        {"polytropic_exponent": 1.4, "discharge_coefficient": 0.8},
        {"tyre_exponent": 1.1, "tyre_coefficient_n_per_m_r": 2.5e5},
        {"orifice_area_m2": 1.0e-4, "upper_mass_kg": 700.0},
        {"initial_gas_pressure_pa": 1.5e6, "lower_mass_kg": 90.0},
    ],
)
def test_agrees_with_the_stopper_form(changes: dict[str, float]) -> None:
    # The stopper's finite stiffness moves the peaks by some 1e-5 (force) and 1e-4 (stroke).
    expected, found = stopper_form(given(**changes)), run(**changes)
    assert found.peak_ground_force == pytest.approx(expected.ground_force, rel=2e-4)
    assert found.peak_ground_force_time == pytest.approx(expected.ground_force_time, abs=2e-4)
    assert found.maximum_stroke == pytest.approx(expected.stroke, rel=5e-4)
    assert found.peak_tyre_deflection == pytest.approx(expected.tyre_deflection, rel=2e-4)
    assert found.maximum_closure_speed == pytest.approx(expected.closure_speed, rel=2e-4)
    assert found.peak_upper_acceleration == pytest.approx(expected.upper_acceleration, rel=4e-4)


def test_breakout_is_where_the_rigid_gear_transmits_its_preload() -> None:
    # Lift = weight: the speed at break-out follows from energy alone, closed form.
    values = given()
    parameters = DropTestFile.model_validate(values).parameters()
    force = parameters.breakout_force
    mass = parameters.mass
    expected_force = (
        mass / parameters.upper_mass * (parameters.preload + parameters.lower_mass * GRAVITY)
    )
    assert force == pytest.approx(expected_force, rel=1e-14)
    z = (force / parameters.tyre_coefficient) ** (1 / parameters.tyre_exponent)
    assert z == pytest.approx(0.020992510452256852, rel=1e-6)
    history = drop_test(parameters).history
    index = int((history.stroke > 0).argmax()) - 1
    assert history.tyre_deflection[index] == pytest.approx(z, rel=1e-6)


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"lift_ratio": 0.0, "contact_speed_m_s": 1.2, "orifice_area_m2": 3.0e-4},
        {"initial_gas_pressure_pa": 3e6, "lift_ratio": 0.0, "contact_speed_m_s": 0.6},
        {"initial_gas_pressure_pa": 3e6, "orifice_area_m2": 3e-4},
    ],
)
def test_energy_closes(changes: dict[str, float]) -> None:
    assert run(**changes).energy_error < 1e-8


def test_strut_locks_again_at_full_extension_and_goes_on_rigid() -> None:
    result = run(contact_speed_m_s=1.2, orifice_area_m2=1.5e-4)
    history = result.history
    after = history.time > (result.maximum_stroke_time or 0.0)
    at_rest = (after & (history.stroke < 1e-12)).nonzero()[0][1:]  # the first one still arrives
    assert len(at_rest) > 5
    # Rigid again: both masses move alike, and the stroke never becomes negative.
    assert abs(history.closure_speed[at_rest]).max() < 1e-9
    assert history.stroke.min() > -1e-9
    assert history.tyre_deflection[-1] == pytest.approx(0.0, abs=1e-6)


def test_preload_that_is_never_exceeded_leaves_a_rigid_bounce() -> None:
    result = run(contact_speed_m_s=0.05)
    assert result.breakout_time is None
    assert result.maximum_stroke_time is None
    assert result.maximum_stroke == 0.0
    assert result.maximum_closure_speed == 0.0
    # Lift = weight: all kinetic energy goes into the tyre, m z^(r+1) / (r+1).
    values = given()
    mass = values["upper_mass_kg"] + values["lower_mass_kg"]
    m, r = values["tyre_coefficient_n_per_m_r"], values["tyre_exponent"]
    depth = ((r + 1) * 0.5 * mass * 0.05**2 / m) ** (1 / (r + 1))
    assert result.peak_tyre_deflection == pytest.approx(depth, rel=1e-8)
    assert result.peak_ground_force == pytest.approx(m * depth**r, rel=1e-8)


def test_gas_volume_limits_the_stroke() -> None:
    result = run(orifice_area_m2=5e-4)
    assert 0.95 * 0.18756 < result.maximum_stroke < 0.18756


def test_used_up_gas_volume_is_an_error_not_an_invented_stop() -> None:
    with pytest.raises(StrutBottomedError, match=r"0\.1876 m"):
        run(polytropic_exponent=0.0, orifice_area_m2=5e-4)


def test_impossible_parameters_are_refused() -> None:
    values = DropTestFile.model_validate(given()).parameters()
    names = {name: getattr(values, name) for name in values.__slots__}
    with pytest.raises(RecordError, match="lower_mass"):
        DropTestParameters(**(names | {"lower_mass": 0.0}))
