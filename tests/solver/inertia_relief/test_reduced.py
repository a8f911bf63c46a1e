"""The reduced model: affine mass, stored form, and accuracy against the full order."""

import numpy as np
import pytest
from scipy.linalg import eig

from solver.errors import EquilibriumError, ModelError
from solver.fe.inertia import RATE_PRODUCTS
from solver.inertia_relief.basis import BasisSettings, elastic_modes, extended
from solver.inertia_relief.build import project
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.rate_loads import RateLoads
from solver.inertia_relief.reduced import load_reduced_model
from solver.inertia_relief.response import landing_response
from verification.inertia_relief.winged_body import (
    WingedBody,
    balanced_landing,
    full_order_peaks,
    reduced,
    reduced_peaks,
    winged_body,
)

DAMPING = RayleighDamping(0.02, 3.0, 40.0)
SETTINGS = BasisSettings(modes=30)
FACTORS = np.array([0.85, 0.3])


@pytest.fixture(scope="module")
def winged() -> WingedBody:
    return winged_body()


@pytest.fixture(scope="module")
def model(winged):
    return reduced(winged, SETTINGS, DAMPING)


def test_stiffness_is_the_identity_and_rigid_modes_store_no_energy(winged, model):
    # the unit strain energy shows in the stress rows: K = I has to hold for the basis itself
    base, groups = winged.structure.inertia, winged.groups
    from solver.inertia_relief.basis import build_basis

    basis = build_basis(winged.structure, base, groups, winged.applied, SETTINGS)
    identity = basis.T @ (winged.structure.stiffness @ basis)
    np.testing.assert_allclose(identity, np.eye(basis.shape[1]), atol=1e-7)
    assert basis.shape[1] == model.size


def test_mass_is_affine_in_the_fill_factors(winged):
    rng = np.random.default_rng(0)
    basis = rng.standard_normal((winged.structure.n_free, 5))
    base, groups = winged.structure.inertia, winged.groups
    model = project(winged.structure, base, groups, winged.applied, winged.recovery, basis, DAMPING)
    full = np.hstack([winged.structure.rigid_modes(model.origin), basis])
    for factors in (np.zeros(2), np.ones(2), FACTORS):
        weights = np.concatenate([[1.0], factors])
        inertia = winged.inertia(factors)
        mass = full.T @ inertia.mass_matrix() @ full
        found = np.tensordot(weights, model.mass, axes=1)
        np.testing.assert_allclose(found, mass, atol=1e-11 * np.abs(mass).max())
        expected = [inertia.gyroscopic(k) for k in range(3)]
        expected += [inertia.euler(k) for k in range(3)]
        expected += [inertia.centrifugal(i, j) for i, j in RATE_PRODUCTS]
        operators = np.tensordot(weights, model.rate_operators, axes=1).transpose(0, 2, 1)
        for operator, matrix in zip(operators, expected, strict=True):
            projected = full.T @ matrix @ full
            np.testing.assert_allclose(operator, projected, atol=1e-6 * np.abs(projected).max())
        shapes = full.T @ inertia.rigid_load_shapes(model.origin)
        found = np.tensordot(weights, model.inertia, axes=1)
        np.testing.assert_allclose(found, shapes, atol=1e-11 * np.abs(shapes).max())


def test_assembled_loading_has_the_mass_properties_and_modes_of_the_full_structure(winged, model):
    loading = assemble(model, FACTORS)
    body = winged.body(FACTORS)
    assert loading.mass == pytest.approx(body.total_mass, rel=1e-12)
    np.testing.assert_allclose(loading.centre_of_gravity, body.centre_of_gravity, atol=1e-11)
    assert loading.gyration_radius == pytest.approx(body.gyration_radius, rel=1e-10)
    frequencies, _ = elastic_modes(body, 20)
    found = np.sort(loading.circular_frequency)[:20]
    np.testing.assert_allclose(found[:6], frequencies[:6], rtol=1e-4)
    np.testing.assert_allclose(found, frequencies, rtol=5e-4)  # modes in single precision


@pytest.mark.parametrize(("factors", "seed"), [([0.85, 0.3], 11), ([0.1, 0.65], 12)])
def test_every_stressed_element_agrees_with_the_full_order_within_one_percent(
    winged, model, factors, seed
):
    factors = np.array(factors)
    loads = balanced_landing(winged, factors, seed, duration=0.4)
    full = full_order_peaks(winged, factors, loads, DAMPING, substeps=4)
    fast = reduced_peaks(model, factors, loads)
    stressed = full.stress > 0.2 * full.stress.max()
    assert stressed.sum() > 20
    np.testing.assert_allclose(fast.stress[stressed], full.stress[stressed], rtol=0.01)


def test_modes_alone_miss_the_fittings_by_far(winged):
    loads = balanced_landing(winged, FACTORS, 11, duration=0.4)
    full = full_order_peaks(winged, FACTORS, loads, DAMPING)
    frequencies, shapes = elastic_modes(winged.body(FACTORS), 60)
    stiffness = winged.structure.stiffness
    none = np.zeros((len(shapes), 0))
    basis = extended(stiffness, none, shapes / frequencies, 1e-9)
    base, groups = winged.structure.inertia, winged.groups
    model = project(winged.structure, base, groups, winged.applied, winged.recovery, basis, DAMPING)
    fast = reduced_peaks(model, FACTORS, loads)
    stressed = full.stress > 0.2 * full.stress.max()
    error = np.abs(fast.stress / full.stress - 1)[stressed]
    assert error.max() > 0.1


