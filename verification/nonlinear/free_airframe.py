"""A whole airframe in free flight: turned about no principal axis, undamped and without loads."""

from dataclasses import dataclass
from pathlib import Path
from time import process_time

import numpy as np

from solver.aircraft.airframe import Airframe, load_airframe
from solver.aircraft.bizjet import build_bizjet
from solver.arrays import Array
from solver.inertia_relief.build import airframe_damping
from solver.nonlinear.account import kinetic_energy, momenta
from solver.nonlinear.checkpoint import Sample
from solver.nonlinear.configuration import initial_pose
from solver.nonlinear.correction import Corrector
from solver.nonlinear.integrate import integrate_nonlinear
from solver.nonlinear.loads import no_loads
from solver.nonlinear.mean_frame import mean_frame
from solver.nonlinear.midpoint import UNDAMPED, MidpointStep, motion_of
from solver.nonlinear.rotations import exponential_quaternions
from solver.nonlinear.structure import loaded_model, nonlinear_structure
from solver.progress import Progress, silent

#: Far beyond what an aircraft does, about no principal axis [rad/s].
RATE = np.array([2.0, 1.2, -1.0])


@dataclass(frozen=True, slots=True)
class FreeFlight:
    """Course of a flight; the airframe starts undeformed and rings."""

    time: Array  #: (nt,) [s]
    kinetic: Array  #: (nt,) [J]
    strain: Array  #: (nt,) [J]
    momenta: Array  #: (nt, 6) momentum, angular momentum about the initial centre of gravity
    turned: Array  #: (nt,) of the airframe, all ways added up [rad]

    @property
    def momentum_error(self) -> float:
        """Largest change of angular momentum, relative to its size."""
        change = np.linalg.norm(self.momenta[:, 3:] - self.momenta[0, 3:], axis=1)
        return float(change.max() / np.linalg.norm(self.momenta[0, 3:]))

    @property
    def energy_error(self) -> float:
        """Largest change of energy, relative to the energy."""
        energy = self.kinetic + self.strain
        return float(np.abs(energy - energy[0]).max() / energy[0])


def coarse_airframe(folder: Path) -> Airframe:
    """Give the example aircraft on a coarse mesh."""
    build_bizjet(folder, refinement=0.25)
    return load_airframe(folder)


def free_flight(
    airframe: Airframe,
    factors: Array,
    step: float,
    end: float,
    every: int = 1,
    progress: Progress = silent,
) -> FreeFlight:
    """Let an airframe turn freely for ``end`` seconds; a sample after ``every`` steps."""
    structure = nonlinear_structure(loaded_model(airframe, factors))
    inertia = airframe.inertia(factors)
    centre = inertia.rigid_body_properties().centre_of_gravity
    pose = initial_pose(structure.model.coordinates - centre)
    start = motion_of(structure, pose, np.zeros(3), RATE)
    rows: list[tuple[float, float, float]] = []
    kept: list[Array] = []
    turns: list[Array] = []

    def record(sample: Sample) -> None:
        motion = sample.motion
        strain = structure.elements.strain_energy(motion.deformations)
        rows.append((sample.time, kinetic_energy(structure, motion), strain))
        kept.append(momenta(structure, motion))
        turns.append(mean_frame(structure, motion, start.places)[1])

    integrate_nonlinear(
        structure,
        start,
        no_loads(structure.model.node_count),
        UNDAMPED,
        Corrector(structure, inertia.mass_matrix(), step, UNDAMPED),
        step,
        round(end / step),
        record,
        every=every,
        tolerance=1e-7,
        progress=progress,
    )
    time, kinetic, strain = np.array(rows).T
    turn = np.array(turns)
    between = np.einsum("tji,tjk->tik", turn[:-1], turn[1:])
    cosine = 0.5 * (np.trace(between, axis1=1, axis2=2) - 1.0)
    angles = np.arccos(np.clip(cosine, -1.0, 1.0))
    return FreeFlight(
        time, kinetic, strain, np.array(kept), np.concatenate([[0.0], np.cumsum(angles)])
    )


def rigid_turn_forces(airframe: Airframe, factors: Array) -> tuple[float, float]:
    """Largest force after a rigid turn of an airframe, and after a displacement of 1e-6 m [N].

    The second gives the first a measure: one node alone is displaced.
    """
    structure = nonlinear_structure(loaded_model(airframe, factors))
    pose = initial_pose(structure.model.coordinates)
    turn = exponential_quaternions(np.array([[1.1, -1.9, 0.8]]))[0]
    turned = structure.constraints.placed(pose.rigidly_moved(turn, np.array([3.0, 1.0, -2.0])))
    forces = np.abs(structure.elements.static_loads(turned)[:, :3]).max()
    pose.positions[structure.free_nodes[0]] += 1e-6
    displaced = structure.constraints.placed(pose)
    return float(forces), float(np.abs(structure.elements.static_loads(displaced)[:, :3]).max())


@dataclass(frozen=True, slots=True)
class StepCost:
    """Processor time of the parts of a step [s]."""

    freedoms: int
    evaluation: float  #: of the equations of motion: forces, inertia, constraints, damping
    correction: float  #: one solution with the factorised matrix
    factorisation: float  #: tangent and its factors


def step_cost(airframe: Airframe, factors: Array, step: float = 5e-4, repeats: int = 5) -> StepCost:
    """Measure the parts of a step, the least of some repeats."""
    structure = nonlinear_structure(loaded_model(airframe, factors))
    damping = airframe_damping(airframe)
    mass = airframe.inertia(factors).mass_matrix()
    corrector = Corrector(structure, mass, step, damping)
    pose = initial_pose(structure.model.coordinates)
    start = motion_of(structure, pose, np.zeros(3), np.array([0.05, 0.1, 0.02]))
    loads = np.zeros((structure.model.node_count, 6))
    equations = MidpointStep(structure, start, step, damping, loads, np.array([0.0, 0.0, -9.8]))
    increments = np.zeros((len(structure.free_nodes), 6))
    times = np.full((repeats, 3), np.inf)
    for row in times:
        marks = [process_time()]
        corrector.renew(start.at)
        marks.append(process_time())
        trial = equations.trial(increments)
        marks.append(process_time())
        corrector.correction(trial)
        marks.append(process_time())
        row[:] = np.diff(marks)
    factorisation, evaluation, correction = times.min(axis=0)
    return StepCost(
        airframe.structure.n_free, float(evaluation), float(correction), float(factorisation)
    )
