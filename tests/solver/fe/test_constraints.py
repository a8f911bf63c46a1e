"""Rigid bodies and interpolations: what they transmit, how they chain, what they refuse."""

import numpy as np
import pytest

from solver.errors import ModelError
from solver.fe.constraints import constraint_transformation
from solver.fe.model import Interpolation, RigidBody
from solver.fe.structure import build_structure
from verification.elements.meshes import model, rectangle_section, straight_beam
from verification.elements.supported import nothing_fixed, static

RNG = np.random.default_rng(2)
POINTS = RNG.normal(size=(9, 3))


def transformation(rigid=(), means=()):
    mesh = model(POINTS, rigid_bodies=rigid, interpolations=means)
    return constraint_transformation(mesh)


def rigid(identifier, independent, *dependents):
    return RigidBody(identifier, independent, np.array(dependents))


def mean(identifier, reference, *nodes, weights=None):
    weights = np.ones(len(nodes)) if weights is None else np.array(weights)
    return Interpolation(identifier, reference, np.array(nodes), weights)


def test_interpolation_is_the_weighted_least_squares_rigid_motion():
    """Independent computation: lstsq of the six rigid freedoms against random translations."""
    weights = [1.0, 3.0, 0.5, 2.0]
    matrix, free = transformation(means=[mean(1, 8, 0, 1, 2, 3, weights=weights)])
    motion = RNG.normal(size=len(free))
    found = (matrix @ motion).reshape(9, 6)
    levers = POINTS[:4] - POINTS[8]
    rows = np.zeros((4, 3, 6))
    rows[:, :, :3] = np.eye(3)
    for axis in range(3):
        rows[:, :, 3 + axis] = np.cross(np.eye(3)[axis], levers)
    root = np.sqrt(weights)[:, None]
    fitted = np.linalg.lstsq(
        (root[..., None] * rows).reshape(12, 6), (root * found[:4, :3]).ravel(), rcond=None
    )[0]
    assert np.allclose(found[8], fitted, atol=1e-12)


def test_interpolation_adds_no_stiffness():
    """A reference hung on three nodes of a beam leaves the beam's deflection unchanged."""
    mesh = straight_beam(1.0, 3, rectangle_section(0.02, 0.03))
    coordinates = np.concatenate([mesh.coordinates, [[0.7, 0.2, 0.3]], [[0.5, 0.4, 0.0]]])
    plain = build_structure(mesh)
    fixed = nothing_fixed(plain)
    fixed[0] = True
    loads = np.zeros(fixed.shape)
    loads[-1, :3] = 1.0, 2.0, 3.0
    expected = static(plain, fixed, loads)
    hung = model(
        coordinates,
        beams=mesh.beams,
        section=mesh.beam_properties[1],
        rigid_bodies=[rigid(1, 2, 5)],
        interpolations=[mean(2, 4, 1, 3, 5)],
    )
    structure = build_structure(hung)
    assert np.allclose(structure.stiffness.toarray(), plain.stiffness.toarray(), rtol=1e-12)
    assert np.array_equal(structure.free, np.arange(24))
    found = structure.nodal_displacements(expected.ravel())
    assert np.allclose(found[:4], expected)


def test_chains_are_resolved_in_any_order():
    """Rigid body on a reference, an interpolation of rigid dependents, another body on that."""
    bodies = [rigid(3, 7, 8), rigid(1, 0, 4, 5)]
    means = [mean(2, 7, 1, 4, 5, 2)]
    matrix, free = transformation(bodies, means)
    reversed_matrix, _ = transformation(bodies[::-1], means)
    assert abs(matrix - reversed_matrix).max() < 1e-14
    assert len(free) == 6 * 5
    motion = (matrix @ RNG.normal(size=len(free))).reshape(9, 6)
    for leader, follower in ((7, 8), (0, 4), (0, 5)):
        carried = motion[leader, :3] + np.cross(
            motion[leader, 3:], POINTS[follower] - POINTS[leader]
        )
        assert np.allclose(motion[follower, :3], carried)
        assert np.allclose(motion[follower, 3:], motion[leader, 3:])


@pytest.mark.parametrize(
    ("rigid_bodies", "means", "named"),
    [
        ([rigid(11, 0, 1), rigid(12, 2, 1)], [], ["node 2", "11", "12"]),
        ([rigid(11, 0, 1)], [mean(12, 1, 2, 3, 4)], ["node 2", "11", "12"]),
        ([rigid(11, 0, 1), rigid(12, 1, 0)], [], ["11", "12", "loop"]),
        ([rigid(11, 0, 1)], [mean(12, 0, 1, 2, 3)], ["11", "12", "loop"]),
        ([rigid(11, 0, 0)], [], ["11", "loop"]),
        ([], [mean(12, 0, 1, 2)], ["12", "line"]),
        ([], [mean(12, 0, 1, 2, 3, weights=[0.0, 0.0, 0.0])], ["12", "weights"]),
        ([], [mean(12, 0, 1, 2, 3, weights=[1.0, 1.0, -1.0])], ["12", "weights"]),
    ],
)
def test_contradictions_are_refused_by_identifier(rigid_bodies, means, named):
    with pytest.raises(ModelError) as refusal:
        transformation(rigid_bodies, means)
    for words in named:
        assert words in str(refusal.value)
