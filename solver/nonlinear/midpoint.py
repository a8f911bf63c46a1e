"""One step of nonlinear dynamics: the midpoint rule in conserving form.

Unknown are the displacements and Cayley increments of the free nodes over a step.  Momentum
balances over the step in the middle configuration:

    N' [ m (v1 - v0) / h + alpha m (v - v_rigid) - m g ] + [R1 J w1 - R0 J w0] / h + B' f = P

Mass points move by ``x1 - x0 = h (v0 + v1) / 2`` along their exact places, rotary bodies turn by
``p = h R (w0 + w1) / 2`` (Simo and Wong 1991).  The elements' forces are formed from the
deformations d at both ends of the step, ``f = K [ (d0 + d1) / 2 + beta (d1 - d0) / h ]``, as in the
energy-momentum method (J. C. Simo, N. Tarnow, The discrete energy-momentum method, ZAMP 43, 1992,
757-792), and applied with the frames in the middle.  Then

* linear and angular momentum change by exactly the impulse of loads and gravity: internal forces
  and damping have no resultant in the middle configuration, where places are means of both ends;
* energy is kept to second order without any trend, the rule being symmetric in time; and there is
  no numerical damping at all;
* small motion follows Newmark's average acceleration (beta 1/4, gamma 1/2), step for step what
  `solver.inertia_relief.full_order` does, so that both have the same error of time integration.

Damping is that of `solver.inertia_relief.damping`: beta on the rate of the corotated deformation,
alpha on velocities less the rigid motion that has the same momentum and angular momentum.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.inertia_relief.damping import RayleighDamping
from solver.nonlinear.configuration import Configuration, Pose
from solver.nonlinear.elastic_motion import elastic_momenta
from solver.nonlinear.elements import Deformations
from solver.nonlinear.rotations import cayley_quaternions, half_turns
from solver.nonlinear.structure import NonlinearStructure

#: Nothing is lost but by Newton's tolerance.
UNDAMPED = RayleighDamping(ratio=0.0)


@dataclass(frozen=True, slots=True)
class Motion:
    """State of a structure at one instant, inertial axes."""

    pose: Pose
    velocities: Array  #: (p, 3) of the mass points [m/s]
    rates: Array  #: (k, 3) of the rotary bodies, body axes [rad/s]
    at: Configuration  #: of the pose
    places: Array  #: (p, 3) of the mass points [m]
    deformations: Deformations


def motion_of(structure: NonlinearStructure, pose: Pose, velocity: Array, rate: Array) -> Motion:
    """State of a structure that moves as a rigid body.

    Parameters
    ----------
    velocity, rate : (3,) arrays
        Velocity of the origin [m/s] and angular rate [rad/s], inertial axes.
    """
    at = structure.constraints.placed(pose)
    places = structure.points.places(at)
    turns = at.rotations[structure.rotary.nodes]
    return Motion(
        pose=pose,
        velocities=velocity + np.cross(rate, places),
        rates=np.einsum("kji,j->ki", turns, rate),
        at=at,
        places=places,
        deformations=structure.elements.deformations(at),
    )


@dataclass(frozen=True, slots=True)
class StepTrial:
    """A step for given increments, right or not."""

    motion: Motion  #: at the end of the step
    middle: Configuration
    residual: Array  #: (nf, 6) loads that would make it right, on the free nodes [N, N m]
    strain_energy: float  #: about, in the middle of the step [J]
    elastic_work: float  #: of the elements' forces over the step, damping included [J]
    damping_work: float  #: lost to the mass-proportional damping [J]


class MidpointStep:
    """The equations of one step from a known state.

    Parameters
    ----------
    loads : (n, 6) array
        Forces and moments on all nodes in the middle of the step [N, N m].
    gravity : (3,) array
        [m/s2]
    """

    def __init__(
        self,
        structure: NonlinearStructure,
        start: Motion,
        step: float,
        damping: RayleighDamping,
        loads: Array,
        gravity: Array,
    ) -> None:
        self._structure, self._start, self._step = structure, start, step
        self._alpha = damping.mass_coefficient
        self._beta = damping.stiffness_coefficient
        self._loads, self._gravity = loads, gravity
        mass = structure.points.mass
        self._weights = np.asarray(mass.sum(axis=1)).ravel()
        self._moments = mass @ start.places
        self._momenta = mass @ start.velocities
        self._spin = structure.rotary.momentum(start.at.rotations, start.rates)

    def trial(self, increments: Array) -> StepTrial:
        """Evaluate the step for ``increments`` (nf, 6) of the free nodes [m, -]."""
        structure, start, step = self._structure, self._start, self._step
        moved = np.zeros((structure.model.node_count, 6))
        moved[structure.free_nodes] = increments
        turns = cayley_quaternions(moved[:, 3:])
        end = start.pose.moved(moved[:, :3], turns)
        half = start.pose.moved(0.5 * moved[:, :3], half_turns(turns))
        at = structure.constraints.placed(end)
        middle = structure.constraints.placed(half)

        elements = structure.elements
        deformations = elements.deformations(at)
        share = self._beta / step
        forces = elements.forces(
            deformations.combined(0.5 + share, start.deformations, 0.5 - share)
        )
        loads = -self._loads
        mean = deformations.combined(0.5, start.deformations, 0.5)
        elements.add_loads(middle, mean, forces, loads)
        elastic_work = forces.work(deformations.combined(1.0, start.deformations, -1.0))

        places = structure.points.places(at)
        moments = structure.points.mass @ places
        mean_places = 0.5 * (start.places + places)
        mean_momenta = (moments - self._moments) / step
        mean_rates = structure.rotary.mean_rates(start.at.rotations, at.rotations, step)
        rates = 2.0 * mean_rates - start.rates
        inertial = (2.0 / step) * (mean_momenta - self._momenta)
        inertial -= self._weights[:, None] * self._gravity
        spin = (structure.rotary.momentum(at.rotations, rates) - self._spin) / step
        damping_work = 0.0
        if self._alpha:
            braked, braked_spin = elastic_momenta(
                structure.rotary,
                middle.rotations,
                mean_places,
                self._weights,
                0.5 * (self._moments + moments),
                mean_momenta,
                mean_rates,
            )
            inertial += self._alpha * braked
            spin += self._alpha * braked_spin
            turned = np.einsum("kij,kj->ki", middle.rotations[structure.rotary.nodes], mean_rates)
            damping_work = self._alpha * float(
                np.vdot(braked, places - start.places) + step * np.vdot(braked_spin, turned)
            )
        structure.points.add_loads(middle, mean_places, inertial, loads)
        loads[structure.rotary.nodes, 3:] += spin
        velocities = (2.0 / step) * (places - start.places) - start.velocities
        return StepTrial(
            motion=Motion(end, velocities, rates, at, places, deformations),
            middle=middle,
            residual=-structure.on_free_nodes(middle, loads),
            strain_energy=0.5 * abs(forces.work(mean)),
            elastic_work=elastic_work,
            damping_work=damping_work,
        )