def test_w_terms_change_the_answer_and_their_sweeps_solve_the_coupled_equations(winged, model):
    """Every sweep's fixed point satisfies the reduced eq (15) with all operators at once."""
    loads = balanced_landing(winged, FACTORS, 5, duration=0.3)
    loading = assemble(model, FACTORS)
    fine = landing_response(loading, loads, tolerance=1e-6)
    assert fine.sweeps >= 2
    coarse = landing_response(loading, loads, tolerance=1e-2)
    assert (
        1e-6
        < np.abs(coarse.coordinates - fine.coordinates).max()
        < 1e-2 * np.abs(fine.coordinates).max()
    )


def test_pseudo_loads_are_the_projected_rate_operators(winged, model):
    loading = assemble(model, FACTORS)
    rng = np.random.default_rng(0)
    size = model.size
    u, v, coefficients = (rng.standard_normal(shape) for shape in [(size, 3), (size, 3), (12, 3)])
    found = RateLoads(loading, coefficients).of(u, v)
    operators = modal_rate_operators(loading)
    expected = np.zeros((size, 3))
    for sample in range(3):
        weighted = np.tensordot(coefficients[:, sample], operators, axes=1)
        on_velocity = np.tensordot(coefficients[:3, sample], operators[:3], axes=1)
        expected[:, sample] = -on_velocity @ v[:, sample]
        expected[:, sample] -= (weighted - on_velocity) @ u[:, sample]
    np.testing.assert_allclose(found, expected, atol=1e-5 * np.abs(expected).max())


def test_left_out_pseudo_loads_stay_below_the_stated_norm(model):
    loading = assemble(model, FACTORS)
    rng = np.random.default_rng(0)
    decay = 10.0 ** -np.linspace(6, 0, model.size)[:, None]
    u, v = rng.standard_normal((2, model.size, 9)) * decay
    coefficients = rng.standard_normal((12, 9))
    every = RateLoads(loading, coefficients).of(u, v)
    limit = 1e-4 * np.linalg.norm(every, axis=0).max()
    some = RateLoads(loading, coefficients, limit).of(u, v)
    difference = np.linalg.norm(some - every, axis=0).max()
    assert 0.0 < difference <= limit


def test_reduced_operator_of_a_turning_frame_has_the_eigenvalues_of_the_full_one(winged, model):
    """Lowest eigenvalues of M u'' + G u' + (K + C) u at a constant rate, mean-axis frame."""
    rate = np.array([0.4, -0.3, 0.5])
    loading = assemble(model, FACTORS)
    products = [rate[i] * rate[j] for i, j in RATE_PRODUCTS]
    modal = modal_rate_operators(loading)
    period = np.diag(loading.circular_frequency**-2.0)
    found = turning_frequencies(
        period,
        np.tensordot(rate, modal[:3], axes=1),
        np.eye(model.size) + np.tensordot(products, modal[6:], axes=1),
    )
    body = winged.body(FACTORS)
    frequencies, shapes = elastic_modes(body, 60)
    inertia = body.inertia
    gyroscopic = sum(rate[k] * inertia.gyroscopic(k) for k in range(3))
    centrifugal = sum(
        factor * inertia.centrifugal(i, j)
        for factor, (i, j) in zip(products, RATE_PRODUCTS, strict=True)
    )
    expected = turning_frequencies(
        np.eye(len(frequencies)),
        shapes.T @ gyroscopic @ shapes,
        np.diag(frequencies**2) + shapes.T @ centrifugal @ shapes,
    )
    np.testing.assert_allclose(found[:8], expected[:8], rtol=2e-4)
    assert np.abs(found[:8] / np.sort(loading.circular_frequency)[:8] - 1).max() > 1e-3


def modal_rate_operators(loading):
    """Return the twelve operators (12, m, m) in modal coordinates."""
    stored = np.tensordot(loading.weights, loading.model.rate_operators, axes=1)
    modes = loading.modes_with_rigid
    return modes.T @ stored.transpose(0, 2, 1) @ modes


def turning_frequencies(mass, gyroscopic, stiffness):
    """Positive circular frequencies of a gyroscopic system, ascending."""
    size = len(mass)
    zero, one = np.zeros((size, size)), np.eye(size)
    left = np.block([[zero, one], [-stiffness, -gyroscopic]])
    right = np.block([[one, zero], [zero, mass]])
    values = eig(left, right, right=False)
    return np.sort(values.imag[values.imag > 0])


def test_stored_model_gives_the_same_answer(winged, model, tmp_path):
    folder = tmp_path / "models" / "one"
    model.save(folder)
    model.save(folder)  # replaces
    stored = load_reduced_model(folder, model.key)
    loads = balanced_landing(winged, FACTORS, 2, duration=0.1)
    np.testing.assert_array_equal(
        reduced_peaks(stored, FACTORS, loads).stress, reduced_peaks(model, FACTORS, loads).stress
    )
    assert stored.damping == model.damping
    assert load_reduced_model(folder, "another key") is None
    assert load_reduced_model(tmp_path / "nowhere") is None
    assert [path.name for path in folder.parent.iterdir()] == ["one"]


def test_unbalanced_landing_is_refused_by_the_reduced_path_too(winged, model):
    loads = balanced_landing(winged, FACTORS, 2, duration=0.1)
    with pytest.raises(EquilibriumError):
        landing_response(assemble(model, FACTORS + 0.01), loads)


def test_wrong_number_of_fill_factors_is_refused(model):
    with pytest.raises(ModelError, match="2 mass groups"):
        assemble(model, np.array([1.0]))
