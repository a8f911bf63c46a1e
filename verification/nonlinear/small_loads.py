"""Small loads: the nonlinear analysis must reproduce the linear one, damping and inertia included.

Both integrate the same steps.  Loads are pins and air loads of an airframe at about the strengths
of a landing, times a small factor; what the nonlinear stresses differ by, relative to the largest,
must shrink with that factor.
"""

from dataclasses import dataclass

import numpy as np

from solver.aircraft.airframe import Airframe
from solver.arrays import Array
from solver.inertia_relief.build import airframe_damping
from solver.inertia_relief.free_body import FreeBody, free_body
from solver.inertia_relief.full_order import BodyLoads, integrate_full_order
from solver.inertia_relief.loads import applied_shapes
from solver.inertia_relief.motion import RigidMotion
from solver.nonlinear.checkpoint import Sample
from solver.nonlinear.correction import Corrector
from solver.nonlinear.integrate import integrate_nonlinear
from solver.nonlinear.loads import dead_loads, free_shapes
from solver.nonlinear.midpoint import motion_of
from solver.nonlinear.steady import steady_pose
from solver.nonlinear.structure import loaded_model, nonlinear_structure

#: Force on every pin and of the air at full strength [N].
STRENGTH = 2e4
#: Parts of it by component x, y, z, and moments about them [m].  Sideways forces and moments push
#: thin webs out of their plane, where they soften under a small part of the others.
SHARES = (1.0, 0.05, 1.0, 0.005, 0.005, 0.005)


@dataclass(frozen=True, slots=True)
class SmallLoads:
    """Von Mises stresses (nt, ne) divided by the factor of the loads [Pa]."""

    factor: float
    nonlinear: Array
    linear: Array

    @property
    def difference(self) -> float:
        """Largest difference of any element at any time, relative to the largest stress."""
        return float(np.abs(self.nonlinear - self.linear).max() / self.linear.max())


def small_loads(
    airframe: Airframe, factors: Array, factor: float, samples: int = 40, step: float = 1e-3
) -> SmallLoads:
    """Push an airframe at its pins, with both analyses, from its steady shape."""
    body = free_body(airframe.structure, airframe.inertia(factors))
    time = step * np.arange(samples + 1, dtype=np.float64)
    shapes = applied_shapes(airframe)
    amplitudes = factor * _courses(shapes.shape[1], time)
    motion = _rigid_motion(body, shapes, amplitudes)
    damping = airframe_damping(airframe)
    recovery = airframe.recovery

    linear = np.empty((len(time), recovery.n_shells + recovery.n_beams))

    def consume(first: int, block: Array) -> None:
        rows = recovery.shell_operator @ block, recovery.beam_operator @ block
        linear[first : first + block.shape[1]] = recovery.von_mises(*rows).T

    integrate_full_order(body, BodyLoads(time, shapes, amplitudes, motion), damping, consume)

    structure = nonlinear_structure(loaded_model(airframe, factors))
    loads = dead_loads(time, free_shapes(airframe.structure, shapes), amplitudes, np.zeros(3))
    pose = steady_pose(structure, body, loads.at(0.0), np.zeros(3), np.zeros(3))
    nonlinear = np.empty_like(linear)

    def record(sample: Sample) -> None:
        shells, beams = structure.elements.stresses(sample.motion.deformations)
        nonlinear[sample.index] = recovery.von_mises(shells[:, None], beams[:, None])[:, 0]

    integrate_nonlinear(
        structure,
        motion_of(structure, pose, np.zeros(3), np.zeros(3)),
        loads,
        damping,
        Corrector(structure, body.mass, step, damping),
        step,
        samples,
        record,
        tolerance=1e-8,
    )
    return SmallLoads(factor, nonlinear / factor, linear / factor)


def _courses(count: int, time: Array) -> Array:
    """Courses (nt, count) of all loads at full strength: steps, ramps and swings side by side."""
    phase = np.arange(count)[None, :]
    share = time[:, None] / time[-1]
    swing = np.sin(6.0 * share * (1 + phase % 3) + phase)
    courses: Array = STRENGTH * np.resize(SHARES, count) * (0.3 + share * swing)
    return courses


def _rigid_motion(body: FreeBody, shapes: Array, amplitudes: Array) -> RigidMotion:
    """Accelerations that the loads cause; rates are of second order and left out."""
    resultants = amplitudes @ (body.rigid_modes.T @ shapes).T
    accelerations = np.asarray(np.linalg.solve(body.rigid_mass, resultants.T).T, dtype=np.float64)
    return RigidMotion(
        origin=body.centre_of_gravity,
        acceleration=accelerations[:, :3],
        gravity=np.zeros((len(amplitudes), 3)),
        rate=np.zeros((len(amplitudes), 3)),
        rate_derivative=accelerations[:, 3:],
    )
