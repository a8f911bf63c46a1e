"""Patch tests: states of constant strain come out exactly on distorted meshes, in any plane.

The patch and its states are in verification/elements/patch.py.
"""

import numpy as np
import pytest

from solver.fe.stress import build_stress_recovery
from solver.fe.structure import build_structure
from verification.elements import patch
from verification.elements.meshes import model, split
from verification.elements.patch import POINTS, QUADS, invariants, solved_patch

SHAPES = ["quads", "triangles", "both"]


def assert_exact(result: patch.PatchResult) -> None:
    """Equal to rounding, which bending amplifies by (l/t)^2, 1e4 here."""
    exact = result.exact
    assert np.allclose(result.found, exact, rtol=0, atol=1e-8 * np.abs(exact).max())
    assert result.displacement_error < 1e-10


@pytest.mark.parametrize("shape", SHAPES)
def test_constant_membrane_strain_and_shear(shape):
    result = solved_patch(shape, patch.stretched())
    assert_exact(result)
    published = invariants(patch.STRETCHED_STRESS)
    assert np.allclose(invariants(result.stress), published, rtol=1e-9)


@pytest.mark.parametrize("shape", SHAPES)
def test_constant_rotation_of_the_drilling_freedom(shape):
    """Pure in-plane shear du/dy with its drilling rotation -1/2 du/dy leaves nothing over."""
    result = solved_patch(shape, patch.sheared())
    assert_exact(result)
    expected = invariants(patch.SHEARED_STRESS)
    assert np.allclose(invariants(result.stress), expected, atol=1e-8 * expected.max())


@pytest.mark.parametrize("shape", SHAPES)
def test_constant_bending_and_twist(shape):
    result = solved_patch(shape, patch.bent())
    assert_exact(result)
    published = invariants(patch.BENT_STRESS)
    assert np.allclose(invariants(result.stress[:, 0]), published * [1, 1], rtol=1e-8)
    assert np.allclose(invariants(result.stress[:, 1]), published * [-1, 1], rtol=1e-8)


@pytest.mark.parametrize("thickness", [1e-3, 0.1, 10.0])
def test_racked_quad_bends_when_thin_and_shears_when_thick(thickness):
    energy, expected = patch.racked_rectangle(thickness)
    assert energy == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("shape", SHAPES)
def test_stress_does_not_depend_on_the_first_node(shape):
    """Rotating the node order of each element changes its axes, not the stress state."""
    motion = np.random.default_rng(3).normal(size=(8, 6))
    results = []
    for shift in range(3):
        quads = np.roll(QUADS, shift, axis=1)
        triangles = np.roll(split(QUADS), shift, axis=1)
        coordinates = np.column_stack([POINTS, np.zeros(8)])
        elements = {"quads": quads} if shape == "quads" else {"triangles": triangles}
        structure = build_structure(model(coordinates, **elements))
        rows = build_stress_recovery(structure).shell_operator @ motion.ravel()
        results.append((invariants(rows.reshape(-1, 2, 3)), structure.stiffness.toarray()))
    for stresses, stiffness in results[1:]:
        assert np.allclose(stresses, results[0][0], rtol=1e-9)
        assert np.allclose(stiffness, results[0][1], atol=1e-10 * np.abs(stiffness).max())


@pytest.mark.parametrize(
    ("strain", "curvature_1", "curvature_2", "twist"),
    [(1e-3, 0, 0, 0), (0, 1e-2, 0, 0), (0, 0, 1e-2, 0), (0, 0, 0, 1e-2), (1e-3, 2e-2, -1e-2, 3e-2)],
)
def test_beam_reproduces_constant_section_forces(strain, curvature_1, curvature_2, twist):
    result, expected = patch.solved_chain(strain, curvature_1, curvature_2, twist)
    exact = result.exact
    assert np.allclose(result.found, exact, atol=1e-11 * np.abs(exact).max())
    assert np.allclose(result.stress, expected, atol=1e-9 * np.abs(result.stress).max())
