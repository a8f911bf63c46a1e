"""Stress measures of shells and beams from states whose stresses are known."""

import numpy as np
import pytest

from solver.fe.stress import build_stress_recovery
from solver.fe.structure import build_structure
from verification.elements.meshes import (
    beams_on,
    cylinder,
    model,
    plate,
    rectangle_section,
    surface,
)
from verification.elements.supported import nothing_fixed, static

E, NU, T = 70e9, 0.3, 0.02


def recovery_of(mesh):
    structure = build_structure(mesh)
    return structure, build_stress_recovery(structure)


@pytest.mark.parametrize("triangular", [False, True])
def test_faces_of_a_plate_stretched_and_bent(triangular):
    """u = e x, w = -k x^2 / 2: sigma_x = E/(1-nu^2) (e + z k), sigma_y = nu sigma_x, per face."""
    mesh = plate(1.0, 1.0, 3, 3, triangular, thickness=T)
    _, recovery = recovery_of(mesh)
    strain, curvature = 1e-4, 2e-3
    motion = np.zeros((mesh.node_count, 6))
    x = mesh.coordinates[:, 0]
    motion[:, 0], motion[:, 2] = strain * x, -curvature * x**2 / 2
    motion[:, 4] = curvature * x
    rows = recovery.shell_operator @ motion.reshape(-1, 1)
    major, minor, _ = recovery.principal(rows)
    direct = E / (1 - NU**2) * (strain + np.array([-T / 2, T / 2]) * curvature)
    both = np.stack([direct, NU * direct])
    assert np.allclose(major[..., 0], both.max(axis=0), rtol=1e-8)
    assert np.allclose(minor[..., 0], both.min(axis=0), rtol=1e-8)
    mises = recovery.von_mises(rows, np.zeros((0, 1)))
    worst = np.abs(direct).max() * np.sqrt(1 - NU + NU**2)
    assert np.allclose(mises, worst, rtol=1e-8)


def test_principal_direction_is_measured_from_the_element_axis():
    """Pure shear: principal stresses +-tau at 45 degrees; uniaxial along y: 90 degrees."""
    _, recovery = recovery_of(plate(1.0, 1.0, 1, 1, thickness=T))
    for state, major, minor, angle in (
        ([0.0, 0.0, 5.0], 5.0, -5.0, np.pi / 4),
        ([0.0, 3.0, 0.0], 3.0, 0.0, np.pi / 2),
        ([4.0, 1.0, 0.0], 4.0, 1.0, 0.0),
    ):
        found = recovery.principal(np.array(state * 2)[:, None])
        for value, expected in zip(found, (major, minor, angle), strict=True):
            assert np.allclose(value, expected)


def test_von_mises_takes_the_worse_face_and_the_worst_point():
    mesh = model(
        np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]),
        quads=np.array([[0, 1, 2, 3]]),
        beams=beams_on(np.array([[0, 1]])),
        section=rectangle_section(0.02, 0.02),
    )
    _, recovery = recovery_of(mesh)
    shell = np.array([[1.0, 0, 0, -3, -3, 4], [2, 0, 0, 0, 0, 0]]).T
    beam = np.array([[1.0, -7, 3, 0, 2, 2, 2, 2, 5], [0, 0, 0, 0, 0, 0, 0, 4, 0]]).T
    found = recovery.von_mises(shell, beam)
    # Top face: 9 - 9 + 9 + 3 * 16; beam: 49 + 3 * 25.
    assert np.allclose(found, [[np.sqrt(57.0), 2.0], [np.sqrt(124.0), 4.0]])


def test_order_and_count_follow_the_model():
    mesh = surface(lambda s, t: np.stack([s, t, 0 * s], -1), 2, 2)
    quads, split = mesh.quads.nodes[:3], mesh.quads.nodes[3]
    mixed = model(
        mesh.coordinates,
        quads=quads,
        triangles=np.array([split[[0, 1, 2]], split[[0, 2, 3]]]),
        beams=beams_on(np.array([[0, 1]]), (0, 0, 1)),
        section=rectangle_section(0.02, 0.02),
    )
    structure, recovery = recovery_of(mixed)
    assert (recovery.n_shells, recovery.n_beams) == (5, 1)
    assert recovery.shell_operator.shape == (30, structure.n_free)
    assert len(mixed.element_identifiers) == 6
    # A node moved in its plane strains only the elements that touch it.
    motion = np.zeros((9, 6))
    motion[8, 0] = 1e-3
    mises = recovery.von_mises(
        recovery.shell_operator @ motion.reshape(-1, 1),
        recovery.beam_operator @ motion.reshape(-1, 1),
    )
    touched = [8 in quad for quad in quads] + [8 in split[[0, 1, 2]], 8 in split[[0, 2, 3]], False]
    assert np.array_equal(mises[:, 0] > 0, touched)


def test_cylinder_under_pressure_shows_hoop_stress():
    """p R / t in a ring free at its ends, from consistent nodal loads on flat facets."""
    radius, length, pressure, around = 2.0, 1.0, 1e5, 48
    mesh = cylinder(radius, length, around, 2, thickness=T)
    structure, recovery = recovery_of(mesh)
    loads = np.zeros((mesh.node_count, 6))
    chord = 2 * radius * np.sin(np.pi / around)
    share = pressure * chord * np.cos(np.pi / around) * length / 2
    outward = mesh.coordinates * [0, 1 / radius, 1 / radius]
    ring = np.repeat([0.5, 1.0, 0.5], around)
    loads[:, :3] = share * ring[:, None] * outward
    fixed = nothing_fixed(structure)
    fixed[0, [0, 1, 2]] = fixed[around // 2, [0, 2]] = fixed[around // 4, 0] = True
    u = static(structure, fixed, loads)
    major, _, _ = recovery.principal(recovery.shell_operator @ u.reshape(-1, 1))
    hoop = major.mean(axis=1)
    assert np.allclose(hoop, pressure * radius / T, rtol=5e-3)
