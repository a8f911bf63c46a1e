"""A free beam spun up by a couple at its middle: Simo and Vu-Quoc's spin-up beam, twice.

J. C. Simo, L. Vu-Quoc, J. Applied Mechanics 53, 1986, 855-863 drive a beam of length 10 (EA 2.8e7,
EI 1.4e4, GA 1e7, mass 1.2 and rotary inertia 6e-4 per length) at its root from rest to 6 rad/s
within 15 s.  Two of them root to root are one free beam; the couple at its middle follows the same
course, and the symmetry holds the middle in place.  In steady rotation each half is longer by
m w^2 L^3 / (3 EA).
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.fe.model import BeamProperty
from solver.fe.structure import build_structure
from solver.nonlinear.checkpoint import Sample
from solver.nonlinear.configuration import initial_pose
from solver.nonlinear.correction import Corrector
from solver.nonlinear.integrate import integrate_nonlinear
from solver.nonlinear.loads import dead_loads
from solver.nonlinear.midpoint import UNDAMPED, motion_of
from solver.nonlinear.structure import nonlinear_structure
from verification.elements import meshes

LENGTH, AXIAL, BENDING, SHEAR, MASS = 10.0, 2.8e7, 1.4e4, 1e7, 1.2
RATE, RISE = 6.0, 15.0  #: [rad/s], [s]
#: Closed form of the steady extension of one half.
EXTENSION = MASS * RATE**2 * LENGTH**3 / (3 * AXIAL)


@dataclass(frozen=True, slots=True)
class SpinUp:
    """Course of a half's tip."""

    time: Array  #: (nt,) [s]
    extension: Array  #: (nt,) of the distance from the middle
    lag: Array  #: (nt,) of the tip behind the middle's section, across the beam
    rate: Array  #: (nt,) mean over the last step [rad/s]

    def steady_extension(self) -> float:
        """Mean extension after the spin-up."""
        return float(self.extension[self.time > RISE + 1.0].mean())


def spin_up(half: int = 5, step: float = 0.02, end: float = 20.0) -> SpinUp:
    """Spin a beam with ``half`` elements on each side."""
    young = 1e9
    section = BeamProperty(
        1,
        1,
        area=AXIAL / young,
        inertia_1=BENDING / young,
        inertia_2=BENDING / young,
        torsion_constant=2 * BENDING / young,
        stress_points=np.zeros((4, 2)),
        shear_factor_1=2 * SHEAR / AXIAL,  # the shear modulus is half of Young's
        shear_factor_2=2 * SHEAR / AXIAL,
    )
    # the rotary inertia of the section, density times second moment, is the 6e-4 of the source
    substance = meshes.material(young, 0.0, MASS * young / AXIAL)
    points = np.zeros((2 * half + 1, 3))
    points[:, 0] = np.linspace(-LENGTH, LENGTH, 2 * half + 1)
    model = meshes.beam_chain(points, section, orientation=(0.0, 0.0, 1.0), substance=substance)
    structure = nonlinear_structure(model)
    time = np.arange(0.0, end + step / 2, step / 10)
    shapes = np.zeros((6 * model.node_count, 1))
    shapes[6 * half + 5, 0] = 1.0
    rise = np.where(time < RISE, 1.0 - np.cos(2 * np.pi * time / RISE), 0.0)
    couple = RATE / RISE * rise * 2 * MASS * LENGTH**3 / 3
    samples: list[Sample] = []
    integrate_nonlinear(
        structure,
        motion_of(structure, initial_pose(points), np.zeros(3), np.zeros(3)),
        dead_loads(time, shapes, couple[:, None], np.zeros(3)),
        UNDAMPED,
        Corrector(structure, build_structure(model).inertia.mass_matrix(), step, UNDAMPED),
        step,
        round(end / step),
        samples.append,
        tolerance=1e-9,
    )
    tips = np.array([sample.motion.at.positions[-1] for sample in samples])
    middles = np.array([sample.motion.at.positions[half] for sample in samples])
    turns = np.array([sample.motion.at.rotations[half] for sample in samples])
    arms = tips - middles
    angle = np.unwrap(np.arctan2(arms[:, 1], arms[:, 0]))
    return SpinUp(
        time=np.array([sample.time for sample in samples]),
        extension=np.linalg.norm(arms, axis=1) - LENGTH,
        lag=np.einsum("ti,ti->t", arms, turns[:, :, 1]),
        rate=np.gradient(angle, step),
    )
