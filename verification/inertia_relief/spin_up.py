"""Kane's problem in the mean-axis frame: a beam spun up smoothly to a steady rate.

T. R. Kane, R. R. Ryan and A. K. Banerjee, Dynamics of a cantilever beam attached to a moving base,
J. Guidance 10, 1987; the beam and its ramp are those of J. C. Simo and L. Vu-Quoc, J. Appl. Mech.
53, 1986.  A free beam of twice the length, turned by a couple at its middle, is their root-driven
one on both sides, but belongs to nobody's base: its frame is the mean-axis frame of eq (15).

Three solutions: extended inertia relief with finite elements; the same linear equation by Ritz's
method on the exact modes of the beam at rest; and the geometrically exact `segment_chain`.
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from solver.arrays import Array
from solver.fe.model import BeamProperty
from solver.fe.structure import Structure, build_structure
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.full_order import BodyLoads
from solver.inertia_relief.motion import RigidMotion
from verification.elements import meshes
from verification.inertia_relief.free_beam import history, point_loads
from verification.inertia_relief.segment_chain import (
    SIMO_BEAM,
    UniformBeam,
    chain_motion,
    seen_from_mean_axes,
)

HALF = 10.0  #: length of the root-driven beam, half the free one's [m]
RAMP = 15.0  #: duration of the spin-up [s]
FINAL_RATE = 6.0  #: of the published case [rad/s]


@dataclass(frozen=True, slots=True)
class Ramp:
    """Rotation that reaches ``rate`` [rad/s] smoothly after `RAMP` seconds."""

    rate: float

    def acceleration(self, time: Array) -> Array:
        """Angular acceleration [rad/s2]."""
        inside = time < RAMP
        found: Array = np.where(
            inside, self.rate / RAMP * (1 - np.cos(2 * np.pi * time / RAMP)), 0.0
        )
        return found

    def velocity(self, time: Array) -> Array:
        """Angular rate [rad/s]."""
        ramp = self.rate / RAMP * (time - RAMP / (2 * np.pi) * np.sin(2 * np.pi * time / RAMP))
        found: Array = np.where(time < RAMP, ramp, self.rate)
        return found

    def angle(self, time: Array) -> Array:
        """Angle turned [rad]."""
        wave = RAMP / (2 * np.pi)
        ramp = self.rate / RAMP * (time**2 / 2 + wave**2 * (np.cos(time / wave) - 1))
        found: Array = np.where(time < RAMP, ramp, self.rate * (time - RAMP / 2))
        return found


@dataclass(frozen=True, slots=True)
class TipMotion:
    """Displacement of the tip in turning axes."""

    time: Array  #: (nt,) [s]
    extension: Array  #: (nt,) along the beam [m]
    lag: Array  #: (nt,) across it, in the sense of the rotation [m]


def couple_at_middle(ramp: Ramp, time: Array, beam: UniformBeam = SIMO_BEAM) -> Array:
    """Couple (nt,) that gives the rigid free beam the ramp's acceleration [N m]."""
    moment: Array = beam.density * (2 * HALF) ** 3 / 12 * ramp.acceleration(time)
    return moment


def beam_of_elements(count: int, beam: UniformBeam = SIMO_BEAM) -> Structure:
    """Free beam from -L to L of slender elements without shear flexibility."""
    area, young = 0.01, beam.axial / 0.01
    inertia = beam.bending / young
    points = np.array([[0.1, 0.1], [0.1, -0.1], [-0.1, -0.1], [-0.1, 0.1]])
    section = BeamProperty(1, 1, area, inertia, inertia, 2 * inertia, points)
    x = np.zeros((count + 1, 3))
    x[:, 0] = np.linspace(-HALF, HALF, count + 1)
    substance = meshes.material(young, 0.3, beam.density / area)
    return build_structure(meshes.beam_chain(x, section, substance=substance))


