"""Beams against closed forms: shear flexibility, offsets, composite sections, frequencies."""

import dataclasses

import numpy as np
import pytest

from solver.fe.stress import build_stress_recovery
from solver.fe.structure import build_structure
from verification.elements import beams
from verification.elements.meshes import (
    beams_on,
    material,
    plate,
    rectangle_section,
    straight_beam,
)
from verification.elements.supported import nothing_fixed, static

LENGTH, FORCE = 1.7, 230.0
SECTION = rectangle_section(0.03, 0.05)
E, G = material().young_modulus, material().shear_modulus


def clamped(structure):
    fixed = nothing_fixed(structure)
    fixed[0] = True
    return fixed


def tip_load(structure, *values):
    loads = np.zeros((structure.model.node_count, 6))
    loads[-1] = values
    return loads


@pytest.mark.parametrize("count", [1, 3])
def test_cantilever_deflection_with_shear(count):
    """P L^3 / (3 E I) + P L / (K G A), whatever the number of elements; twist and extension too."""
    for figure in beams.cantilever(count):
        assert figure.ratio == pytest.approx(1.0, rel=1e-10), figure.case


def test_zero_shear_factor_means_no_shear_flexibility():
    section = dataclasses.replace(SECTION, shear_factor_1=0.0, shear_factor_2=0.0)
    structure = build_structure(straight_beam(LENGTH, 2, section))
    u = static(structure, clamped(structure), tip_load(structure, 0, FORCE, 0, 0, 0, 0))
    assert u[-1, 1] == pytest.approx(FORCE * LENGTH**3 / (3 * E * section.inertia_1), rel=1e-10)


def test_root_stress_of_a_cantilever():
    """sigma = -M_z y / I1 with M_z = P L at the root, zero at the tip; von Mises is its largest."""
    structure = build_structure(straight_beam(LENGTH, 4, SECTION))
    u = static(structure, clamped(structure), tip_load(structure, 0, FORCE, 0, 0, 0, 0))
    recovery = build_stress_recovery(structure)
    rows = recovery.beam_operator @ u.reshape(-1, 1)
    elements = rows.reshape(4, 9)
    root = -FORCE * LENGTH * SECTION.stress_points[:, 0] / SECTION.inertia_1
    assert np.allclose(elements[0, :4], root, rtol=1e-9)
    assert np.allclose(elements[-1, 4:8], 0.0, atol=1e-9 * np.abs(root).max())
    assert recovery.von_mises(np.zeros((0, 1)), rows)[0, 0] == pytest.approx(np.abs(root).max())


def test_torsion_and_bending_make_von_mises():
    """sqrt(sigma^2 + 3 tau^2), tau = T r / J."""
    torque = 55.0
    structure = build_structure(straight_beam(LENGTH, 1, SECTION))
    u = static(structure, clamped(structure), tip_load(structure, FORCE, 0, 0, torque, 0, 0))
    recovery = build_stress_recovery(structure)
    rows = recovery.beam_operator @ u.reshape(-1, 1)
    sigma = FORCE / SECTION.area
    tau = torque * SECTION.torsion_radius / SECTION.torsion_constant
    expected = np.sqrt(sigma**2 + 3 * tau**2)
    assert recovery.von_mises(np.zeros((0, 1)), rows)[0, 0] == pytest.approx(expected, rel=1e-9)
    assert u[-1, 3] == pytest.approx(torque * LENGTH / (G * SECTION.torsion_constant), rel=1e-9)


def test_offset_beam_under_axial_force():
    """Force P at the node, axis at offset e: P L/(E A) + P e^2 L/(E I2), rotation P e L/(E I2)."""
    e = 0.08
    structure = build_structure(straight_beam(LENGTH, 3, SECTION, offset=(0, 0, e)))
    u = static(structure, clamped(structure), tip_load(structure, FORCE, 0, 0, 0, 0, 0))
    bending = FORCE * LENGTH / (E * SECTION.inertia_2)
    assert u[-1, 0] == pytest.approx(FORCE * LENGTH / (E * SECTION.area) + bending * e**2, rel=1e-9)
    assert u[-1, 4] == pytest.approx(-bending * e, rel=1e-9)
    assert u[-1, 2] == pytest.approx(bending * e * LENGTH / 2, rel=1e-9)
    rows = build_stress_recovery(structure).beam_operator @ u.ravel()
    # Section forces on the axis: P and the moment -P e about y, the same at every station.
    z = SECTION.stress_points[:, 1]
    expected = FORCE / SECTION.area - FORCE * e * z / SECTION.inertia_2
    assert np.allclose(rows.reshape(3, 9)[:, :8], np.tile(expected, (3, 2)), rtol=1e-8)


