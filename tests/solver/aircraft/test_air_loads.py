"""Air-load shapes: exact resultants, and loads where the aircraft would carry them."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.aircraft.air_loads import air_load_shapes, schrenk_lift
from solver.aircraft.definition import IdentifierSet, LoadedSkin, Planform
from solver.errors import ModelError

WRENCH = st.lists(st.floats(-1e6, 1e6), min_size=6, max_size=6).map(np.array)


def nodal_forces(mini, load):
    """Forces (n, 3) on free nodes; the mini's skins hang on free nodes but for the roots."""
    everywhere = np.zeros(6 * mini.structure.model.node_count)
    everywhere[mini.structure.free] = load
    return everywhere.reshape(-1, 6)[:, :3]


def test_resultants_about_the_structural_origin_are_the_unit_wrenches(mini):
    modes = mini.structure.rigid_modes(np.zeros(3))
    np.testing.assert_allclose(modes.T @ mini.air_shapes, np.eye(6), atol=1e-12)


@settings(max_examples=25, deadline=None)
@given(wrench=WRENCH, place=st.lists(st.floats(-20.0, 20.0), min_size=3, max_size=3).map(np.array))
def test_any_wrench_keeps_its_resultant_about_any_point(mini, wrench, place):
    load = mini.air_shapes @ wrench
    resultant = mini.structure.rigid_modes(place).T @ load
    expected = wrench.copy()
    expected[3:] -= np.cross(place, wrench[:3])
    scale = 1.0 + np.abs(wrench).max() * 40.0
    np.testing.assert_allclose(resultant, expected, atol=1e-12 * scale)


def test_lift_at_the_wings_own_centre_loads_only_the_wing(mini):
    """The tail's share is linear in the station of the lift; where it vanishes, only wing lifts."""
    tail = mini.structure.model.coordinates[:, 0] > 17.5
    ahead, behind = (
        nodal_forces(mini, mini.air_shapes @ lift_at(station, 1.0))[tail, 2].sum()
        for station in (9.0, 11.0)
    )
    centre = 9.0 + 2.0 * ahead / (ahead - behind)
    forces = nodal_forces(mini, mini.air_shapes @ lift_at(centre, 1.0))
    assert np.abs(forces[tail]).max() < 1e-12
    assert np.abs(forces[:, :2]).max() < 1e-12
    assert np.all(forces[~tail, 2] >= 0.0)


def lift_at(station, lift):
    return np.array([0.0, 0.0, lift, 0.0, -station * lift, 0.0])


def quarter_chord_centre(planform, points=20001):
    """Station of the lift of a Schrenk wing with its pressure centre at the quarter chord."""
    y = np.linspace(planform.span_position[0], planform.span_position[-1], points)
    lift = schrenk_lift(planform, y)
    chord = np.interp(y, planform.span_position, planform.chord)
    station = np.interp(y, planform.span_position, planform.leading_edge) + 0.25 * chord
    return float(np.trapezoid(lift * station, y) / np.trapezoid(lift, y))


def test_lift_at_the_wings_centre_needs_little_tail_even_on_a_coarse_mesh(mini):
    """The coarse skin's own lift centre is that of the continuous planform within 0.2 m."""
    station = quarter_chord_centre(mini.definition.air_loads.wing.planform)
    load = mini.air_shapes @ lift_at(station, 1.0)
    forces = nodal_forces(mini, load)
    tail_share = forces[mini.structure.model.coordinates[:, 0] > 17.5, 2].sum()
    assert abs(tail_share) < 0.2 / 8.0


def test_a_pitching_moment_is_a_couple_of_wing_and_tail(mini):
    forces = nodal_forces(mini, mini.air_shapes[:, 4])
    tail = mini.structure.model.coordinates[:, 0] > 17.5
    # nose up about +y (x aft, z up) is lift on the wing and down force on the tail
    assert forces[tail, 2].sum() < 0.0
    assert forces[~tail, 2].sum() == pytest.approx(-forces[tail, 2].sum(), rel=1e-9)
    assert np.abs(forces[:, 1]).max() < 1e-12


def test_a_rolling_moment_is_antisymmetric_wing_lift(mini):
    forces = nodal_forces(mini, mini.air_shapes[:, 3])
    model = mini.structure.model
    for tens in (4, 5, 6, 7, 8, 9):
        for corner in (1, 2, 3, 4):
            port, starboard = np.searchsorted(
                model.node_identifiers, [100 + 10 * tens + corner, 200 + 10 * tens + corner]
            )
            assert forces[port, 2] == pytest.approx(-forces[starboard, 2], rel=1e-9)
            assert forces[starboard, 2] > 0.0


