"""Constraints and mass points at finite rotation."""

import numpy as np
import pytest

from solver.fe.beam import beam_geometry
from solver.fe.mass import structural_inertia
from solver.fe.sections import beam_sections, shell_sections
from solver.fe.structure import build_structure
from solver.frames import rotation_matrix
from solver.nonlinear.configuration import initial_pose
from tests.solver.nonlinear.bodies import (
    FAR_TURN,
    deformed,
    disturbed_pose,
    further,
    mixed,
    mixed_model,
    resultant,
)


def test_dependent_nodes_follow_a_rigid_motion_of_any_size():
    structure = mixed()
    coordinates = structure.model.coordinates
    pose = initial_pose(coordinates).rigidly_moved(FAR_TURN, np.array([1.0, 2.0, 3.0]))
    pose.positions[structure.constraints.nodes] = np.nan
    at = structure.constraints.placed(pose)
    matrix = rotation_matrix(FAR_TURN)
    np.testing.assert_allclose(at.positions, coordinates @ matrix.T + [1.0, 2.0, 3.0], atol=1e-14)
    np.testing.assert_allclose(
        at.rotations, np.broadcast_to(matrix, at.rotations.shape), atol=1e-14
    )


def test_small_motion_of_dependent_nodes_is_that_of_the_linear_constraints():
    structure, linear = mixed(), build_structure(mixed_model())
    freedoms = np.random.default_rng(2).normal(size=(len(structure.free_nodes), 6))
    places = [
        structure.constraints.placed(disturbed_pose(structure, share * freedoms))
        for share in (1e-6, -1e-6)
    ]
    expected = linear.nodal_displacements(freedoms.ravel())
    found = (places[0].positions - places[1].positions) / 2e-6
    np.testing.assert_allclose(found, expected[:, :3], atol=1e-8)
    spins = (places[0].rotations - places[1].rotations) / 2e-6
    np.testing.assert_allclose(spins[:, 2, 1], expected[:, 3], atol=1e-8)


def test_linearised_motion_of_dependent_nodes_is_its_derivative_at_any_turn():
    structure = mixed()
    pose = deformed(structure, 0.1)
    at = structure.constraints.placed(pose)
    direction = np.random.default_rng(11).normal(size=(len(structure.free_nodes), 6))
    ahead, behind = (
        structure.constraints.placed(further(structure, pose, share * direction))
        for share in (1e-6, -1e-6)
    )
    velocity = (ahead.positions - behind.positions) / 2e-6
    spin = (ahead.rotations - behind.rotations) / 2e-6 @ np.swapaxes(at.rotations, 1, 2)
    turns = at.rotations[structure.free_nodes]
    own = np.einsum("kji,kaj->kai", turns, direction.reshape(-1, 2, 3)).ravel()
    found = structure.constraints.transfer(at, structure.free_nodes) @ own
    inertial = np.einsum("kij,kaj->kai", at.rotations, found.reshape(-1, 2, 3))
    np.testing.assert_allclose(inertial[:, 0], velocity, atol=1e-8)
    axial = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=1)
    np.testing.assert_allclose(inertial[:, 1], axial, atol=1e-8)


def test_forces_on_dependent_nodes_do_the_same_work_on_their_leaders():
    structure = mixed()
    pose = deformed(structure, 0.1)
    at = structure.constraints.placed(pose)
    rng = np.random.default_rng(4)
    forces = np.zeros((structure.model.node_count, 6))
    forces[structure.constraints.nodes, :3] = rng.normal(size=(3, 3))
    direction = rng.normal(size=(len(structure.free_nodes), 6))
    ahead, behind = (
        structure.constraints.placed(further(structure, pose, share * direction)).positions
        for share in (1e-6, -1e-6)
    )
    work = np.vdot(forces[:, :3], (ahead - behind) / 2e-6)
    before = resultant(at, forces)
    carried = structure.on_free_nodes(at, forces)
    assert np.vdot(carried, direction) == pytest.approx(work, rel=1e-7)
    np.testing.assert_allclose(resultant(at, forces), before, atol=1e-13)


def test_mass_points_and_masses_are_those_of_the_linear_model():
    structure, model = mixed(), mixed_model()
    linear = build_structure(model)
    inertia = structural_inertia(
        model,
        linear.transformation,
        shell_sections(model, model.quads),
        shell_sections(model, model.triangles),
        beam_sections(model, model.beams),
        beam_geometry(model.coordinates, model.beams),
    )
    at = structure.constraints.placed(initial_pose(model.coordinates))
    np.testing.assert_allclose(structure.points.places(at), inertia.points, atol=1e-14)
    np.testing.assert_array_equal(structure.points.mass.toarray(), inertia.scalar_mass.toarray())
    np.testing.assert_array_equal(structure.rotary.inertia, inertia.rotary)
    freedoms = np.random.default_rng(6).normal(size=(len(structure.free_nodes), 6))
    ahead, behind = (
        structure.points.places(
            structure.constraints.placed(disturbed_pose(structure, share * freedoms))
        )
        for share in (1e-6, -1e-6)
    )
    expected = (inertia.interpolation @ freedoms.ravel()).reshape(-1, 3)
    np.testing.assert_allclose((ahead - behind) / 2e-6, expected, atol=1e-8)


def test_forces_on_mass_points_go_back_by_the_derivative_of_their_places():
    structure = mixed()
    pose = deformed(structure, 0.1)
    at = structure.constraints.placed(pose)
    places = structure.points.places(at)
    rng = np.random.default_rng(7)
    forces = rng.normal(size=places.shape)
    direction = rng.normal(size=(len(structure.free_nodes), 6))
    ahead, behind = (
        structure.points.places(
            structure.constraints.placed(further(structure, pose, share * direction))
        )
        for share in (1e-6, -1e-6)
    )
    loads = np.zeros((structure.model.node_count, 6))
    structure.points.add_loads(at, places, forces, loads)
    carried = structure.on_free_nodes(at, loads)
    work = np.vdot(forces, (ahead - behind) / 2e-6)
    assert np.vdot(carried, direction) == pytest.approx(work, rel=1e-7)


def test_moment_of_forces_beside_their_mass_points_is_kept():
    structure = mixed()
    at = structure.constraints.placed(deformed(structure, 0.1))
    rng = np.random.default_rng(8)
    places = structure.points.places(at)
    places += 0.01 * rng.normal(size=places.shape)
    forces = rng.normal(size=places.shape)
    loads = np.zeros((structure.model.node_count, 6))
    structure.points.add_loads(at, places, forces, loads)
    expected = np.concatenate([forces.sum(axis=0), np.cross(places, forces).sum(axis=0)])
    np.testing.assert_allclose(resultant(at, loads), expected, atol=1e-12)
