"""The flying flexible beams of Simo and Vu-Quoc, plane and in space.

J. C. Simo, L. Vu-Quoc, On the dynamics of flexible beams under large overall motions, the plane
case, part II, J. Applied Mechanics 53, 1986, 855-863; On the dynamics in space of rods undergoing
large motions, a geometrically exact approach, Comp. Meth. Appl. Mech. Eng. 66, 1988, 125-161.  A
free beam of length 10 leans from (6, 0, 0) to (0, 8, 0); EA = GA = 1e4, EI = GJ = 500, mass 1 and
rotary inertia 10 for each unit of length.  Force and moments on the lower end set it flying.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.fe.model import BeamProperty, FiniteElementModel
from solver.fe.structure import build_structure
from solver.nonlinear.account import kinetic_energy, momenta
from solver.nonlinear.checkpoint import Sample
from solver.nonlinear.configuration import initial_pose
from solver.nonlinear.correction import Corrector
from solver.nonlinear.integrate import integrate_nonlinear
from solver.nonlinear.loads import DirectedLoads, dead_loads
from solver.nonlinear.midpoint import UNDAMPED, motion_of
from solver.nonlinear.structure import nonlinear_structure
from verification.elements import meshes

LENGTH = 10.0
LOWER, UPPER = np.array([6.0, 0.0, 0.0]), np.array([0.0, 8.0, 0.0])
AXIAL = SHEAR = 1e4
BENDING = 500.0
MASS, ROTARY = 1.0, 10.0  #: for each unit of length


@dataclass(frozen=True, slots=True)
class Flight:
    """Where both ends of a beam are, and its momentum and energy."""

    time: Array  #: (nt,)
    lower: Array  #: (nt, 3)
    upper: Array  #: (nt, 3)
    momenta: Array  #: (nt, 6) momentum, angular momentum about the origin
    energy: Array  #: (nt,) kinetic and strain


@dataclass(frozen=True, slots=True)
class Course:
    """Loads on the lower end, linear between times."""

    times: Array  #: (nt,)
    freedoms: tuple[int, ...]  #: of the lower end, 0 to 5
    amplitudes: Array  #: (nt, freedoms)


#: Force along x and moment about z of the plane flight: 8 and 80 until 2.5, then nothing.
PLANE = Course(
    np.array([0.0, 2.5, np.nextafter(2.5, 3.0), 100.0]),
    (0, 5),
    np.array([[8.0, 80.0], [8.0, 80.0], [0.0, 0.0], [0.0, 0.0]]),
)
#: Force along x and moments about y and z of the flight in space: up until 2.5, down until 5.
SPACE = Course(
    np.array([0.0, 2.5, 5.0, 100.0]),
    (0, 4, 5),
    np.array([[0.0, 0.0, 0.0], [20.0, -100.0, -200.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]),
)


def flying_beam(count: int, step: float, end: float, course: Course, every: int = 1) -> Flight:
    """Fly a beam of ``count`` elements; samples after every ``every`` steps."""
    model = beam_model(count)
    structure = nonlinear_structure(model)
    samples: list[Sample] = []
    integrate_nonlinear(
        structure,
        motion_of(structure, initial_pose(model.coordinates), np.zeros(3), np.zeros(3)),
        _loads(model, course),
        UNDAMPED,
        Corrector(structure, build_structure(model).inertia.mass_matrix(), step, UNDAMPED),
        step,
        round(end / step),
        samples.append,
        every=every,
        tolerance=1e-9,
    )
    return Flight(
        time=np.array([sample.time for sample in samples]),
        lower=np.array([sample.motion.at.positions[0] for sample in samples]),
        upper=np.array([sample.motion.at.positions[-1] for sample in samples]),
        momenta=np.array([momenta(structure, sample.motion) for sample in samples]),
        energy=np.array(
            [
                kinetic_energy(structure, sample.motion)
                + structure.elements.strain_energy(sample.motion.deformations)
                for sample in samples
            ]
        ),
    )


def beam_model(count: int) -> FiniteElementModel:
    """Give the beam with its rotary inertia at the nodes, the only place a beam has it."""
    young = 1e6
    section = BeamProperty(
        1,
        1,
        area=AXIAL / young,
        inertia_1=BENDING / young,
        inertia_2=BENDING / young,
        torsion_constant=BENDING / (young / 2),
        stress_points=np.zeros((4, 2)),
        shear_factor_1=2 * SHEAR / AXIAL,  # the shear modulus is half of Young's
        shear_factor_2=2 * SHEAR / AXIAL,
        nonstructural_mass=MASS,
    )
    shares = np.full(count + 1, LENGTH / count)
    shares[[0, -1]] /= 2
    # Of a section about its own axes: polar about the beam, equatorial across it.
    axis = (UPPER - LOWER) / LENGTH
    tensor = ROTARY * (np.eye(3) + np.outer(axis, axis))
    return meshes.beam_chain(
        LOWER + np.linspace(0, 1, count + 1)[:, None] * (UPPER - LOWER),
        section,
        orientation=(0.0, 0.0, 1.0),
        substance=meshes.material(young, 0.0, 0.0),
        masses=meshes.lumped(
            range(count + 1), np.zeros(count + 1), inertias=shares[:, None, None] * tensor
        ),
    )


def _loads(model: FiniteElementModel, course: Course) -> DirectedLoads:
    shapes = np.zeros((6 * model.node_count, len(course.freedoms)))
    shapes[list(course.freedoms), np.arange(len(course.freedoms))] = 1.0
    return dead_loads(course.times, shapes, course.amplitudes, np.zeros(3))