def stiffened_strip(count: int):
    """Strip in the x-y plane, nu = 0, with half-size stiffeners under both long edges."""
    width, thickness, depth = 0.2, 0.01, 0.06
    section = rectangle_section(0.01, depth)
    offset = -(thickness + depth) / 2
    mesh = plate(width, LENGTH, 1, count, thickness=thickness, substance=material(E, 0.0))
    nodes = np.arange(2 * (count + 1)).reshape(-1, 2)
    pairs = np.concatenate([np.stack([nodes[:-1, k], nodes[1:, k]], 1) for k in range(2)])
    beams = beams_on(pairs, orientation=(1.0, 0, 0), offset=(0, 0, offset))
    mesh = dataclasses.replace(mesh, beams=beams, beam_properties={1: section})
    areas = np.array([width * thickness, 2 * section.area])
    heights = np.array([0.0, offset])
    centre = areas @ heights / areas.sum()
    own = width * thickness**3 / 12 + 2 * section.inertia_2
    composite = own + areas @ (heights - centre) ** 2
    return mesh, centre, composite, areas.sum()


def test_plate_with_eccentric_stiffeners_in_pure_bending():
    """Composite section: slope M L / (E I) about the common neutral axis, to rounding."""
    moment = 40.0
    mesh, centre, composite, _ = stiffened_strip(5)
    structure = build_structure(mesh)
    fixed = nothing_fixed(structure)
    fixed[:2] = True
    loads = np.zeros(fixed.shape)
    loads[-2:, 3] = moment / 2
    u = static(structure, fixed, loads)
    slope = moment * LENGTH / (E * composite)
    assert u[-1, 3] == pytest.approx(slope, rel=1e-8)
    # The plate lies above the neutral axis and stretches or shortens with it.
    assert u[-1, 1] == pytest.approx(slope * centre, rel=1e-8)
    assert u[-1, 2] == pytest.approx(slope * LENGTH / 2, rel=1e-8)


def test_plate_with_eccentric_stiffeners_under_tip_force_converges():
    """P L^3 / (3 E I), second order: the axial field of an element is linear, the lever is not."""
    errors = []
    for count in (4, 8, 16, 32):
        mesh, _, composite, _ = stiffened_strip(count)
        mesh = dataclasses.replace(
            mesh,
            beam_properties={
                1: dataclasses.replace(
                    mesh.beam_properties[1], shear_factor_1=0.0, shear_factor_2=0.0
                )
            },
        )
        structure = build_structure(mesh)
        fixed = nothing_fixed(structure)
        fixed[:2] = True
        loads = np.zeros(fixed.shape)
        loads[-2:, 2] = 0.5
        u = static(structure, fixed, loads)
        errors.append(abs(u[-1, 2] / (LENGTH**3 / (3 * E * composite)) - 1))
    assert errors[-1] < 1e-3
    order = -np.polyfit(np.log([4, 8, 16]), np.log(errors[:3]), 1)[0]
    assert order > 1.7


@pytest.mark.parametrize("offset", [None, (0.0, 0.0, 0.4)])
def test_free_free_beam_frequencies(offset):
    """beta L = 4.7300, 7.8532, 10.9956, 14.1372 (Euler-Bernoulli), for a beam of depth L/1000.

    An offset shared by all ends moves the structure, not its free frequencies; what is left is
    the axial field of the nodes, linear in each element.
    """
    values, exact = beams.free_beam_eigenvalues(24 if offset is None else 200, offset)
    assert np.all(np.abs(values[:6]) < 1e-5 * values[6])
    assert np.allclose(np.sqrt(values[6:14]), np.sqrt(exact), rtol=2e-4)


@pytest.mark.parametrize(
    ("figures", "order"),
    [(beams.curved_cantilever, 2.0), (beams.twisted_cantilever, 2.0)],
    ids=["curved", "twisted"],
)
def test_chains_of_straight_beams_converge_to_curved_and_twisted_ones(figures, order):
    """Closed forms by Castigliano's theorem; the polygon's error falls with its square."""
    errors = np.array([[abs(f.ratio - 1) for f in figures(count)] for count in (6, 12, 24, 48)])
    assert errors[-1].max() < 5e-4
    assert np.allclose(np.log2(errors[:-1] / errors[1:]), order, atol=0.2)


def test_published_targets_are_those_of_the_coarse_chain_of_beams():
    """MacNeal and Harder's 0.08734, 5.424e-3, 1.754e-3: 6 straight beams, 12 turned ones."""
    assert beams.curved_cantilever(6)[0].computed == pytest.approx(0.08734, rel=2e-4)
    assert beams.twisted_cantilever(12)[0].computed == pytest.approx(5.424e-3, rel=2e-4)
    assert beams.twisted_cantilever(12)[1].computed == pytest.approx(1.754e-3, rel=6e-4)


def test_timoshenko_beam_frequency():
    """Simply supported thick beam, first three modes against Timoshenko's frequency equation."""
    for figure in beams.thick_beam_frequencies():
        assert figure.ratio == pytest.approx(1.0, rel=2e-3)
