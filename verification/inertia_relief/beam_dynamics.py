"""Free beams in motion beside their modal series: a step load, at rest and spinning on its axis."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigvals, expm

from solver.arrays import Array
from solver.fe.inertia import Inertia
from solver.fe.structure import Structure
from solver.inertia_relief.basis import elastic_modes
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.full_order import BodyLoads
from solver.inertia_relief.motion import RigidMotion
from verification.inertia_relief.free_beam import (
    SYMMETRIC,
    beam_constants,
    beam_structure,
    history,
    point_loads,
    symmetric_shapes,
)

LENGTH, COUNT, FORCE = 2.0, 24, 10.0


def central_step(structure: Structure, time: Array, spin: float = 0.0) -> BodyLoads:
    """Transverse force at the middle, from zero to 10 N within one sample, then constant."""
    body = free_body(structure)
    force = point_loads(structure, {(COUNT // 2, 2): 1.0})
    amplitude = np.full((len(time), 1), FORCE)
    amplitude[0] = 0.0
    acceleration = np.zeros((len(time), 3))
    acceleration[:, 2] = amplitude[:, 0] / body.total_mass
    zero = np.zeros((len(time), 3))
    rate = zero.copy()
    rate[:, 0] = spin
    motion = RigidMotion(body.centre_of_gravity, acceleration, zero, rate, zero)
    return BodyLoads(time, force[:, None], amplitude, motion)


def _modes(structure: Structure, x: Array) -> tuple[Array, Array, Array]:
    """Frequencies [rad/s] (5,), shapes (5, nx) and forces of a unit load at the middle (5,)."""
    stiffness, density = beam_constants(structure)
    frequency = SYMMETRIC**2 * np.sqrt(stiffness / (density * LENGTH**4))
    # modal mass is m L times the mean square of the shape, which is one for end value two
    force = FORCE * symmetric_shapes(np.array([0.0]))[:, 0] / (density * LENGTH)
    return frequency, symmetric_shapes(x), force


def step_response(substeps: int = 8) -> tuple[Array, Array, Array]:
    """Free beam under a step load: time (nt,), found and exact deflections (nodes, nt) [m]."""
    structure = beam_structure(LENGTH, COUNT, 0.02, 0.01)
    time = 5e-4 * np.arange(201, dtype=np.float64)
    motion = history(free_body(structure), central_step(structure, time), substeps=substeps)
    frequency, shapes, force = _modes(structure, np.linspace(-0.5, 0.5, COUNT + 1))
    ramp, w = time[1], frequency[:, None]
    response = 1 - (np.sin(w * time) - np.sin(w * (time - ramp))) / (w * ramp)
    response[:, 0] = 0.0
    exact: Array = shapes.T @ (force[:, None] / w**2 * response)
    found = np.stack([structure.nodal_displacements(u)[:, 2] for u in motion.T], axis=1)
    return time, found, exact


def spinning_step_response(
    spin: float = 40.0, substeps: int = 20
) -> tuple[Array, NDArray[np.complex128], NDArray[np.complex128]]:
    """Tip deflection y + i z [m] in axes that spin with the beam: time, found and exact (nt,).

    In space this is a beam under a turning force; in turning axes every mode obeys
    z'' + 2 i W z' + (w^2 - W^2) z = f, solved by its matrix exponential.
    """
    structure = beam_structure(LENGTH, COUNT, 0.01, 0.01)
    time = 1e-3 * np.arange(161, dtype=np.float64)
    motion = history(free_body(structure), central_step(structure, time, spin), substeps=substeps)
    nodal = np.stack([structure.nodal_displacements(u)[0, 1:3] for u in motion.T], axis=1)
    frequency, ends, forces = _modes(structure, np.array([-0.5]))
    exact = np.zeros(len(time), dtype=np.complex128)
    for w, end, amplitude in zip(frequency, ends[:, 0], forces, strict=True):
        generator = np.zeros((4, 4), dtype=complex)
        generator[:2, :2] = [[0, 1], [spin**2 - w**2, -2j * spin]]
        generator[1, 2] = generator[2, 3] = 1.0
        advance = expm(generator * time[1])[:2]
        force = 1j * amplitude
        state = np.zeros(2, dtype=complex)
        for n in range(1, len(time)):
            slope = force / time[1] if n == 1 else 0.0
            state = advance @ np.array([*state, 0.0 if n == 1 else force, slope])
            exact[n] += end * state[0]
    found: NDArray[np.complex128] = nodal[0] + 1j * nodal[1]
    return time, found, exact


def spin_frequencies(
    depth: float, share: float = 0.4, rotary_rates: bool = True
) -> tuple[Array, Array]:
    """Bending frequencies [rad/s] of a beam spinning about its axis, and |w_n +- spin|.

    The targets take w_n of the same mesh at rest, so that the W terms alone are judged.

    Parameters
    ----------
    depth : float
        Side of the square section [m]; the beam is 2 m long.
    share : float
        Spin as a share of the lowest frequency.
    rotary_rates : bool
        False leaves the rotary inertias out of the W terms, as if W acted on translations only.
    """
    structure = beam_structure(LENGTH, COUNT, depth, depth)
    body = free_body(structure)
    frequency, shapes = elastic_modes(body, 20)
    spin = share * float(frequency[0])
    turning = structure.inertia if rotary_rates else _without_rotary(structure.inertia)
    # turned by a right angle about its axis a pair of equal modes remains a pair: the modes at
    # rest span the motion exactly
    stiffness = np.diag(frequency**2) + spin**2 * shapes.T @ turning.centrifugal(0, 0) @ shapes
    gyroscopic = spin * shapes.T @ turning.gyroscopic(0) @ shapes
    size = len(frequency)
    zero, one = np.zeros((size, size)), np.eye(size)
    values = eigvals(np.block([[zero, one], [-stiffness, -gyroscopic]]))
    found = np.sort(np.abs(values.imag))
    pairs = frequency[np.flatnonzero(np.isclose(frequency[1:], frequency[:-1], rtol=1e-6))]
    target = np.sort(np.concatenate([pairs[:3] - spin, pairs[:3] + spin]))
    nearest = np.abs(found[:, None] - target).argmin(axis=0)
    return found[nearest], target


def _without_rotary(inertia: Inertia) -> Inertia:
    return replace(inertia, rotary=np.zeros_like(inertia.rotary))