def test_a_yawing_moment_is_a_couple_of_fin_and_fuselage(mini):
    forces = nodal_forces(mini, mini.air_shapes[:, 5])
    model = mini.structure.model
    fin = (model.node_identifiers > 400) & (model.node_identifiers < 500)
    fuselage = (model.node_identifiers > 300) & (model.node_identifiers < 400)
    # the fin's root hangs rigidly on the fuselage, so that only the free fin nodes show it
    assert forces[fin, 1].sum() > 0.0
    assert forces[fin | fuselage, 1].sum() == pytest.approx(0.0, abs=1e-12)


def test_drag_is_shared_between_wing_and_fuselage_as_defined(mini):
    forces = nodal_forces(mini, mini.air_shapes[:, 0])
    assert forces[:, 0].sum() == pytest.approx(1.0, rel=1e-9)
    assert np.all(forces[:, 0] >= -1e-12)


def test_symmetric_wrenches_load_both_sides_alike(mini):
    model = mini.structure.model
    for column in (0, 2, 4):
        forces = nodal_forces(mini, mini.air_shapes[:, column])
        for tens in (4, 6, 8, 9):
            port, starboard = np.searchsorted(
                model.node_identifiers, [101 + 10 * tens, 201 + 10 * tens]
            )
            np.testing.assert_allclose(
                forces[port], forces[starboard] * [1.0, -1.0, 1.0], atol=1e-13
            )


class TestSchrenk:
    def planform(self, root, tip):
        return Planform(np.array([0.0, 8.0]), np.array([0.0, 1.0]), np.array([root, tip]))

    def test_an_elliptic_wing_carries_elliptic_lift(self):
        y = np.linspace(0.0, 8.0, 2001)
        ellipse = np.sqrt(1 - (y / 8.0) ** 2)
        wing = Planform(y, 0.0 * y, 3.0 * ellipse)
        np.testing.assert_allclose(schrenk_lift(wing, y), 3.0 * ellipse, atol=2e-4)

    def test_the_lift_integrates_to_the_wings_area(self):
        planform = self.planform(3.6768, 1.2869)
        share = np.sin(np.linspace(0.0, np.pi / 2, 20001))  # dense at the tip, where slope is steep
        lift = np.trapezoid(schrenk_lift(planform, 8.0 * share), 8.0 * share)
        assert lift == pytest.approx((3.6768 + 1.2869) / 2 * 8.0, rel=1e-6)

    def test_a_rectangular_wing_is_unloaded_towards_its_tip(self):
        planform = self.planform(2.0, 2.0)
        lift = schrenk_lift(planform, np.array([0.0, 8.0]))
        np.testing.assert_allclose(lift, [(2.0 + 8.0 / np.pi) / 2, 1.0])


class TestRefusals:
    def test_a_skin_without_elements_is_named(self, mini):
        layout = mini.definition.air_loads
        nowhere = LoadedSkin(IdentifierSet(((900, 900),)), None)
        odd = replace(layout, tail=replace(layout.tail, skin=nowhere))
        with pytest.raises(ModelError, match=r"air_loads\.tail: no element"):
            air_load_shapes(mini.structure, odd)

    def test_a_tail_on_the_wing_cannot_pitch(self, mini):
        layout = mini.definition.air_loads
        with pytest.raises(ModelError, match="cannot carry every force and moment"):
            air_load_shapes(mini.structure, replace(layout, tail=layout.wing))

    def test_a_planform_far_from_its_skin_is_named(self, mini):
        layout = mini.definition.air_loads
        away = replace(layout.fin.planform, leading_edge=np.array([115.0, 116.0]))
        odd = replace(layout, fin=replace(layout.fin, planform=away))
        with pytest.raises(ModelError, match=r"air_loads\.fin: GRID 40\d lies more than two"):
            air_load_shapes(mini.structure, odd)

    def test_a_skin_can_be_named_by_its_nodes(self, mini):
        layout = mini.definition.air_loads
        by_nodes = LoadedSkin(None, IdentifierSet(((401, 499),)))
        same = replace(layout, fin=replace(layout.fin, skin=by_nodes))
        np.testing.assert_allclose(
            air_load_shapes(mini.structure, same), mini.air_shapes, atol=1e-13
        )
