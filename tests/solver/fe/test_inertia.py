"""Mass properties and the inertia terms of a turning frame."""

import dataclasses

import numpy as np
import pytest
from scipy.linalg import eig, eigh
from scipy.spatial.transform import Rotation

from solver.fe.inertia import RATE_PRODUCTS, combine, point_mass_inertia
from solver.fe.mass import DRILLING_SHARE
from solver.fe.model import Interpolation, RigidBody
from solver.fe.structure import build_structure
from solver.frames import skew
from verification.elements.meshes import (
    beams_on,
    lumped,
    material,
    model,
    plate,
    rectangle_section,
    straight_beam,
    surface,
)

RNG = np.random.default_rng(11)
DENSITY = material().density


def kinetic_properties(structure, origin):
    """6 x 6 rigid-body mass matrix Phi' M Phi about ``origin``."""
    modes = structure.rigid_modes(origin)
    return modes.T @ structure.inertia.mass_matrix() @ modes


def everything():
    """Warped quads and triangles, an offset beam, masses, both constraints: one of each."""
    mesh = surface(
        lambda s, t: np.stack([2 * s, 3 * t, 0.7 * s * t + 0.2 * np.sin(3 * t)], -1), 3, 4
    )
    extra = np.array([[1.0, 1.5, 1.4], [1.2, 1.7, 2.0], [-0.8, 0.3, 0.1]])
    coordinates = np.concatenate([mesh.coordinates, extra])
    count = mesh.node_count
    inertia = np.diag([0.4, 0.7, 0.9]) + 0.1
    return model(
        coordinates,
        quads=mesh.quads.nodes[:-2],
        triangles=np.concatenate([mesh.quads.nodes[-2:, :3], mesh.quads.nodes[-2:, [0, 2, 3]]]),
        beams=beams_on(np.array([[0, 1], [1, 6], [6, count + 2]]), (0.1, 0.2, 1), (0.1, 0, -0.2)),
        section=rectangle_section(0.02, 0.04),
        shell_mass=3.0,
        masses=lumped([count + 1, 4], [25.0, 4.0], [[0.1, 0.2, 0.3], [0, 0, -0.5]], [inertia] * 2),
        interpolations=[Interpolation(7, count, np.array([5, 6, 9, 10]), np.array([1, 2, 1, 3.0]))],
        rigid_bodies=[RigidBody(8, count, np.array([count + 1]))],
    )


