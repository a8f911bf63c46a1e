"""Checking an aircraft: a sound one passes, a hidden support or a mechanism does not."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.sparse import csc_array, diags_array

from solver.aircraft.check import check_airframe, lowest_frequencies, rigid_energy_share


def test_the_mini_aircraft_is_sound(mini):
    found = check_airframe(mini)
    assert found.is_sound
    assert (found.rigid_modes, found.counts["elements"], found.counts["pins"]) == (6, 124, 10)
    assert found.rigid_energy < 1e-12
    assert found.empty_mass == pytest.approx(8235.0, rel=1e-6)
    assert sum(zone.elements for zone in found.zones) == 124
    assert found.content_hash == mini.content_hash


def test_frequencies_are_those_of_the_dense_eigenproblem(mini):
    factors = np.array([0.6, 0.6, 0.5])
    stiffness = mini.structure.stiffness.toarray()
    mass = mini.inertia(factors).mass_matrix().toarray()
    dense = np.sqrt(eigh(stiffness, mass, eigvals_only=True)[6:12]) / (2 * np.pi)
    np.testing.assert_allclose(lowest_frequencies(mini, factors)[6:12], dense, rtol=1e-6)


def test_a_hidden_spring_to_ground_is_found(mini):
    stiffness = mini.structure.stiffness
    spring = np.zeros(stiffness.shape[0])
    spring[0] = 1e6
    held = replace(mini.structure, stiffness=csc_array(stiffness + diags_array(spring)))
    grounded = replace(mini, structure=held)
    assert rigid_energy_share(grounded) > 1e-9
    found = check_airframe(grounded)
    assert not found.is_sound
    assert found.rigid_modes < 6
    assert any("hidden support" in warning for warning in found.warnings)


def test_a_centre_of_gravity_outside_its_range_is_warned_of(mini):
    reference = replace(
        mini.definition.reference, forward_centre_of_gravity=5.0, aft_centre_of_gravity=6.0
    )
    odd = replace(mini, definition=replace(mini.definition, reference=reference))
    assert any("is outside 5 to 6 m" in warning for warning in check_airframe(odd).warnings)


def test_slender_elements_are_counted_and_the_worst_is_named(mini):
    # the spar webs of the tip bay: 4.15 m long, 0.129 m high at the tip
    (warning,) = [w for w in check_airframe(mini).warnings if "aspect ratio" in w]
    assert warning.startswith("4 CQUAD4 have aspect ratio above 20")
