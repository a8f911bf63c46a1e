"""Sizing: the ratio rule, and the loads of the design cases."""

import numpy as np
import pytest

from solver.aircraft.airframe import Airframe
from solver.aircraft.bizjet.catalogue import Bay
from solver.aircraft.bizjet.families import FAMILY
from solver.arrays import Array
from solver.sizing.cases import AppliedLoads, design_cases, telling
from solver.sizing.iteration import (
    LARGEST_GROWTH,
    LARGEST_STEP,
    MAGNIFICATION,
    TARGET,
    bay_utilisations,
    magnification,
    resized,
)
from solver.sizing.stress import static_utilisations

RIBS = Bay("wing ribs", "strip 03 rear")
STRINGERS = Bay("wing stringers", "upper strip 01 front")


@pytest.fixture(scope="module")
def cases(airframe: Airframe) -> list[AppliedLoads]:
    return design_cases(airframe)


def resultant(airframe: Airframe, case: AppliedLoads) -> Array:
    """Force of all pins and the air, (n_samples, 3)."""
    return case.amplitudes.reshape(len(case.amplitudes), -1, 6)[:, :, :3].sum(axis=1)


def test_a_bay_near_its_target_is_left_alone() -> None:
    assert resized(RIBS, 2e-3, TARGET) == 2e-3


@pytest.mark.parametrize("bay", [RIBS, STRINGERS])
def test_gauges_follow_the_utilisation_within_a_step(bay: Bay) -> None:
    family = FAMILY[bay.family]
    gauge = 2 * family.minimum
    assert gauge < resized(bay, gauge, 1.1) < gauge * LARGEST_STEP
    assert gauge / LARGEST_STEP < resized(bay, gauge, 0.8) < gauge
    assert resized(bay, gauge, 50.0) == pytest.approx(gauge * LARGEST_STEP, rel=0.04)


def test_gauges_keep_to_their_limits() -> None:
    family = FAMILY[RIBS.family]
    assert resized(RIBS, family.minimum, 0.0) == pytest.approx(family.minimum)
    largest = LARGEST_GROWTH * family.gauge
    assert resized(RIBS, largest, 9.0) == pytest.approx(largest)


def test_repeated_resizing_meets_the_target_of_a_membrane() -> None:
    # A panel that carries a constant force: utilisation = force / gauge.
    gauge, force = 1.5e-3, 3.3e-3 * TARGET
    for _ in range(30):
        gauge = resized(RIBS, gauge, force / gauge)
    assert force / gauge == pytest.approx(TARGET, rel=0.04)
    assert force / gauge <= 1.0


def test_bay_takes_the_worst_of_both_sides() -> None:
    worst = bay_utilisations([RIBS, STRINGERS, RIBS], np.array([0.2, 0.9, 0.7]))
    assert worst == {RIBS: 0.7, STRINGERS: 0.9}


def test_magnification_is_the_ratio_of_peaks_where_there_is_stress(
    cases: list[AppliedLoads],
) -> None:
    landings = [case.landing is not None for case in cases]
    static = np.where(np.array(landings)[:, None], [[0.5, 0.4, 0.01]], 9.0)
    dynamic = np.where(np.array(landings)[:, None], [[0.6, 9.0, 0.05]], 0.0)
    assert magnification(cases, static, dynamic) == pytest.approx([1.2, MAGNIFICATION[1], 1.0])


def test_early_samples_are_close_together() -> None:
    chosen = telling(np.arange(0, 4.0, 1e-3))
    assert np.all(np.diff(chosen) > 0)
    assert np.diff(chosen)[:80].max() == 5
    assert chosen[-1] > 3900


def test_cases_carry_what_their_rules_say(airframe: Airframe, cases: list[AppliedLoads]) -> None:
    by_name = {case.name: case for case in cases}
    weight = 12_292.0 * 9.80665
    unsprung = 218.0 * 9.80665
    # 25.473(b): lift equals weight, so the gears add whatever the resultant has beyond it.
    drift = resultant(airframe, by_name["drift (25.479(d)(2))"])[0]
    vertical = drift[2] - weight
    assert drift[0] == pytest.approx(0.40 * vertical)
    assert drift[1] == pytest.approx(0.25 * vertical)
    side = resultant(airframe, by_name["side load (25.485)"])[0]
    assert side[1] == pytest.approx(0.7 * (side[2] - weight))
    # 0.75 of the largest main gear load twice, against half of it twice.
    assert vertical == pytest.approx(1.5 * (side[2] - weight))
    braked = resultant(airframe, by_name["braked roll, 1.2 g (25.493(b))"])[0]
    assert braked[2] == pytest.approx(1.2 * weight, rel=1e-6)
    pull = resultant(airframe, by_name["2.5 g, take-off mass"])[0]
    assert pull[2] == pytest.approx(2.5 * (13_743.0 * 9.80665 - unsprung), rel=1e-4)
    push = resultant(airframe, by_name["-1 g, take-off mass"])[0]
    assert push == pytest.approx(-pull / 2.5)


def test_empennage_cases_add_one_tail_load_to_level_flight(
    airframe: Airframe, cases: list[AppliedLoads]
) -> None:
    by_name = {case.name: case for case in cases}
    up, down = (
        by_name[f"pitching manoeuvre, tail {way} (25.331)"].amplitudes[0] for way in ("up", "down")
    )
    level = (up + down) / 2
    assert level[-4] == pytest.approx(12_292.0 * 9.80665, rel=1e-6)
    # A vertical force at station x has the moment -x F about the origin.
    force, moment = (up - level)[-4], (up - level)[-2]
    assert -moment / force == pytest.approx(18.0, abs=0.5)
    gust = (by_name["lateral gust (25.341)"].amplitudes[0] - level)[-6:]
    assert 5e3 < gust[1] < 40e3
    assert gust[5] / gust[1] == pytest.approx(16.30, abs=0.01)
    assert -gust[3] / gust[1] == pytest.approx(4.217, abs=0.01)


def test_one_gear_case_keeps_one_main_gear_only(
    airframe: Airframe, cases: list[AppliedLoads]
) -> None:
    by_name = {case.name: case for case in cases}
    level, single = by_name["two wheels, 10 ft/s"], by_name["one gear (25.483)"]
    pins = single.amplitudes[:, :-6].reshape(len(single.amplitudes), -1, 6)
    loaded = np.abs(pins).max(axis=(0, 2)) > 0
    assert loaded.tolist() == [False] * 7 + [True] * 3
    assert np.array_equal(single.amplitudes[:, -24:], level.amplitudes[:, -24:])


def test_static_stress_of_symmetric_cases_is_symmetric(
    airframe: Airframe, cases: list[AppliedLoads]
) -> None:
    chosen = [case for case in cases if case.name.endswith("g, take-off mass")]
    pull, push = static_utilisations(airframe, chosen).stress
    # Linear: -1 g gives 1 / 2.5 of the stress of 2.5 g.
    assert pull == pytest.approx(2.5 * push, rel=1e-9, abs=1e-9)
    sides = np.array([zone.side for zone in airframe.definition.zones])[airframe.element_zone]
    port, starboard = np.sort(pull[sides == "port"]), np.sort(pull[sides == "starboard"])
    assert port == pytest.approx(starboard, rel=1e-4, abs=1e-6)
