"""Small bodies for tests: every kind of element, constraint and mass, none of them aligned."""

from functools import cache

import numpy as np

from solver.arrays import Array
from solver.fe.model import FiniteElementModel, Interpolation, RigidBody
from solver.nonlinear.configuration import Configuration, Pose, initial_pose
from solver.nonlinear.rotations import exponential_quaternions
from solver.nonlinear.structure import NonlinearStructure, nonlinear_structure
from verification.elements import meshes

#: A turn beyond half a revolution about no axis in particular.
FAR_TURN = exponential_quaternions(np.array([[1.7, -2.1, 0.9]]))[0]


@cache
def mixed_model() -> FiniteElementModel:
    """Warped strip of quadrilaterals and triangles with offset stringers, bodies and masses.

    Nodes 0 to 14 are the strip; 15 hangs rigidly on 14, 16 follows four nodes of the strip, 17
    hangs rigidly on 16 (a chain).
    """
    x, y = np.meshgrid(np.linspace(0, 2, 5), np.linspace(0, 1, 3))
    z = 0.3 * np.sin(1.3 * x + 2.0 * y) + 0.1 * x * y
    strip = np.stack([x + 0.07 * np.cos(5 * y), y + 0.05 * np.sin(4 * x), z], axis=-1)
    extra = np.array([[2.4, 1.2, 0.5], [0.9, 0.5, -0.6], [0.9, 0.3, -1.1]])
    coordinates = np.concatenate([strip.reshape(-1, 3), extra])
    quads = meshes.grid_quads(np.arange(15).reshape(3, 5))
    return meshes.model(
        coordinates,
        quads=quads[:6],
        triangles=meshes.split(quads[6:]),
        beams=meshes.beams_on(
            np.array([[0, 1], [1, 2], [2, 7], [14, 15], [16, 3]]),
            orientation=(0.1, 0.2, 1.0),
            offset=(0.01, -0.02, -0.04),
        ),
        section=meshes.rectangle_section(0.05, 0.03),
        thickness=0.02,
        masses=meshes.lumped(
            [4, 12, 15, 16, 17],
            [3.0, 2.0, 1.5, 4.0, 2.5],
            offsets=[[0.1, 0.0, 0.2], [0, 0, 0], [0, 0.1, 0], [0.05, 0, -0.1], [0, 0, 0.1]],
            inertias=[np.diag([0.1, 0.2, 0.25]) * k for k in (0, 1, 0, 2, 1)],
        ),
        rigid_bodies=[RigidBody(1, 14, np.array([15])), RigidBody(2, 16, np.array([17]))],
        interpolations=[Interpolation(3, 16, np.array([1, 3, 6, 8]), np.array([1.0, 2, 1, 0.5]))],
    )


@cache
def mixed() -> NonlinearStructure:
    return nonlinear_structure(mixed_model())


def disturbed_pose(structure: NonlinearStructure, freedoms: Array) -> Pose:
    """Pose moved by free freedoms (nf, 6): displacements and rotation vectors."""
    return further(structure, initial_pose(structure.model.coordinates), freedoms)


def further(structure: NonlinearStructure, pose: Pose, freedoms: Array) -> Pose:
    everywhere = np.zeros((structure.model.node_count, 6))
    everywhere[structure.free_nodes] = freedoms
    return pose.moved(everywhere[:, :3], exponential_quaternions(everywhere[:, 3:]))


def deformed(structure: NonlinearStructure, size: float, seed: int = 3) -> Pose:
    """Random free freedoms of a size [m, rad], then the far turn."""
    freedoms = size * np.random.default_rng(seed).normal(size=(len(structure.free_nodes), 6))
    pose = disturbed_pose(structure, freedoms)
    return pose.rigidly_moved(FAR_TURN, np.array([3.0, -1.0, 2.0]))


def resultant(at: Configuration, loads: Array) -> Array:
    """Force and moment about the origin (6,) of nodal loads (n, 6)."""
    moment = np.cross(at.positions, loads[:, :3]) + loads[:, 3:]
    return np.concatenate([loads[:, :3].sum(axis=0), moment.sum(axis=0)])
