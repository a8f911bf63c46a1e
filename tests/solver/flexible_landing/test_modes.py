"""Modal data of an airframe: from the reduced model, from dense algebra, truncated."""

from dataclasses import replace

import numpy as np
import pytest

from solver.arrays import Array
from solver.errors import ModelError
from solver.fe.inertia import point_mass_inertia
from solver.flexible_landing.full_airframe import dense_modes, modes_of_loading
from solver.flexible_landing.modes import FlexibleAirframe, residual_basis
from solver.flexible_landing.simulate import simulate_flexible_landing
from solver.inertia_relief.build import airframe_damping, reduced_model
from solver.inertia_relief.loading import assemble
from solver.landing.contact import Contact
from solver.landing.simulate import SimulationOptions
from tests.solver.flexible_landing.conftest import Mini


def fitting_flexibility(flexible: FlexibleAirframe) -> Array:
    """Static motion (n_gears, 6, 6) of the fittings under unit wrenches on the same fitting."""
    shapes = flexible.fittings / flexible.circular_frequency
    return shapes @ shapes.transpose(0, 2, 1)


def test_truncation_keeps_the_static_flexibility_of_the_fittings(mini: Mini) -> None:
    damping = airframe_damping(mini.airframe)
    exact = fitting_flexibility(mini.modes)
    scale = np.sqrt(np.einsum("gii,gjj->gij", exact, exact))
    for modes in (0, 6):
        basis = residual_basis(mini.modes, modes)
        assert basis.shape[1] <= modes + 18
        assert np.abs(basis.T @ basis - np.eye(basis.shape[1])).max() < 1e-12
        short = mini.modes.transformed(basis, damping)
        assert np.abs((fitting_flexibility(short) - exact) / scale).max() < 1e-6
        # The lowest modes alone miss a good part of it.
        alone = mini.modes.fittings[:, :, :6] / mini.modes.circular_frequency[:6]
        assert np.abs((alone @ alone.transpose(0, 2, 1) - exact) / scale).max() > 0.3
    assert np.allclose(short.circular_frequency[:6], mini.modes.circular_frequency[:6], rtol=1e-12)


def test_all_modes_need_no_residual_vectors(mini: Mini) -> None:
    assert np.array_equal(residual_basis(mini.modes, 10_000), np.eye(mini.modes.size))


def test_reduced_model_gives_the_modes_of_the_full_matrices(mini: Mini) -> None:
    model = reduced_model(mini.airframe)
    found = modes_of_loading(assemble(model, mini.factors), mini.aircraft)
    frequencies = mini.modes.circular_frequency
    assert found.circular_frequency[:20] == pytest.approx(frequencies[:20], rel=1e-5)
    exact = fitting_flexibility(mini.modes)
    scale = np.sqrt(np.einsum("gii,gjj->gij", exact, exact))
    assert np.abs((fitting_flexibility(found) - exact) / scale).max() < 1e-3
    # Signs and the frame of every quantity: the same landing from either.
    damping = airframe_damping(mini.airframe)
    options = SimulationOptions(time_limit=0.1, stop_when_settled=False)
    contact = Contact(2.5, 55.0, pitch=0.03, roll=0.04, roll_rate=0.3, pitch_rate=-0.2)
    forces = []
    for flexible in (found, mini.modes):
        short = flexible.transformed(residual_basis(flexible, 12), damping)
        landing = simulate_flexible_landing(mini.aircraft, short, contact, options)
        forces.append(np.stack([gear.wrench for gear in landing.history.gears]))
    assert np.abs(forces[0] - forces[1]).max() < 5e-3 * np.abs(forces[1]).max()


def test_modes_are_orthonormal_and_free_of_rigid_motion(mini: Mini) -> None:
    mass = mini.inertia.mass_matrix()
    product = mini.shapes.T @ (mass @ mini.shapes)
    assert np.abs(product - np.eye(len(product))).max() < 1e-12
    rigid = mini.airframe.structure.rigid_modes(mini.aircraft.centre_of_gravity)
    assert np.abs(rigid.T @ (mass @ mini.shapes)).max() < 1e-7 * np.sqrt(mini.aircraft.mass)


def test_freedoms_without_mass_have_no_modes(mini: Mini) -> None:
    structure = mini.airframe.structure
    lumped = point_mass_inertia(
        structure.transformation, structure.model.coordinates, structure.model.point_masses
    )
    frequency, _ = dense_modes(structure, lumped)
    assert 0 < len(frequency) < structure.n_free - 6
    held = structure.stiffness.copy()
    held.setdiag(held.diagonal() * (1.0 + 1e-3))
    with pytest.raises(ModelError, match="six rigid modes"):
        dense_modes(replace(structure, stiffness=held), mini.inertia)
