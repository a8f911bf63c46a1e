"""Free structures for tests: beams with closed forms, and a small winged body with mass groups."""

import itertools
from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.fe.inertia import Inertia, combine, point_mass_inertia
from solver.fe.model import FiniteElementModel
from solver.fe.stress import StressRecovery, build_stress_recovery
from solver.fe.structure import Structure, build_structure
from solver.inertia_relief.accumulate import PeakAccumulator
from solver.inertia_relief.basis import BasisSettings, build_basis
from solver.inertia_relief.build import project
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.free_body import FreeBody, free_body
from solver.inertia_relief.full_order import BodyLoads, integrate_full_order
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import LandingLoads
from solver.inertia_relief.motion import RigidMotion
from solver.inertia_relief.peaks import StressPeaks, find_peaks
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.response import landing_response
from verification.elements import meshes

GRAVITY = np.array([0.0, 0.0, -9.80665])


def beam_structure(length=2.0, count=40, width=0.05, height=0.04, **options) -> Structure:
    section = meshes.rectangle_section(width, height)
    return build_structure(meshes.straight_beam(length, count, section, **options))


def point_loads(structure: Structure, loads: dict[tuple[int, int], float]) -> Array:
    """Load vector from {(node row, component): value}."""
    total = np.zeros(6 * structure.model.node_count)
    for (node, component), value in loads.items():
        total[6 * node + component] = value
    return structure.transformation.T @ total


def bending_stress_to_moment(structure: Structure, stress: Array) -> Array:
    """Bending moments (m, 2 ends) in the x-z plane from beam stresses (9 m,), closed section."""
    section = structure.model.beam_properties[1]
    rows = stress.reshape(-1, 9)
    z = section.stress_points[:, 1]
    moments = []
    for end in range(2):
        points = rows[:, 4 * end : 4 * end + 4]
        slope = (points - points.mean(axis=1, keepdims=True)) @ z / (z @ z)
        moments.append(slope * section.inertia_2)
    return np.stack(moments, axis=1)


@dataclass(frozen=True)
class WingedBody:
    """A crossed pair of plates with stiffening beams, two tanks, pins and air loads."""

    structure: Structure
    groups: tuple[Inertia, ...]
    recovery: StressRecovery
    pins: Array  #: (n, 6 n_pins)
    air: Array  #: (n, 6) resultants about the structural origin are the unit wrenches

    @property
    def applied(self) -> Array:
        return np.hstack([self.pins, self.air])

    def body(self, factors: Array) -> FreeBody:
        return free_body(self.structure, self.inertia(factors))

    def inertia(self, factors: Array) -> Inertia:
        parts = zip(factors, self.groups, strict=True)
        return combine([(1.0, self.structure.inertia), *parts])


def unit_wrench_loads(structure: Structure, inertia: Inertia) -> Array:
    """Loads (n, 6) distributed as mass is, with unit resultants about the structural origin."""
    modes = structure.rigid_modes(np.zeros(3))
    spread = inertia.mass_matrix() @ modes
    return spread @ np.linalg.inv(modes.T @ spread)


