"""Patch tests: states of constant strain come out exactly on distorted meshes, in any plane.

The shell patch, its boundary displacements and its stresses are those of MacNeal and Harder, A
proposed standard set of problems to test finite element accuracy, 1985, table 1 and figure 1.
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from solver.fe.sections import shell_sections
from solver.fe.shell_quad import quad_stiffness
from solver.fe.stress import build_stress_recovery
from solver.fe.structure import build_structure
from tests.solver.fe.meshes import beam_chain, material, model, rectangle_section, split
from tests.solver.fe.supported import nothing_fixed, prescribed

CORNERS = [[0, 0], [0.24, 0], [0.24, 0.12], [0, 0.12]]
INNER = [[0.04, 0.02], [0.18, 0.03], [0.16, 0.08], [0.08, 0.08]]
POINTS = np.array(CORNERS + INNER)
QUADS = np.array([[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [4, 5, 6, 7]])
THICKNESS = 1e-3
TURN = Rotation.from_rotvec([0.4, -1.1, 0.7]).as_matrix()
SHAPES = ["quads", "triangles", "both"]


def patch(shape: str, thickness: float):
    """The patch in a tilted plane, its middle element split into triangles if ``both``."""
    coordinates = np.column_stack([POINTS, np.zeros(8)]) @ TURN.T + [3.0, -2.0, 5.0]
    elements = {
        "quads": {"quads": QUADS},
        "triangles": {"triangles": split(QUADS)},
        "both": {"quads": QUADS[:4], "triangles": split(QUADS[4:])},
    }[shape]
    options = {"thickness": thickness, "substance": material(1e6, 0.25)}
    return build_structure(model(coordinates, **elements, **options))


def solved_patch(shape: str, local: np.ndarray, thickness: float = THICKNESS):
    """Solve for the inner nodes with the outer four following ``local`` (8, 6); in-plane axes."""
    structure = patch(shape, thickness)
    exact = np.concatenate([local[:, :3] @ TURN.T, local[:, 3:] @ TURN.T], axis=1)
    known = nothing_fixed(structure)
    known[:4] = True
    found = prescribed(structure, known, exact)
    stresses = build_stress_recovery(structure).shell_operator @ found.ravel()
    return found, exact, stresses.reshape(-1, 2, 3)


def assert_exact(found: np.ndarray, exact: np.ndarray) -> None:
    """Equal to rounding, which bending amplifies by (l/t)^2, 1e4 here."""
    assert np.allclose(found, exact, rtol=0, atol=1e-8 * np.abs(exact).max())
    translations = np.abs(found - exact)[:, :3].max()
    assert translations < 1e-10 * np.abs(exact[:, :3]).max()


def bent() -> np.ndarray:
    """w = 1e-3 (x^2 + x y + y^2) / 2 with its slopes: constant curvatures and twist."""
    x, y = POINTS.T
    local = np.zeros((8, 6))
    local[:, 2] = 1e-3 * (x * x + x * y + y * y) / 2
    local[:, 3], local[:, 4] = 1e-3 * (y + x / 2), -1e-3 * (x + y / 2)
    return local


def invariants(stresses: np.ndarray) -> np.ndarray:
    """Sum and Mohr radius of stresses (..., 3), which no choice of element axes changes."""
    x, y, xy = np.moveaxis(stresses, -1, 0)
    return np.stack([x + y, np.hypot((x - y) / 2, xy)], axis=-1)


@pytest.mark.parametrize("shape", SHAPES)
def test_constant_membrane_strain_and_shear(shape):
    x, y = POINTS.T
    local = np.zeros((8, 6))
    local[:, 0], local[:, 1] = 1e-3 * (x + y / 2), 1e-3 * (y + x / 2)
    found, exact, stresses = solved_patch(shape, local)
    assert_exact(found, exact)
    published = invariants(np.array([4000 / 3, 4000 / 3, 400.0]))
    assert np.allclose(invariants(stresses), published, rtol=1e-9)


@pytest.mark.parametrize("shape", SHAPES)
def test_constant_rotation_of_the_drilling_freedom(shape):
    """Pure in-plane shear du/dy with its drilling rotation -1/2 du/dy leaves nothing over."""
    local = np.zeros((8, 6))
    local[:, 0], local[:, 5] = 1e-3 * POINTS[:, 1], -0.5e-3
    found, exact, stresses = solved_patch(shape, local)
    assert_exact(found, exact)
    expected = invariants(np.array([0.0, 0.0, 1e6 / 2.5 * 1e-3]))
    assert np.allclose(invariants(stresses), expected, atol=1e-8 * expected.max())


@pytest.mark.parametrize("shape", ["quads", "triangles"])
def test_constant_bending_and_twist(shape):
    found, exact, stresses = solved_patch(shape, bent())
    assert_exact(found, exact)
    published = invariants(np.array([2 / 3, 2 / 3, 0.2]))
    assert np.allclose(invariants(stresses[:, 0]), published * [1, 1], rtol=1e-8)
    assert np.allclose(invariants(stresses[:, 1]), published * [-1, 1], rtol=1e-8)


def test_bending_patch_of_quads_with_triangles_misses_by_the_square_of_thickness():
    """The two carry twist along a common side differently; thin shells do not notice."""
    errors = []
    for thickness in (4e-3, 2e-3, 1e-3):
        _, _, stresses = solved_patch("both", bent(), thickness)
        published = invariants(np.array([2 / 3, 2 / 3, 0.2])) * (thickness / THICKNESS)
        errors.append(np.abs(invariants(stresses[:, 1]) / (published * [-1, 1]) - 1).max())
    assert errors[-1] < 5e-4
    assert np.polyfit(np.log([4, 2, 1]), np.log(errors), 1)[0] > 1.8


def test_constant_transverse_shear_energy_of_quads():
    """w = x with no rotation: half of 5/6 G t times the area, on the distorted patch."""
    plane = np.column_stack([POINTS, np.zeros(8)])
    mesh = model(plane, quads=QUADS, thickness=THICKNESS, substance=material(1e6, 0.25))
    stiffness = quad_stiffness(plane[QUADS], shell_sections(mesh, mesh.quads))
    motion = np.zeros((8, 6))
    motion[:, 2] = POINTS[:, 0]
    element = motion[QUADS].reshape(5, 24)
    energy = 0.5 * np.einsum("mi,mij,mj->", element, stiffness, element)
    assert energy == pytest.approx(0.5 * 5 / 6 * 4e5 * THICKNESS * 0.24 * 0.12, rel=1e-12)


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
    """A chain of unequal beams in a tilted direction, ends held: interior and stress exact.

    Stress sigma = E (strain - y k1 - z k2), torsional shear = G r twist (r the torsion radius).
    """
    section = rectangle_section(0.03, 0.05)
    substance = material()
    s = np.array([0.0, 0.13, 0.41, 0.55, 1.0])
    structure = build_structure(
        beam_chain(s[:, None] * TURN[:, 0], section, orientation=TURN[:, 1], substance=substance)
    )
    local = np.zeros((5, 6))
    local[:, 0] = strain * s
    local[:, 1], local[:, 5] = curvature_1 * s**2 / 2, curvature_1 * s
    local[:, 2], local[:, 4] = curvature_2 * s**2 / 2, -curvature_2 * s
    local[:, 3] = twist * s
    exact = np.concatenate([local[:, :3] @ TURN.T, local[:, 3:] @ TURN.T], axis=1)
    known = nothing_fixed(structure)
    known[[0, -1]] = True
    found = prescribed(structure, known, exact)
    assert np.allclose(found, exact, atol=1e-11 * np.abs(exact).max())
    rows = (build_stress_recovery(structure).beam_operator @ found.ravel()).reshape(4, 9)
    y, z = section.stress_points.T
    normal = substance.young_modulus * (strain - y * curvature_1 - z * curvature_2)
    scale = np.abs(rows).max()
    assert np.allclose(rows[:, :4], normal, atol=1e-9 * scale)
    assert np.allclose(rows[:, 4:8], normal, atol=1e-9 * scale)
    shear = substance.shear_modulus * section.torsion_radius * twist
    assert np.allclose(rows[:, 8], shear, atol=1e-9 * scale)