def test_properties_of_a_bar_are_exact():
    """m = rho A L; about the middle m L^2 / 12 + rho L I across, rho L (I1 + I2) along."""
    length, section = 2.5, rectangle_section(0.02, 0.05)
    section = dataclasses.replace(section, nonstructural_mass=0.8)
    structure = build_structure(straight_beam(length, 3, section))
    found = structure.inertia.rigid_body_properties()
    line = DENSITY * section.area + 0.8
    bar = line * length**3 / 12
    across = DENSITY * length
    expected = [
        across * (section.inertia_1 + section.inertia_2),
        bar + across * section.inertia_2,
        bar + across * section.inertia_1,
    ]
    assert found.mass == pytest.approx(line * length, rel=1e-13)
    assert np.allclose(found.centre_of_gravity, [length / 2, 0, 0], rtol=0, atol=1e-13)
    assert np.allclose(found.inertia, np.diag(expected), rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("triangular", [False, True])
def test_properties_of_a_plate_are_exact(triangular):
    """m b^2 / 12 and the section's rho t^3 / 12 per area, its share about the normal included."""
    width, length, thickness = 1.2, 2.0, 0.04
    structure = build_structure(
        plate(width, length, 3, 4, triangular, thickness=thickness, shell_mass=5.0)
    )
    found = structure.inertia.rigid_body_properties()
    mass = (DENSITY * thickness + 5.0) * width * length
    rotary = DENSITY * thickness**3 / 12 * width * length
    expected = [
        mass * length**2 / 12 + rotary,
        mass * width**2 / 12 + rotary,
        mass * (length**2 + width**2) / 12 + DRILLING_SHARE * rotary,
    ]
    assert found.mass == pytest.approx(mass, rel=1e-13)
    assert np.allclose(found.centre_of_gravity, [width / 2, length / 2, 0], atol=1e-13)
    assert np.allclose(found.inertia, np.diag(expected), rtol=1e-12, atol=1e-12)


def test_properties_of_offset_masses_are_exact():
    """Steiner's theorem: each mass at node + offset with its own tensor."""
    masses, offsets = np.array([3.0, 5.0]), RNG.normal(size=(2, 3))
    tensors = np.array([np.diag([1.0, 2.0, 2.5]), np.diag([0.3, 0.3, 0.1])])
    mesh = straight_beam(2.0, 2, rectangle_section(0.02, 0.02))
    structure = build_structure(mesh)
    carried = point_mass_inertia(
        structure.transformation, mesh.coordinates, lumped([0, 2], masses, offsets, tensors)
    )
    found = carried.rigid_body_properties()
    places = mesh.coordinates[[0, 2]] + offsets
    centre = masses @ places / masses.sum()
    inertia = tensors.sum(axis=0)
    for mass, place in zip(masses, places, strict=True):
        inertia = inertia - mass * skew(place - centre) @ skew(place - centre)
    assert found.mass == pytest.approx(8.0)
    assert np.allclose(found.centre_of_gravity, centre, atol=1e-14)
    assert np.allclose(found.inertia, inertia, atol=1e-13)


def test_mass_matrix_on_rigid_modes_gives_the_same_properties():
    structure = build_structure(everything())
    found = structure.inertia.rigid_body_properties()
    matrix = kinetic_properties(structure, found.centre_of_gravity)
    expected = np.zeros((6, 6))
    expected[:3, :3] = found.mass * np.eye(3)
    expected[3:, 3:] = found.inertia
    assert np.allclose(matrix, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


def test_mass_matrix_is_symmetric_and_positive_definite():
    mass = build_structure(everything()).inertia.mass_matrix().toarray()
    assert np.allclose(mass, mass.T, rtol=0, atol=1e-14 * np.abs(mass).max())
    scale = np.sqrt(np.diag(mass))
    assert np.linalg.eigvalsh(mass / np.outer(scale, scale)).min() > 1e-6


def test_inertia_is_affine_in_the_loading():
    """combine([(1, empty), (f, tank)]) has M, G, E, C and loads of the sum of the parts."""
    structure = build_structure(everything())
    empty = structure.inertia
    tank = point_mass_inertia(
        structure.transformation,
        structure.model.coordinates,
        lumped([2, 7, 8], [10.0, 20.0, 5.0], RNG.normal(size=(3, 3)), [np.diag([1, 2, 2.5])] * 3),
    )
    both = combine([(1.0, empty), (0.37, tank), (0.0, tank)])
    origin = np.array([0.3, -0.2, 0.9])
    for term in (
        lambda part: part.mass_matrix().toarray(),
        lambda part: part.gyroscopic(1).toarray(),
        lambda part: part.euler(2).toarray(),
        lambda part: part.centrifugal(0, 2).toarray(),
        lambda part: part.rigid_load_shapes(origin),
        lambda part: part.gravity_shapes(),
    ):
        expected = term(empty) + 0.37 * term(tank)
        assert np.allclose(term(both), expected, rtol=0, atol=1e-13 * np.abs(expected).max())
    assert combine([(0.0, tank)]).rigid_body_properties().mass == 0.0


def test_rate_terms_are_skew_symmetric_and_semidefinite():
    inertia = build_structure(everything()).inertia
    mass = inertia.mass_matrix().toarray()
    scale = np.abs(mass).max()
    for axis in range(3):
        gyroscopic = inertia.gyroscopic(axis).toarray()
        assert np.allclose(gyroscopic, -gyroscopic.T, rtol=0, atol=1e-14 * scale)
    rate = RNG.normal(size=3)
    total = np.zeros_like(mass)
    for i, j in RATE_PRODUCTS:
        term = inertia.centrifugal(i, j).toarray()
        assert np.allclose(term, term.T, rtol=0, atol=1e-14 * scale)
        total += rate[i] * rate[j] * term
    assert np.linalg.eigvalsh(total).max() < 1e-13 * scale


def test_rate_terms_come_from_the_kinetic_energy():
    """T = 1/2 v' m v with v = u' + w x u at the points, and alike for rotary bodies."""
    inertia = build_structure(everything()).inertia
    rate, u, du = RNG.normal(size=3), *RNG.normal(size=(2, inertia.n_free))
    energy = 0.0
    for interpolation, weigh in (
        (inertia.interpolation, lambda v: np.sum(v * (inertia.scalar_mass @ v))),
        (inertia.rotary_interpolation, lambda v: np.einsum("ki,kij,kj", v, inertia.rotary, v)),
    ):
        place, speed = (interpolation @ vector for vector in (u, du))
        velocity = speed.reshape(-1, 3) + np.cross(rate, place.reshape(-1, 3))
        energy += 0.5 * weigh(velocity)
    gyroscopic = sum(rate[k] * inertia.gyroscopic(k) for k in range(3))
    centrifugal = sum(rate[i] * rate[j] * inertia.centrifugal(i, j) for i, j in RATE_PRODUCTS)
    coupling = sum(rate[k] * inertia.euler(k) for k in range(3))
    mass = inertia.mass_matrix()
    expected = 0.5 * du @ mass @ du + du @ (coupling @ u) - 0.5 * u @ (centrifugal @ u)
    assert energy == pytest.approx(expected, rel=1e-12)
    # Lagrange: the velocity term is the skew part of the coupling, doubled.
    skewed = coupling - coupling.T
    assert abs(skewed - gyroscopic).max() < 1e-12 * abs(gyroscopic).max()


def test_rigid_load_balances_newton_and_euler():
    """On the rigid modes: m (g - a_c) and -(J w' + w x J w) about the centre of gravity."""
    structure = build_structure(everything())
    properties = structure.inertia.rigid_body_properties()
    mass, inertia, centre = properties.mass, properties.inertia, properties.centre_of_gravity
    origin = np.array([0.4, -1.0, 2.0])
    acceleration, gravity, rate, slope = RNG.normal(size=(4, 5, 3))
    load = structure.inertia.rigid_load(acceleration, gravity, rate, slope, origin)
    resultant = structure.rigid_modes(centre).T @ load
    lever = centre - origin
    at_centre = acceleration + np.cross(slope, lever) + np.cross(rate, np.cross(rate, lever))
    force = mass * (gravity - at_centre)
    moment = -(slope @ inertia + np.cross(rate, rate @ inertia))
    expected = np.concatenate([force, moment], axis=1).T
    assert np.allclose(resultant, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


def test_gravity_shapes_are_the_load_of_unit_gravity():
    structure = build_structure(everything())
    zero = np.zeros((3, 3))
    load = structure.inertia.rigid_load(zero, np.eye(3), zero, zero, np.zeros(3))
    assert np.allclose(structure.inertia.gravity_shapes(), load, atol=1e-12)


def test_beam_spinning_about_its_axis_shifts_its_bending_frequencies_by_the_spin():
    """|w_n +- Omega| in the turning frame: W acts on translations and rotations alike."""
    section = rectangle_section(0.2, 0.2)
    structure = build_structure(straight_beam(4.0, 6, section))
    inertia, stiffness = structure.inertia, structure.stiffness.toarray()
    mass = inertia.mass_matrix().toarray()
    still, modes = eigh(stiffness, mass)
    transverse = np.linalg.norm(modes.reshape(-1, 6, len(still))[:, [1, 2]], axis=(0, 1))
    lowest = np.sqrt(still[(transverse > 1e-6) & (still > 1.0)][:8])
    spin = 0.3 * lowest[0]
    size = len(mass)
    gyroscopic = spin * inertia.gyroscopic(0).toarray()
    softened = stiffness + spin**2 * inertia.centrifugal(0, 0).toarray()
    inverse = np.linalg.inv(mass)
    state = np.block(
        [[np.zeros((size, size)), np.eye(size)], [-inverse @ softened, -inverse @ gyroscopic]]
    )
    found = np.abs(eig(state, right=False).imag)
    for frequency in lowest:
        for shifted in (frequency - spin, frequency + spin):
            assert np.abs(found / shifted - 1).min() < 1e-9


def test_frequencies_do_not_depend_on_the_orientation_of_the_model():
    mesh = everything()
    reference = build_structure(mesh)
    turn = Rotation.from_rotvec([0.9, -0.3, 1.7]).as_matrix()
    turned = dataclasses.replace(
        mesh,
        coordinates=mesh.coordinates @ turn.T + [100.0, -40.0, 7.0],
        beams=dataclasses.replace(
            mesh.beams,
            offsets=mesh.beams.offsets @ turn.T,
            orientations=mesh.beams.orientations @ turn.T,
        ),
        point_masses=dataclasses.replace(
            mesh.point_masses,
            offsets=mesh.point_masses.offsets @ turn.T,
            inertias=turn @ mesh.point_masses.inertias @ turn.T,
        ),
    )
    lowest = [lowest_flexible(structure, 30) for structure in (reference, build_structure(turned))]
    assert np.allclose(lowest[0], lowest[1], rtol=1e-8)


def lowest_flexible(structure, count):
    """Squares of the lowest circular frequencies above the rigid modes.

    As 1 / lambda of the shifted problem, since the drilling modes, 1e12 times higher, would
    otherwise set the rounding.
    """
    mass = structure.inertia.mass_matrix().toarray()
    shift = 100.0
    inverse = eigh(mass, structure.stiffness.toarray() + shift * mass, eigvals_only=True)
    return (1 / inverse[::-1] - shift)[6 : 6 + count]
