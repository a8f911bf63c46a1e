"""The steady deformed shape in which a landing begins, at finite rotation.

A body that turns at a constant rate and accelerates as a whole keeps its shape if its elements hold
what loads, gravity and inertia leave over: eq (10) of Lee et al., conventional inertia relief, with
the elements' true forces.  Newton's iteration, on any statically determinate support, whose
reactions vanish.
"""

import numpy as np

from solver.arrays import Array
from solver.errors import SimulationDivergedError
from solver.inertia_relief.factor import factorise
from solver.inertia_relief.free_body import FreeBody
from solver.inertia_relief.static import determinate_support
from solver.nonlinear.configuration import Configuration, Pose, initial_pose
from solver.nonlinear.elastic_motion import turned_inertia
from solver.nonlinear.rotations import exponential_quaternions
from solver.nonlinear.structure import NonlinearStructure
from solver.nonlinear.tangent import free_tangent

STEADY_TOLERANCE = 1e-7  #: energy norm of the last correction, relative to the deformation's
MAXIMUM_ITERATIONS = 30


def steady_pose(
    structure: NonlinearStructure, body: FreeBody, loads: Array, gravity: Array, rate: Array
) -> Pose:
    """Pose in which a free structure is at rest in axes that turn at ``rate``.

    It is the pose whose displacement is, to first order, free of rigid motion in the mean-axis
    sense.

    Parameters
    ----------
    body : FreeBody
        The linear model of the same structure and inertia.
    loads : (n, 6) array
        On all nodes [N, N m]; inertial axes are those of the coordinates.
    gravity, rate : (3,) arrays
        [m/s2], [rad/s]

    Raises
    ------
    SimulationDivergedError
        The corrections do not become small.
    """
    pose = initial_pose(structure.model.coordinates)
    support = determinate_support(body.rigid_modes, body.gyration_radius)
    moving = np.setdiff1d(np.arange(len(body.rigid_modes)), support)
    stiffness = body.stiffness
    for iteration in range(MAXIMUM_ITERATIONS):
        at = structure.constraints.placed(pose)
        deformations = structure.elements.deformations(at)
        forces = structure.elements.forces(deformations)
        held = np.zeros_like(loads)
        structure.elements.add_loads(at, deformations, forces, held)
        balance = _balanced_loads(structure, at, loads, gravity, rate) - held
        turns = at.rotations[structure.free_nodes]
        free = structure.on_free_nodes(at, balance).reshape(-1, 2, 3)
        residual = (free @ turns).ravel()
        if iteration:
            stiffness = free_tangent(structure, at)
        correction = np.zeros_like(residual)
        correction[moving] = factorise(stiffness[moving][:, moving]).solve(residual[moving])
        left, whole = abs(float(correction @ residual)), forces.work(deformations)
        inertial = correction.reshape(-1, 2, 3) @ np.swapaxes(turns, 1, 2)
        correction = body.mean_axis(inertial.ravel())
        everywhere = np.zeros((structure.model.node_count, 6))
        everywhere[structure.free_nodes] = correction.reshape(-1, 6)
        pose = pose.moved(everywhere[:, :3], exponential_quaternions(everywhere[:, 3:]))
        if left <= STEADY_TOLERANCE**2 * whole or not np.any(residual):
            return pose
        if not np.isfinite(left):
            break
    raise SimulationDivergedError(
        f"the steady shape is not found: {np.sqrt(left / whole):.3g} of the deformation is left "
        f"after {iteration + 1} corrections"
    )


def _balanced_loads(
    structure: NonlinearStructure, at: Configuration, loads: Array, gravity: Array, rate: Array
) -> Array:
    """Sum loads, gravity and inertia (n, 6) on all nodes; without resultant."""
    points, rotary = structure.points, structure.rotary
    places = points.places(at)
    mass = points.mass
    weights = np.asarray(mass.sum(axis=1)).ravel()
    centre = weights @ places / weights.sum()
    arms = places - centre
    bodies = turned_inertia(rotary, at.rotations)
    second = arms.T @ (mass @ arms)
    inertia = np.trace(second) * np.eye(3) - second + bodies.sum(axis=0)

    force = loads[:, :3].sum(axis=0) + weights.sum() * gravity
    moment = (np.cross(at.positions - centre, loads[:, :3]) + loads[:, 3:]).sum(axis=0)
    gyroscopic = np.cross(rate, inertia @ rate)
    acceleration = force / weights.sum()
    rate_derivative = np.linalg.solve(inertia, moment - gyroscopic)
    field = acceleration + np.cross(rate_derivative, arms) + np.cross(rate, np.cross(rate, arms))
    total = loads.copy()
    points.add_loads(at, places, weights[:, None] * gravity - mass @ field, total)
    total[rotary.nodes, 3:] -= bodies @ rate_derivative + np.cross(rate, bodies @ rate)
    return total