def winged_body(
    across: int = 12, along: int = 16, turn: Array | None = None, shift: Array | None = None
) -> WingedBody:
    """Box fuselage along x crossed by a wing strip along y, with tanks in the wings.

    ``turn`` (3, 3) and ``shift`` (3,) describe the same body in other axes.
    """
    turn = np.eye(3) if turn is None else turn
    shift = np.zeros(3) if shift is None else shift
    length, span = 12.0, 14.0
    x = np.linspace(0.0, length, along + 1)
    y = np.linspace(-span / 2, span / 2, across + 1)
    nodes: dict[tuple[float, float, float], int] = {}

    def node(px: float, py: float, pz: float) -> int:
        return nodes.setdefault((round(px, 6), round(py, 6), round(pz, 6)), len(nodes))

    quads, beams = [], []
    half = 0.9
    for a, b in itertools.pairwise(x):  # fuselage: a box of four walls
        for (p, q), (r, s) in [
            ((-half, -half), (half, -half)),
            ((half, -half), (half, half)),
            ((half, half), (-half, half)),
            ((-half, half), (-half, -half)),
        ]:
            quads.append([node(a, p, q), node(b, p, q), node(b, r, s), node(a, r, s)])
            beams.append([node(a, p, q), node(b, p, q)])
    wing_x = [x[along // 2], x[along // 2 + 1], x[along // 2 + 2]]
    stations = [v for v in y if abs(v) > half + 1e-9]
    for side in (-1, 1):
        line = [side * half, *sorted((v for v in stations if v * side > 0), key=abs)]
        for a, b in itertools.pairwise(line):
            for f, g in itertools.pairwise(wing_x):
                quads.append(
                    [node(f, a, -half), node(g, a, -half), node(g, b, -half), node(f, b, -half)]
                )
            for f in wing_x:
                beams.append([node(f, a, -half), node(f, b, -half)])
    for ends in (0.0, length):  # closing walls
        quads.append(
            [
                node(ends, -half, -half),
                node(ends, half, -half),
                node(ends, half, half),
                node(ends, -half, half),
            ]
        )
    points = np.array(list(nodes)) @ turn.T + shift
    tips = [min(nodes, key=lambda n, s=s: (-s * n[1], abs(n[0] - wing_x[1]))) for s in (-1, 1)]
    model: FiniteElementModel = meshes.model(
        points,
        quads=np.array(quads),
        beams=meshes.beams_on(np.array(beams), orientation=turn @ [0.0, 0.3, 1.0]),
        section=meshes.rectangle_section(0.10, 0.30),
        thickness=0.004,
        shell_mass=6.0,
        masses=meshes.lumped(
            [node(0.0, half, half), node(length, -half, half)],
            [300.0, 450.0],
            offsets=np.array([[-0.2, 0.0, 0.1], [0.3, 0.2, 0.0]]) @ turn.T,
            inertias=[turn @ np.diag(d) @ turn.T for d in ([20.0, 50.0, 60.0], [90.0, 40.0, 70.0])],
        ),
    )
    structure = build_structure(model)
    groups = []
    for tip, mass in zip(tips, (260.0, 240.0), strict=True):
        row = nodes[tip]
        inboard = nodes[min(nodes, key=lambda n, t=tip: np.hypot(n[0] - t[0], n[1] - 0.6 * t[1]))]
        offsets = [turn @ [0.1, 0.0, 0.1]] * 2
        masses = meshes.lumped([row, inboard], [mass, 2 * mass], offsets=offsets)
        groups.append(point_mass_inertia(structure.transformation, model.coordinates, masses))
    corner = [
        node(wing_x[1], -half, -half),
        node(wing_x[1], half, -half),
        node(x[1], -half, -half),
    ]
    pins = structure.nodal_loads(np.array(corner)).toarray()
    air = unit_wrench_loads(structure, structure.inertia)
    return WingedBody(structure, tuple(groups), build_stress_recovery(structure), pins, air)


def balanced_landing(
    winged: WingedBody, factors: Array, seed: int = 0, duration: float = 0.5, step: float = 1e-3
) -> LandingLoads:
    """Arbitrary smooth pin and air loads with the rigid motion that they cause (Newton, Euler)."""
    rng = np.random.default_rng(seed)
    time = np.arange(round(duration / step) + 1) * step
    properties = winged.inertia(factors).rigid_body_properties()
    pins = winged.pins.shape[1]

    def pulses(columns: int) -> Array:
        start = rng.uniform(0.02, 0.2, columns)
        width = rng.uniform(0.03, 0.25, columns)
        phase = np.clip((time[:, None] - start) / width, 0.0, 1.0)
        return np.sin(np.pi * phase) ** 2 * rng.standard_normal(columns)

    weight = properties.mass * 9.80665
    pin_loads = pulses(pins) * np.tile([0.5 * weight] * 3 + [0.1 * weight] * 3, pins // 6)
    lift = np.zeros((len(time), 6))
    lift[:, 2] = weight
    lift[:, 3:] = np.cross(properties.centre_of_gravity, lift[:, :3])
    air = lift + pulses(6) * weight * np.array([0.1, 0.1, 0.2, 0.2, 0.2, 0.2])
    modes = winged.structure.rigid_modes(properties.centre_of_gravity)
    wrench = pin_loads @ (modes.T @ winged.pins).T + air @ (modes.T @ winged.air).T
    gravity = np.broadcast_to(GRAVITY, (len(time), 3))
    rate = np.zeros((len(time), 3))
    rate[0] = rng.uniform(-0.2, 0.2, 3)
    tensor = properties.inertia
    derivative = np.zeros_like(rate)
    for n in range(len(time)):
        spin = rate[n]
        derivative[n] = np.linalg.solve(tensor, wrench[n, 3:] - np.cross(spin, tensor @ spin))
        if n + 1 < len(time):
            rate[n + 1] = spin + step * derivative[n]
    acceleration = wrench[:, :3] / properties.mass + gravity
    motion = RigidMotion(properties.centre_of_gravity, acceleration, gravity, rate, derivative)
    return LandingLoads(time, pin_loads, air, motion)


def turned_landing(loads: LandingLoads, turn: Array, shift: Array) -> LandingLoads:
    """Describe the same landing in other axes, ``x' = turn x + shift``."""
    motion = loads.motion
    turned = [
        part @ turn.T
        for part in (motion.acceleration, motion.gravity, motion.rate, motion.rate_derivative)
    ]
    pins = loads.pin_loads.reshape(len(loads.time), -1, 3) @ turn.T
    force = loads.air_loads[:, :3] @ turn.T
    moment = loads.air_loads[:, 3:] @ turn.T + np.cross(shift, force)
    return LandingLoads(
        loads.time,
        pins.reshape(len(loads.time), -1),
        np.hstack([force, moment]),
        RigidMotion(turn @ motion.origin + shift, *turned),
    )


def full_order_peaks(
    winged: WingedBody,
    factors: Array,
    loads: LandingLoads,
    damping: RayleighDamping,
    substeps: int = 1,
) -> PeakAccumulator:
    """Peaks of the full-order integration."""
    peaks = PeakAccumulator(winged.recovery)
    body_loads = BodyLoads(loads.time, winged.applied, loads.applied_amplitudes(), loads.motion)
    integrate_full_order(winged.body(factors), body_loads, damping, peaks, substeps)
    return peaks


def reduced(winged: WingedBody, settings: BasisSettings, damping: RayleighDamping) -> ReducedModel:
    """Reduced model of a winged body."""
    base, groups = winged.structure.inertia, winged.groups
    basis = build_basis(winged.structure, base, groups, winged.applied, settings)
    return project(winged.structure, base, groups, winged.applied, winged.recovery, basis, damping)


def reduced_peaks(model: ReducedModel, factors: Array, loads: LandingLoads) -> StressPeaks:
    """Peaks of the reduced integration."""
    return find_peaks(model, landing_response(assemble(model, factors), loads))
