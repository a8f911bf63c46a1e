"""What the chapter of whole landings computes from analyses, on the small test aircraft."""

import numpy as np
import pytest

from solver.aircraft.airframe import load_airframe
from solver.inertia_relief.build import reduced_model
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.response import landing_response
from verification.run import Run
from verification.tables.agreement import (
    Crest,
    Followed,
    crest,
    field_agreements,
    maxima,
    relative,
)
from verification.tables.analyses import Analysis, full_order, nonlinear, reduced, reduced_stress
from verification.tables.figures import wheel_height
from verification.tables.landings import INSTANTS, PAPER, Landed, landed
from verification.tables.largest import TOLERANCE
from verification.tables.panels import PanelStability
from verification.tables.submodel import panel_stress

DURATION = 0.06


@pytest.fixture(scope="module")
def airframe(aircraft_folder):
    return load_airframe(aircraft_folder / "mini")


@pytest.fixture(scope="module")
def model(airframe, cache_folder) -> ReducedModel:
    return reduced_model(airframe, cache_folder)


@pytest.fixture(scope="module")
def touchdown(airframe) -> Landed:
    return landed(airframe, PAPER, DURATION)


@pytest.fixture(scope="module")
def followed(airframe, model, touchdown, tmp_path_factory) -> Followed:
    run = Run(tmp_path_factory.mktemp("tables"))
    return Followed(
        touchdown,
        nonlinear(run, airframe, touchdown),
        full_order(run, airframe, touchdown),
        reduced(model, touchdown),
    )


def test_fields_are_kept_at_the_instants_and_at_each_gear_s_peak(touchdown):
    time = touchdown.loads.time
    np.testing.assert_allclose(
        time[touchdown.instants], DURATION * np.array(INSTANTS), atol=0.5 * time[1]
    )
    by_name = {gear.name: gear for gear in touchdown.history.gears}
    assert len(touchdown.peaks) >= 1
    for peak in touchdown.peaks:
        upward = -by_name[peak.gear].ground_force[: len(time), 2]
        assert upward[peak.sample] == upward.max() == peak.force
        assert touchdown.wanted[touchdown.field(peak)] == peak.sample


def test_pressed_wheel_is_below_the_ground_by_its_deflection(airframe, touchdown):
    gears = airframe.landing_aircraft(touchdown.factors).gears
    for gear, found in zip(gears, touchdown.history.gears, strict=True):
        height = wheel_height(touchdown.history, gear, found)
        # the leg swings by up to 0.02 rad, which lifts the wheel of a leg of 1.5 m by 0.3 mm
        np.testing.assert_allclose(np.maximum(-height, 0.0), found.tyre_deflection, atol=5e-4)


def test_largest_stresses_are_those_of_the_fields(followed):
    for _, analysis in followed.analyses:
        at = followed.landed.wanted
        np.testing.assert_allclose(analysis.fields.max(axis=1), analysis.largest[at], rtol=1e-5)
        assert np.all(analysis.peak >= analysis.fields.max(axis=0) * (1 - 1e-5))
        assert analysis.peak.max() == pytest.approx(analysis.largest.max(), rel=1e-5)


def test_reduced_stress_is_what_the_peak_search_finds(model, touchdown):
    response = landing_response(assemble(model, touchdown.factors), touchdown.loads)
    every = reduced_stress(model, response.coordinates)
    np.testing.assert_allclose(every.max(axis=1), find_peaks(model, response).stress, rtol=2e-5)


def test_analyses_agree_on_a_soft_landing(airframe, followed):
    for maximum in maxima(airframe, followed):
        first, full, fast = maximum.stresses
        assert full == pytest.approx(first, rel=TOLERANCE)
        assert fast == pytest.approx(full, rel=TOLERANCE)
        assert (maximum.standing == 1.0) == maximum.is_same
    assert followed.nonlinear.drift.max() < np.radians(0.5)
    for found in field_agreements(airframe, followed):
        assert found.correlation > 0.999


def test_crest_of_a_swing_is_found_uphill_and_only_of_its_element():
    time = np.linspace(0.0, 1.0, 101)
    wave = 100.0 + 10.0 * np.sin(2 * np.pi * time)  # crest at 0.25
    element = np.where(time < 0.6, 4, 9)
    swing = Analysis(np.zeros(10), wave, element, np.zeros((1, 10)), 0.0)
    for sample in (5, 25, 40):
        assert crest(swing, time, sample) == Crest(pytest.approx(0.25), pytest.approx(110.0))
    # uphill of 0.62 the other element takes over at once
    assert crest(swing, time, 62).time == pytest.approx(0.6)


def test_critical_factor_is_inverse_to_the_stress(airframe, followed):
    displacement = followed.full.displacements[0]
    element = int(followed.full.stress.fields[0].argmax())
    once, twice = (
        PanelStability(airframe, followed.landed.factors, size * displacement).factor(element)
        for size in (1.0, 2.0)
    )
    assert once > 0
    assert twice == pytest.approx(once / 2, rel=1e-4)


def test_panel_of_small_loads_has_the_linear_stress(airframe, followed):
    field, displacement = followed.full.stress.fields[0], followed.full.displacements[0]
    for element in (int(field.argmax()), int(np.argsort(field)[-20])):
        small = panel_stress(airframe, 1e-3 * displacement, element)
        assert small == pytest.approx(1e-3 * field[element], rel=1e-3)


def test_panel_under_the_landing_s_loads_has_the_nonlinear_stress(airframe, followed):
    fields = followed.nonlinear.stress.fields[0], followed.full.stress.fields[0]
    displacement = followed.full.displacements[0]
    element = int(fields[0].argmax())
    found = panel_stress(airframe, displacement, element)
    # The small aircraft hardly differs from a linear one.
    assert found == pytest.approx(fields[0][element], rel=0.02)
    turned = displacement + airframe.structure.rigid_modes(np.zeros(3)) @ (0.02 * np.ones(6))
    assert panel_stress(airframe, turned, element) == pytest.approx(found, rel=1e-6)


def test_stored_analyses_are_taken_again(airframe, touchdown, followed, tmp_path):
    run = Run(tmp_path)
    first = full_order(run, airframe, touchdown)
    again = full_order(run, airframe, touchdown)
    assert [result.is_earlier for result in run.taken] == [False, True]
    np.testing.assert_array_equal(first.stress.fields, again.stress.fields)
    np.testing.assert_array_equal(first.stress.peak, followed.full.stress.peak)


def test_membrane_compression_is_the_smaller_principal_stress(airframe, followed):
    row = followed.landed.field(followed.landed.peaks[0])
    full, recovery = followed.full, airframe.recovery
    rows = recovery.shell_operator @ full.displacements[row]
    faces = rows.reshape(-1, 2, 3)
    tensors = np.zeros((len(faces), 2, 2))
    mean = faces.mean(axis=1)
    tensors[:, 0, 0], tensors[:, 1, 1] = mean[:, 0], mean[:, 1]
    tensors[:, 0, 1] = tensors[:, 1, 0] = mean[:, 2]
    expected = np.linalg.eigvalsh(tensors)[:, 0]
    np.testing.assert_allclose(full.compression[row], expected, atol=1e-9 * np.abs(rows).max())


def test_relative_difference_of_an_unstressed_element_is_no_infinity():
    found = relative(np.array([2.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0]))
    assert np.all(np.isfinite(found))
    assert found[0] == 1.0
