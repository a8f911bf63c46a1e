"""Mass is affine in the loading; what the landing simulation gets is the structure's own mass."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.aircraft.airframe import Airframe
from solver.aircraft.nastran import read_bulk_data
from solver.fe.structure import build_structure
from tests.solver.aircraft.mini import BAY_CAPACITY, EMPTY_MASS, EMPTY_STATION, TANK_CAPACITY

FACTORS = st.lists(st.floats(0.0, 1.0), min_size=3, max_size=3).map(np.array)


def from_mass_matrix(airframe: Airframe, factors):
    """Mass, centre and inertia from Phi_R' M Phi_R, the mass matrix itself."""
    modes = airframe.structure.rigid_modes(np.zeros(3))
    rigid = modes.T @ (airframe.inertia(factors).mass_matrix() @ modes)
    mass = rigid[0, 0]
    # moment of a unit acceleration about z, y: m (x, y, z) stands in the coupling block
    centre = np.array([rigid[1, 5], rigid[2, 3], rigid[0, 4]]) / mass
    about_origin = rigid[3:, 3:]
    shift = mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
    return mass, centre, about_origin - shift


@settings(max_examples=20, deadline=None)
@given(factors=FACTORS)
def test_rigid_body_properties_are_those_of_the_mass_matrix(mini, factors):
    mass, centre, inertia = from_mass_matrix(mini, factors)
    found = mini.mass_properties(factors)
    assert found.mass == pytest.approx(mass, rel=1e-12)
    np.testing.assert_allclose(found.centre_of_gravity, centre, atol=1e-11)
    np.testing.assert_allclose(found.inertia, inertia, atol=1e-11 * inertia.max() * 10)


@settings(max_examples=10, deadline=None)
@given(factors=FACTORS)
def test_the_mass_matrix_is_affine(mini, factors):
    none = np.zeros(3)
    empty = mini.inertia(none).mass_matrix().toarray()
    parts = [mini.inertia(row).mass_matrix().toarray() - empty for row in np.eye(3)]
    together = mini.inertia(factors).mass_matrix().toarray()
    expected = empty + sum(f * part for f, part in zip(factors, parts, strict=True))
    np.testing.assert_allclose(together, expected, atol=1e-12 * np.abs(expected).max())


def test_everything_full_equals_direct_assembly_of_the_whole_file(mini, mini_folder):
    whole = build_structure(read_bulk_data(mini_folder / "airframe.bdf").model)
    direct = whole.inertia.rigid_body_properties()
    found = mini.mass_properties(np.ones(3))
    assert found.mass == pytest.approx(direct.mass, rel=1e-13)
    np.testing.assert_allclose(found.centre_of_gravity, direct.centre_of_gravity, atol=1e-12)
    np.testing.assert_allclose(found.inertia, direct.inertia, atol=1e-7)
    difference = mini.inertia(np.ones(3)).mass_matrix() - whole.inertia.mass_matrix()
    assert abs(difference).max() < 1e-9


def test_the_empty_airframe_weighs_what_its_makers_meant(mini):
    # The mini's ballast was solved from areas, lengths and densities, without the elements
    empty = mini.mass_properties(np.zeros(3))
    assert empty.mass == pytest.approx(EMPTY_MASS, rel=1e-9)
    assert empty.centre_of_gravity[0] == pytest.approx(EMPTY_STATION, abs=1e-3)
    assert [group.capacity for group in mini.groups] == pytest.approx(
        [TANK_CAPACITY, TANK_CAPACITY, BAY_CAPACITY], rel=1e-12
    )


def test_a_symmetric_loading_is_symmetric(mini):
    body = mini.mass_properties(np.array([0.4, 0.4, 1.0]))
    assert body.centre_of_gravity[1] == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_allclose(body.inertia[1, [0, 2]], 0.0, atol=1e-8)
    left = mini.mass_properties(np.array([1.0, 0.0, 0.5]))
    right = mini.mass_properties(np.array([0.0, 1.0, 0.5]))
    assert left.centre_of_gravity[1] == pytest.approx(-right.centre_of_gravity[1], rel=1e-12)
    assert left.centre_of_gravity[1] < 0.0


def test_the_landing_aircraft_is_the_airframe_and_its_gears(mini):
    factors = np.array([0.3, 0.6, 0.9])
    aircraft = mini.landing_aircraft(factors)
    body = mini.mass_properties(factors)
    gross, centre = mini.mass_states.gross(factors)
    assert aircraft.mass == body.mass
    assert aircraft.total_mass == pytest.approx(gross, rel=1e-14)
    np.testing.assert_allclose(aircraft.total_centre_of_gravity, centre, rtol=1e-14)
    assert gross == pytest.approx(8235.0 + TANK_CAPACITY * 0.9 + BAY_CAPACITY * 0.9, rel=1e-9)
    places = np.concatenate([[pin.position for pin in gear.pins] for gear in aircraft.gears])
    np.testing.assert_array_equal(places, mini.structure.model.coordinates[mini.pin_rows])
