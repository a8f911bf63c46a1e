"""The gear chapter's means: they agree with the solver, and would notice if they did not."""

from pathlib import Path

import numpy as np
import pytest

from solver.gear.drop_test import drop_test
from solver.gear.parameters import Tyre
from verification.chapters import gear
from verification.gear.digitised import DigitisedCurve, digitised_curves
from verification.gear.naca1154 import CERTAINTY, POUND_FORCE, DropTestSet
from verification.gear.one_gear_landing import ground_force, one_gear_landing
from verification.gear.strut_laws import oleo_comparisons, oleo_plot
from verification.gear.two_phase import two_phase_solution
from verification.gear.tyre_laws import tyre_comparisons, tyre_plot

GIVEN = DropTestSet()


@pytest.fixture(scope="module")
def drops() -> gear._DropTests:
    parameters = GIVEN.in_si()
    return gear._DropTests(
        GIVEN,
        two_phase_solution(GIVEN),
        drop_test(parameters),
        one_gear_landing(parameters, gear.DURATION),
    )


def test_three_ways_of_the_drop_agree(drops: gear._DropTests) -> None:
    rows = (*gear._drop_comparisons(drops), *gear._landing_comparisons(drops))
    rows += gear._energy_comparisons(drops)
    assert len(rows) == 14
    assert [row.name for row in rows if not row.holds] == []


def test_breakout_follows_from_energy_alone(drops: gear._DropTests) -> None:
    # Lift = weight and tyre force far below weight: time of a nearly free flight, z / V at least.
    reference = drops.reference
    free = reference.breakout_deflection / (GIVEN.contact_speed * 0.3048)
    assert free < reference.breakout_time < 1.002 * free


def test_another_orifice_would_be_noticed(drops: gear._DropTests) -> None:
    changed = drop_test(GIVEN.changed("discharge_coefficient", 1 + 1e-6).in_si())
    rows = gear._drop_comparisons(gear._DropTests(GIVEN, drops.reference, changed, drops.landing))
    assert not all(row.holds for row in rows)


def test_parameters_in_si_are_those_of_the_report() -> None:
    si = GIVEN.in_si()
    assert si.mass == pytest.approx(2542 * 0.45359237)
    assert si.initial_gas_pressure == pytest.approx(43.5 * 6894.757293168, rel=1e-9)  # 43.5 psi
    assert si.stroke_limit == pytest.approx(0.03545 / 0.05761 * 0.3048)
    # F = m z^r gives m lb at one foot.
    force = si.tyre_coefficient * 0.3048**si.tyre_exponent
    assert force == pytest.approx(18.7e3 * POUND_FORCE)


def test_every_parameter_states_its_certainty() -> None:
    assert {value.name for value in CERTAINTY} == set(DropTestSet.__slots__)


def test_budget_adds_the_effects_of_what_is_uncertain(drops: gear._DropTests) -> None:
    table, total = gear._budget(GIVEN, drops.found)
    effects = [float(row[-1].replace("−", "-")) for row in table.rows if row[-1] != "–"]
    assert len(effects) == sum(value.spread > 0 for value in CERTAINTY)
    assert 100 * total == pytest.approx(np.linalg.norm(effects), rel=0.02)
    assert 0.03 < total < 0.06


def test_softer_stop_moves_the_landing_away(drops: gear._DropTests) -> None:
    parameters = GIVEN.in_si()
    errors = []
    for stiffness in (1e7, 1e8):
        history = one_gear_landing(parameters, 0.15, stiffness)
        errors.append(abs(ground_force(history).max() / drops.reference.peak_ground_force - 1))
    assert errors[0] > 5 * errors[1]


def test_force_laws_meet_their_limits() -> None:
    main = Tyre(
        free_radius=0.27559,
        vertical_coefficient=3137586.387933475,
        vertical_exponent=1.3329835268010592,
        longitudinal_stiffness=315823.7,
        cornering_stiffness=189494.2,
        maximum_friction=0.8,
        minimum_friction=0.5,
        width=0.141605,
        wheel_inertia=1.1,
        count=2,
        bottoming_deflection=0.07239,
    )
    rows = (*oleo_comparisons(GIVEN.in_si()), *tyre_comparisons({"main": main}))
    assert [row.name for row in rows if not row.holds] == []
    assert oleo_plot(GIVEN.in_si()).format == tyre_plot(main, "main gear").format == "svg"


def write_curve(folder: Path, name: str, text: str) -> None:
    (folder / f"naca1154-{name}.csv").write_text(text)


def test_no_digitised_curve_is_none(tmp_path: Path) -> None:
    assert digitised_curves(tmp_path) == ()


def test_digitised_curves_come_in_si(tmp_path: Path) -> None:
    write_curve(tmp_path, "force", "# Fig. 1\ntime_s,ground_force_lb\n0.0,0\n0.1,1000\n")
    write_curve(tmp_path, "stroke", "time_s, stroke_in\n0.0,0\n0.1,5\n")
    force, stroke = digitised_curves(tmp_path)
    assert force.value[-1] == pytest.approx(1000 * POUND_FORCE)
    assert stroke.value[-1] == pytest.approx(0.127)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "time,force\n0,0\n1,1\n",
        "time_s,ground_force_n\n0,0\n",
        "time_s,ground_force_n\n1,0\n0,1\n",
    ],
)
def test_digitised_file_of_another_form_is_refused(tmp_path: Path, text: str) -> None:
    write_curve(tmp_path, "force", text)
    with pytest.raises(ValueError, match=r"naca1154-force\.csv"):
        digitised_curves(tmp_path)


def test_digitised_curves_are_compared_within_the_budget(drops: gear._DropTests) -> None:
    history = drops.found.history
    time = np.linspace(0.01, 0.25, 30)
    force = np.interp(time, history.time, history.ground_force)
    near, far = (
        gear._digitised(drops, (DigitisedCurve("force", time, factor * force),), 0.04)[0]
        for factor in (1.02, 1.2)
    )
    assert near.holds
    assert not far.holds
