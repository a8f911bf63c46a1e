"""Conventional inertia relief of free beams, plates and spinning bars beside closed forms."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from solver.arrays import Array, IntArray
from solver.fe.stress import StressRecovery, build_stress_recovery
from solver.fe.structure import Structure, build_structure
from solver.inertia_relief.free_body import FreeBody, free_body
from solver.inertia_relief.motion import RigidMotion
from solver.inertia_relief.static import inertia_relief, steady_state
from verification.elements import meshes
from verification.inertia_relief.free_beam import beam_structure, bending_moments, point_loads

LENGTH, COUNT, FORCE = 2.0, 48, 1000.0


@dataclass(frozen=True, slots=True)
class FreeBeamCase:
    """A loaded free beam and its largest bending moment."""

    name: str
    loads: dict[tuple[int, int], float]  #: {(node row, component): value}
    moment: float  #: closed form [N m]
    station: float | None  #: where, from the first node [m]; None: not compared


FREE_BEAM_CASES = (
    # inertia along the beam is linear: M(x) = F x (1 - x / L)^2 from the loaded end
    FreeBeamCase("end force, 4/27 F L", {(0, 2): FORCE}, 4 / 27 * FORCE * LENGTH, LENGTH / 3),
    FreeBeamCase(
        "central force, F L / 8", {(COUNT // 2, 2): FORCE}, FORCE * LENGTH / 8, LENGTH / 2
    ),
    # M(x) = F x (1 - x / L) (1 - 2 x / L), largest at x = L / 2 (1 - 1 / sqrt 3)
    FreeBeamCase(
        "opposite end forces, F L / (6 √3)",
        {(0, 2): FORCE, (COUNT, 2): -FORCE},
        FORCE * LENGTH / (6 * np.sqrt(3)),
        None,
    ),
)


def largest_moment(loads: dict[tuple[int, int], float]) -> tuple[float, float]:
    """Largest bending moment [N m] and its station [m] along a free uniform beam."""
    structure = beam_structure(LENGTH, COUNT)
    relief = inertia_relief(free_body(structure))
    displacement = relief.displacement(point_loads(structure, loads))
    recovery = build_stress_recovery(structure)
    ends = np.abs(bending_moments(structure, recovery.beam_operator @ displacement))
    # elements miss their own inertia load: the mean of both neighbours is a node's moment
    moment = (ends[:-1, 1] + ends[1:, 0]) / 2
    where = int(np.argmax(moment))
    return float(moment[where]), (where + 1) * LENGTH / COUNT


@dataclass(frozen=True, slots=True)
class SupportChoice:
    """Largest differences among several supports, relative to the largest value."""

    stress: float
    displacement: float


def support_choice(
    body: FreeBody, recovery: StressRecovery, loads: Array, supports: Sequence[IntArray | None]
) -> SupportChoice:
    """Solve the same free body on several statically determinate supports."""
    results = [inertia_relief(body, support).displacement(loads) for support in supports]
    stresses = [
        np.concatenate([recovery.shell_operator @ result, recovery.beam_operator @ result])
        for result in results
    ]

    def spread(values: list[Array]) -> float:
        scale = np.abs(values[0]).max()
        return max(float(np.abs(value - values[0]).max() / scale) for value in values[1:])

    return SupportChoice(spread(stresses), spread(results))


def plate_supports() -> SupportChoice:
    """Free plate under forces and a moment on four supports: own choice, corners, three points."""
    structure = build_structure(meshes.plate(1.0, 1.4, 6, 8, thickness=0.02))
    loads = point_loads(structure, {(0, 2): 100.0, (30, 0): -300.0, (61, 4): 7.0})
    last = 6 * (structure.model.node_count - 1)
    corner = np.arange(6)
    three_points = np.array([0, 1, 2, 6 * 6 + 1, 6 * 6 + 2, last + 2])
    supports = [None, corner, last + np.arange(6), three_points]
    return support_choice(free_body(structure), build_stress_recovery(structure), loads, supports)


BAR_LENGTH = 10.0


def bar_structure(count: int = 60) -> Structure:
    """Free bar of aluminium, 10 m."""
    return beam_structure(length=BAR_LENGTH, count=count)


def spinning_bar(rate: float) -> float:
    """Half the elongation of a free bar turning about a transverse axis through its middle [m]."""
    structure = bar_structure()
    body = free_body(structure)
    zero = np.zeros((1, 3))
    motion = RigidMotion(body.centre_of_gravity, zero, zero, np.array([[0.0, 0.0, rate]]), zero)
    shapes = structure.inertia.rigid_load_shapes(motion.origin)
    rhs = shapes @ motion.inertia_amplitudes()[0]
    displacement, _ = steady_state(inertia_relief(body), rhs, motion.rate[0], zero[0])
    nodal = structure.nodal_displacements(displacement)
    return float(nodal[-1, 0] - nodal[0, 0]) / 2


def bar_extension(rate: float) -> tuple[float, float]:
    """Half the elongation [m]: without softening, mu w^2 L^3 / (24 E A), and with it.

    The second is tan(k L / 2) / k - L / 2 with k = w sqrt(rho / E), since the centrifugal force
    grows with the displacement.
    """
    substance = meshes.material()
    k = rate * np.sqrt(substance.density / substance.young_modulus)
    return (
        float(k**2 * BAR_LENGTH**3 / 24),
        float(np.tan(k * BAR_LENGTH / 2) / k - BAR_LENGTH / 2),
    )