def by_inertia_relief(ramp: Ramp, time: Array, count: int = 40, substeps: int = 2) -> TipMotion:
    """Solve the free beam by extended inertia relief at full order."""
    structure = beam_of_elements(count)
    body = free_body(structure)
    shapes = point_loads(structure, {(count // 2, 5): 1.0})[:, None]
    zero = np.zeros((len(time), 3))
    rate, derivative = zero.copy(), zero.copy()
    rate[:, 2], derivative[:, 2] = ramp.velocity(time), ramp.acceleration(time)
    motion = RigidMotion(body.centre_of_gravity, zero, zero, rate, derivative)
    # the couple that gives this mesh, with its rotary inertia, exactly the ramp's acceleration
    moment = body.rigid_mass[5, 5] * derivative[:, 2:]
    found = history(body, BodyLoads(time, shapes, moment, motion), substeps=substeps)
    tip = structure.nodal_displacements(found)[-1]
    return TipMotion(time, tip[0], tip[1])


def linear_theory(
    ramp: Ramp, time: Array, clamped: bool = False, terms: int = 8, steps: int = 5
) -> TipMotion:
    """Solve the linear equation of a turning beam by Ritz's method with polynomials on 0 to L.

    ``u'' - 2 w v' - w' v - w^2 u = E A / rho A u_xx + w^2 x`` along and
    ``v'' + 2 w u' + w' u - w^2 v = -E I / rho A v_xxxx - w' x`` across, with the couple as a moment
    at x = 0; without geometric stiffness, as in eq (15).  Implicit midpoint rule in time.

    Parameters
    ----------
    clamped : bool
        Axes fixed to the driven root; otherwise mean axes of the free beam of twice the length.
    terms : int
        Polynomials along the beam and across it.
    steps : int
        Time steps between two samples.
    """
    beam = SIMO_BEAM
    at, weight = legendre.leggauss(2 * terms + 4)
    weight = weight / 2 * HALF
    along = _ritz_basis(at, terms, 1)
    across = _ritz_basis(at, terms, 2 if clamped else 1)
    lever = HALF * (at + 1) / 2
    if not clamped:  # mean axes: no moment of momentum about the middle
        share = (weight * lever) @ across[0] / (weight @ lever**2)
        for order, line in enumerate((lever, np.ones_like(lever), np.zeros_like(lever))):
            across[order] -= np.outer(line, share)
        root_slope, tip_line = share, HALF * share
        across = across[:, :, 1:]
        # x P_k (2 x / L - 1) has the slope P_k(-1) at the root and the value L at the tip
        slope = np.where(np.arange(terms) % 2 == 0, 1.0, -1.0) - root_slope
        tip = (HALF - tip_line)[1:]
        couple = slope[1:] / 2
    else:
        tip, couple = np.full(terms, HALF**2), np.zeros(terms)
    axial_tip = np.full(terms, HALF)
    n, m = terms, across.shape[2]

    def integral(a: Array, b: Array) -> Array:
        product: Array = a.T @ (weight[:, None] * b)
        return product

    zero = np.zeros
    mass = beam.density * np.block(
        [
            [integral(along[0], along[0]), zero((n, m))],
            [zero((m, n)), integral(across[0], across[0])],
        ]
    )
    stiffness = np.block(
        [
            [beam.axial * integral(along[1], along[1]), zero((n, m))],
            [zero((m, n)), beam.bending * integral(across[2], across[2])],
        ]
    )
    mixed = beam.density * integral(along[0], across[0])
    turn = np.block([[zero((n, n)), -mixed], [mixed.T, zero((m, m))]])  # of w', twice that of w
    radial = beam.density * np.concatenate([(weight * lever) @ along[0], zero(m)])
    tangential = -beam.density * np.concatenate([zero(n), (weight * lever) @ across[0]])
    moment = np.concatenate([zero(n), couple])
    inverse = np.linalg.inv(mass)

    interval = float(time[1] - time[0]) / steps
    size = n + m
    one, state = np.eye(2 * size), zero(2 * size)
    states = [state]
    for begin in time[:-1]:
        middles = begin + interval * (np.arange(steps) + 0.5)
        rates, derivatives = ramp.velocity(middles), ramp.acceleration(middles)
        couples = couple_at_middle(ramp, middles, beam)
        for rate, derivative, turning in zip(rates, derivatives, couples, strict=True):
            force = stiffness + derivative * turn - rate**2 * mass
            matrix = np.block(
                [[zero((size, size)), np.eye(size)], [-inverse @ force, -2 * rate * inverse @ turn]]
            )
            load = inverse @ (rate**2 * radial + derivative * tangential + turning * moment)
            half = interval / 2 * matrix
            right = state + half @ state
            right[size:] += interval * load
            state = np.linalg.solve(one - half, right)
        states.append(state)
    solved = np.array(states)
    return TipMotion(time, solved[:, :n] @ axial_tip, solved[:, n:size] @ tip)


def _ritz_basis(at: Array, terms: int, power: int) -> Array:
    """Values, slopes and curvatures (3, n, terms) of x^power P_k(2 x / L - 1) on 0 to L."""
    lever = np.array([HALF / 2, HALF / 2])  # x of the coordinate -1 to 1, as a Legendre series
    factor = np.array([1.0])
    for _ in range(power):
        factor = legendre.legmul(factor, lever)
    series = [legendre.legmul(factor, row) for row in np.eye(terms)]
    return np.stack(
        [
            np.stack([legendre.legval(at, legendre.legder(term, order)) for term in series], axis=1)
            * (2 / HALF) ** order
            for order in range(3)
        ]
    )


def by_segments(ramp: Ramp, time: Array, segments: int = 20) -> TipMotion:
    """Free beam of twice the length, geometrically exact, seen from its mean axes.

    Extrapolated from ``segments`` and twice as many, with the second order of the chain.
    """
    found = []
    for count in (segments, 2 * segments):
        positions = chain_motion(
            SIMO_BEAM, (-HALF, HALF), count, time, couple_at_middle(ramp, time), False
        )
        seen, _ = seen_from_mean_axes(positions, np.linspace(-HALF, HALF, count + 1))
        found.append(seen[:, :, -1])
    tip = found[1] + (found[1] - found[0]) / 3
    return TipMotion(time, tip[:, 0], tip[:, 1])


def root_driven_segments(ramp: Ramp, time: Array, segments: int = 40) -> TipMotion:
    """Root-driven beam, geometrically exact, seen from axes fixed to its root."""
    angle = ramp.angle(time)
    positions = chain_motion(SIMO_BEAM, (0.0, HALF), segments, time, angle, True)
    tip = positions[:, :, -1]
    cos, sin = np.cos(angle), np.sin(angle)
    return TipMotion(
        time, cos * tip[:, 0] + sin * tip[:, 1] - HALF, cos * tip[:, 1] - sin * tip[:, 0]
    )


def steady_extension(rate: float, beam: UniformBeam = SIMO_BEAM) -> float:
    """Extension rho A w^2 L^3 / (3 E A) of the spinning root-driven beam [m]."""
    return beam.density * rate**2 * HALF**3 / (3 * beam.axial)


def cantilever_frequency(beam: UniformBeam = SIMO_BEAM) -> float:
    """Lowest frequency of the beam clamped at its root, cos(b) cosh(b) = -1 [rad/s]."""
    return float(1.8751040687**2 * np.sqrt(beam.bending / beam.density) / HALF**2)


def driven_frequency(beam: UniformBeam = SIMO_BEAM) -> float:
    """Lowest antisymmetric frequency of the free beam, tan(b / 2) = tanh(b / 2) [rad/s]."""
    return float(7.8532046241**2 * np.sqrt(beam.bending / beam.density) / (2 * HALF) ** 2)
