"""A small winged body with mass groups, and balanced landings of it, in any axes."""

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


@dataclass(frozen=True, slots=True)
class WingedBody:
    """A crossed pair of plates with stiffening beams, two tanks, pins and air loads."""

    structure: Structure
    groups: tuple[Inertia, ...]
    recovery: StressRecovery
    pins: Array  #: (n, 6 n_pins)
    air: Array  #: (n, 6) resultants about the structural origin are the unit wrenches

    @property
    def applied(self) -> Array:
        """Applied load shapes (n, 6 n_pins + 6), pins before air."""
        return np.hstack([self.pins, self.air])

    def body(self, factors: Array) -> FreeBody:
        """Free body at fill ``factors`` (2,) of the mass groups."""
        return free_body(self.structure, self.inertia(factors))

    def inertia(self, factors: Array) -> Inertia:
        """Inertia at fill ``factors`` (2,)."""
        parts = zip(factors, self.groups, strict=True)
        return combine([(1.0, self.structure.inertia), *parts])


def unit_wrench_loads(structure: Structure, inertia: Inertia) -> Array:
    """Spread loads (n, 6) as mass is, with unit resultants about the structural origin."""
    modes = structure.rigid_modes(np.zeros(3))
    spread = inertia.mass_matrix() @ modes
    loads: Array = spread @ np.linalg.inv(modes.T @ spread)
    return loads


#: Half the side of the square fuselage, its length and the span [m].
HALF, LENGTH, SPAN = 0.9, 12.0, 14.0


class _Mesh:
    """Nodes, quadrilaterals and beams of the body, collected face by face."""

    def __init__(self, across: int, along: int) -> None:
        self._rows: dict[tuple[float, float, float], int] = {}
        self.x = np.linspace(0.0, LENGTH, along + 1)
        self.wing_x = self.x[along // 2 : along // 2 + 3]
        self.quads: list[list[int]] = []
        self.beams: list[list[int]] = []
        self._fuselage()
        stations = np.linspace(-SPAN / 2, SPAN / 2, across + 1)
        for side in (-1, 1):
            outboard = sorted((v for v in stations if v * side > HALF + 1e-9), key=abs)
            self._wing([side * HALF, *outboard])
        walls = ((-HALF, -HALF), (HALF, -HALF), (HALF, HALF), (-HALF, HALF))
        for end in (0.0, LENGTH):
            self.quads.append([self.node(end, y, z) for y, z in walls])

    def node(self, x: float, y: float, z: float) -> int:
        """Row of the node there, new or known."""
        place = (round(float(x), 6), round(float(y), 6), round(float(z), 6))
        return self._rows.setdefault(place, len(self._rows))

    @property
    def points(self) -> Array:
        """Positions (n, 3) of the nodes collected so far [m]."""
        return np.array(list(self._rows))

    def _fuselage(self) -> None:
        corners = [(-HALF, -HALF), (HALF, -HALF), (HALF, HALF), (-HALF, HALF), (-HALF, -HALF)]
        for a, b in itertools.pairwise(self.x):
            for (p, q), (r, s) in itertools.pairwise(corners):
                at = [(a, p, q), (b, p, q), (b, r, s), (a, r, s)]
                rows = [self.node(*place) for place in at]
                self.quads.append(rows)
                self.beams.append(rows[:2])

    def _wing(self, line: list[float]) -> None:
        for a, b in itertools.pairwise(line):
            for f, g in itertools.pairwise(self.wing_x):
                at = [(f, a), (g, a), (g, b), (f, b)]
                self.quads.append([self.node(x, y, -HALF) for x, y in at])
            self.beams += [[self.node(f, a, -HALF), self.node(f, b, -HALF)] for f in self.wing_x]


def _nearest(points: Array, place: Array) -> int:
    return int(np.argmin(np.linalg.norm(points - place, axis=1)))


def winged_body(
    across: int = 12, along: int = 16, turn: Array | None = None, shift: Array | None = None
) -> WingedBody:
    """Box fuselage along x crossed by a wing strip along y, with tanks in the wings.

    ``turn`` (3, 3) and ``shift`` (3,) describe the same body in other axes.
    """
    turn = np.eye(3) if turn is None else turn
    shift = np.zeros(3) if shift is None else shift
    mesh = _Mesh(across, along)
    at_wing = mesh.wing_x[1]
    corners = [
        mesh.node(at_wing, -HALF, -HALF),
        mesh.node(at_wing, HALF, -HALF),
        mesh.node(mesh.x[1], -HALF, -HALF),
    ]
    ends = [mesh.node(0.0, HALF, HALF), mesh.node(LENGTH, -HALF, HALF)]
    straight = mesh.points
    model: FiniteElementModel = meshes.model(
        straight @ turn.T + shift,
        quads=np.array(mesh.quads),
        beams=meshes.beams_on(np.array(mesh.beams), orientation=turn @ [0.0, 0.3, 1.0]),
        section=meshes.rectangle_section(0.10, 0.30),
        thickness=0.004,
        shell_mass=6.0,
        masses=meshes.lumped(
            ends,
            [300.0, 450.0],
            offsets=np.array([[-0.2, 0.0, 0.1], [0.3, 0.2, 0.0]]) @ turn.T,
            inertias=[turn @ np.diag(d) @ turn.T for d in ([20.0, 50.0, 60.0], [90.0, 40.0, 70.0])],
        ),
    )
    structure = build_structure(model)
    groups = []
    for side, mass in ((-1, 260.0), (1, 240.0)):
        tip = np.array([at_wing, side * SPAN / 2, -HALF])
        rows = [_nearest(straight, tip), _nearest(straight, tip * [1.0, 0.6, 1.0])]
        offsets = [turn @ [0.1, 0.0, 0.1]] * 2
        masses = meshes.lumped(rows, [mass, 2 * mass], offsets=offsets)
        groups.append(point_mass_inertia(structure.transformation, model.coordinates, masses))
    pins = structure.nodal_loads(np.array(corners)).toarray()
    air = unit_wrench_loads(structure, structure.inertia)
    return WingedBody(structure, tuple(groups), build_stress_recovery(structure), pins, air)


def balanced_landing(
    winged: WingedBody, factors: Array, seed: int = 0, duration: float = 0.5, step: float = 1e-3
) -> LandingLoads:
    """Arbitrary smooth pin and air loads with the rigid motion that they cause (Newton, Euler)."""
    rng = np.random.default_rng(seed)
    time = np.arange(round(duration / step) + 1, dtype=np.float64) * step
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
