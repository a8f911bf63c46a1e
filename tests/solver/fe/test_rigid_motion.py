"""Every element and constraint stores no energy and shows no stress in the six rigid motions."""

import numpy as np
import pytest

from solver.fe.model import Interpolation, RigidBody
from solver.fe.stress import build_stress_recovery
from solver.fe.structure import build_structure
from verification.elements.meshes import beams_on, model, rectangle_section

RNG = np.random.default_rng(5)
WARPED = np.array([[0, 0, 0.1], [1.1, 0.1, -0.2], [1.3, 0.9, 0.25], [-0.1, 1.0, -0.1]])


def models():
    section = rectangle_section(0.03, 0.06)
    offset = beams_on(np.array([[0, 1], [1, 2]]), (0.2, 0.1, 1.0), (0.05, -0.1, 0.3))
    far = np.concatenate([WARPED, [[2.0, 3.0, 1.0], [2.5, 3.2, 1.7]]])
    return {
        "warped quad": model(WARPED, quads=np.array([[0, 1, 2, 3]])),
        "triangle": model(WARPED[:3], triangles=np.array([[0, 1, 2]])),
        "offset beams": model(WARPED[:3], beams=offset, section=section),
        "rigid body": model(
            far[:5],
            quads=np.array([[0, 1, 2, 3]]),
            beams=beams_on(np.array([[3, 4]]), (0, 0, 1)),
            section=section,
            rigid_bodies=[RigidBody(1, 4, np.array([1, 2]))],
        ),
        "interpolation with a rigid body on its reference": model(
            far,
            quads=np.array([[0, 1, 2, 3]]),
            beams=beams_on(np.array([[5, 3]]), (0, 0, 1)),
            section=section,
            interpolations=[Interpolation(1, 4, np.arange(4), np.array([1.0, 2.0, 0.5, 1.0]))],
            rigid_bodies=[RigidBody(2, 4, np.array([5]))],
        ),
    }


@pytest.mark.parametrize("name", list(models()))
def test_exactly_six_rigid_modes_without_energy_or_stress(name):
    structure = build_structure(models()[name])
    modes = structure.rigid_modes(RNG.normal(size=3))
    stiffness = structure.stiffness.toarray()
    assert np.allclose(stiffness, stiffness.T, rtol=0, atol=1e-14 * np.abs(stiffness).max())
    assert np.abs(stiffness @ modes).max() < 1e-13 * np.abs(stiffness).max()
    values = np.linalg.eigvalsh(stiffness)
    assert np.abs(values[:6]).max() < 1e-13 * values[-1]
    assert values[6] > 1e-9 * values[-1]
    recovery = build_stress_recovery(structure)
    for operator in (recovery.shell_operator, recovery.beam_operator):
        if operator.shape[0]:
            assert np.abs(operator @ modes).max() < 1e-12 * abs(operator).max()


@pytest.mark.parametrize("name", list(models()))
def test_rigid_modes_of_free_freedoms_are_rigid_everywhere(name):
    structure = build_structure(models()[name])
    origin = RNG.normal(size=3)
    everywhere = structure.nodal_displacements(structure.rigid_modes(origin))
    levers = structure.model.coordinates - origin
    for axis in range(3):
        direction = np.eye(3)[axis]
        assert np.allclose(everywhere[:, :3, axis], direction, atol=1e-12)
        assert np.allclose(everywhere[:, :3, 3 + axis], np.cross(direction, levers), atol=1e-12)
        assert np.allclose(everywhere[:, 3:, 3 + axis], direction, atol=1e-12)


@pytest.mark.parametrize("name", list(models()))
def test_nodal_loads_keep_their_resultant_through_constraints(name):
    structure = build_structure(models()[name])
    rows = np.arange(structure.model.node_count)
    loads = structure.nodal_loads(rows)
    resultant = (loads.T @ structure.rigid_modes(np.zeros(3))).reshape(len(rows), 6, 6)
    for row, position in enumerate(structure.model.coordinates):
        for axis in range(3):
            force = np.concatenate([np.eye(3)[axis], np.cross(position, np.eye(3)[axis])])
            assert np.allclose(resultant[row, axis], force, atol=1e-12)
            assert np.allclose(resultant[row, 3 + axis], np.eye(6)[3 + axis], atol=1e-12)
