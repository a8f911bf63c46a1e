"""Corotated elements: blind to rigid motion, an exact gradient, the linear elements when small."""

from dataclasses import replace

import numpy as np
import pytest

from solver.fe.stress import build_stress_recovery
from solver.fe.structure import build_structure
from solver.nonlinear.configuration import initial_pose
from solver.nonlinear.structure import nonlinear_structure
from solver.nonlinear.tangent import tangent_stiffness
from tests.solver.nonlinear.bodies import (
    FAR_TURN,
    deformed,
    disturbed_pose,
    further,
    mixed,
    mixed_model,
    resultant,
)


def test_rigid_motion_of_any_size_deforms_no_element():
    structure = mixed()
    pose = initial_pose(structure.model.coordinates)
    moved = structure.constraints.placed(pose.rigidly_moved(FAR_TURN, np.array([10.0, 20.0, 30.0])))
    for part in structure.elements.deformations(moved).parts:
        assert np.abs(part).max() < 1e-14


def test_loads_are_the_gradient_of_the_strain_energy_through_all_constraints():
    structure = mixed()
    pose = deformed(structure, 0.1)
    at = structure.constraints.placed(pose)
    loads = structure.on_free_nodes(at, structure.elements.static_loads(at))
    direction = np.random.default_rng(1).normal(size=loads.shape)

    def energy(share: float) -> float:
        moved = structure.constraints.placed(further(structure, pose, share * direction))
        return structure.elements.strain_energy(structure.elements.deformations(moved))

    slope = (energy(1e-6) - energy(-1e-6)) / 2e-6
    assert np.vdot(loads, direction) == pytest.approx(slope, rel=1e-7)


def test_loads_of_any_forces_have_no_resultant():
    structure = mixed()
    at = structure.constraints.placed(deformed(structure, 0.1))
    deformations = structure.elements.deformations(at)
    loads = np.zeros((structure.model.node_count, 6))
    # forces that no stiffness would give, so that only the frames keep the balance
    structure.elements.add_loads(at, deformations, deformations, loads)
    size = np.abs(loads).sum()
    np.testing.assert_allclose(resultant(at, loads), 0.0, atol=1e-14 * size)
    structure.constraints.carry_back(at, loads)
    np.testing.assert_allclose(resultant(at, loads), 0.0, atol=1e-14 * size)


def test_tangent_at_rest_is_the_linear_stiffness():
    # by one-sided differences, hence right to about 1e-6
    structure, linear = mixed(), build_structure(mixed_model())
    at = structure.constraints.placed(initial_pose(structure.model.coordinates))
    tangent = tangent_stiffness(structure.elements, at)
    reduced = (linear.transformation.T @ tangent @ linear.transformation).toarray()
    largest = abs(linear.stiffness).max()
    np.testing.assert_allclose(reduced, linear.stiffness.toarray(), atol=1e-5 * largest)


def test_tangent_turns_with_the_body():
    structure = mixed()
    count = structure.model.node_count
    at = structure.constraints.placed(initial_pose(structure.model.coordinates))
    rest = tangent_stiffness(structure.elements, at).toarray()
    pose = initial_pose(structure.model.coordinates).rigidly_moved(FAR_TURN, np.zeros(3))
    turned = structure.constraints.placed(pose)
    found = tangent_stiffness(structure.elements, turned).toarray()
    blocks = np.kron(np.eye(2 * count), turned.rotations[0])
    np.testing.assert_allclose(found, blocks @ rest @ blocks.T, atol=1e-5 * np.abs(rest).max())


def test_small_deformations_have_the_stresses_of_the_linear_analysis():
    structure, linear = mixed(), build_structure(mixed_model())
    recovery = build_stress_recovery(linear)
    freedoms = 1e-7 * np.random.default_rng(5).normal(size=(len(structure.free_nodes), 6))
    pose = disturbed_pose(structure, freedoms).rigidly_moved(FAR_TURN, np.ones(3))
    at = structure.constraints.placed(pose)
    shells, beams = structure.elements.stresses(structure.elements.deformations(at))
    for found, operator in ((shells, recovery.shell_operator), (beams, recovery.beam_operator)):
        expected = operator @ freedoms.ravel()
        np.testing.assert_allclose(found, expected, atol=1e-5 * np.abs(expected).max())


@pytest.mark.parametrize("kind", ["quads", "triangles"])
def test_shells_do_not_care_where_their_numbering_begins(kind):
    model = mixed_model()
    shells = getattr(model, kind)
    rolled = replace(model, **{kind: replace(shells, nodes=np.roll(shells.nodes, 1, axis=1))})
    structure, other = mixed(), nonlinear_structure(rolled)
    at = structure.constraints.placed(deformed(structure, 0.05))
    one = structure.elements.static_loads(at)
    np.testing.assert_allclose(other.elements.static_loads(at), one, atol=1e-11 * np.abs(one).max())
