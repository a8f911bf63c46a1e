"""Published element benchmarks as functions: each takes a mesh density and gives a ratio to target.

Targets, with author:
MacNeal and Harder, A proposed standard set of problems to test finite element accuracy, Finite
Elements in Analysis and Design 1, 1985, 3-20 (straight, curved and twisted beams, roof, cylinder,
hemisphere).  Knight, The Raasch challenge for shell elements, AIAA Journal 35, 1997, 375-381.
NAFEMS, The standard NAFEMS benchmarks, 1990, and Selected benchmarks for natural frequency
analysis, 1987 (FV12, FV16, FV32).
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.fe.structure import Structure, build_structure
from tests.solver.fe.meshes import grid_nodes, material, model, plate, split, surface
from tests.solver.fe.supported import frequencies, nothing_fixed, shares, static


@dataclass(frozen=True)
class Figure:
    """A computed value beside its published one."""

    case: str
    computed: float
    target: float

    @property
    def ratio(self) -> float:
        return self.computed / self.target


def edge_loads(structure: Structure, edge: Array, component: int, total: float) -> Array:
    """Line load on an edge of equally spaced nodes, half shares at its ends."""
    loads = np.zeros((structure.model.node_count, 6))
    weight = np.ones(len(edge))
    weight[[0, -1]] = 0.5
    loads[edge, component] = total * weight / weight.sum()
    return loads


def straight_cantilever(shape: str = "regular", triangular: bool = False, refine: int = 1):
    """MacNeal-Harder slender beam: 6 x 1 elements; extension, in-plane, out-of-plane, twist."""
    across, along = refine, 6 * refine
    nodes = grid_nodes(along, across)
    base = np.linspace(0, 6, along + 1)
    x = np.stack([base] * (across + 1))
    if shape == "trapezoidal":
        sign = np.zeros(along + 1)
        sign[1:-1] = np.where(np.arange(1, along) % 2 == 1, 1.0, -1.0)
        x = x + 0.1 / refine * np.linspace(-1, 1, across + 1)[:, None] * sign
    if shape == "parallelogram":
        inner = np.ones(along + 1)
        inner[[0, -1]] = 0
        x = x + 0.1 * np.linspace(-1, 1, across + 1)[:, None] * inner
    y = np.broadcast_to(np.linspace(0, 0.2, across + 1)[:, None], x.shape)
    coordinates = np.stack([x, y, 0 * x], -1).reshape(-1, 3)
    quads = np.stack([nodes[:-1, :-1], nodes[:-1, 1:], nodes[1:, 1:], nodes[1:, :-1]], -1).reshape(
        -1, 4
    )
    options = {"thickness": 0.1, "substance": material(1e7, 0.3)}
    mesh = (
        model(coordinates, triangles=split(quads, crossed=False), **options)
        if triangular
        else model(coordinates, quads=quads, **options)
    )
    structure = build_structure(mesh)
    fixed = nothing_fixed(structure)
    fixed[nodes[:, 0]] = True
    tip = nodes[:, -1]
    name = f"straight cantilever, {shape}{', triangles' if triangular else ''}"
    figures = []
    for label, component, target in (
        ("extension", 0, 3.0e-5),
        ("in-plane", 1, 0.1081),
        ("out-of-plane", 2, 0.4321),
    ):
        u = static(structure, fixed, edge_loads(structure, tip, component, 1.0))
        figures.append(Figure(f"{name}, {label}", float(u[tip, component].mean()), target))
    # Unit twist as a couple of the tip's outer nodes.
    loads = np.zeros(fixed.shape)
    loads[tip[0], 2], loads[tip[-1], 2] = -5.0, 5.0
    u = static(structure, fixed, loads)
    twist = float(u[tip[-1], 2] - u[tip[0], 2]) / 0.2
    figures.append(Figure(f"{name}, twist", twist, 0.03208))
    return figures


def curved_cantilever(across: int = 1, along: int = 6, triangular: bool = False):
    """Quarter circle r 4.12 to 4.32: unit tip shear in plane and out of plane."""
    mesh = surface(
        lambda s, t: np.stack(
            [
                (4.12 + 0.2 * s) * np.cos(np.pi / 2 * t),
                (4.12 + 0.2 * s) * np.sin(np.pi / 2 * t),
                0 * s,
            ],
            -1,
        ),
        across,
        along,
        triangular,
        thickness=0.1,
        substance=material(1e7, 0.25),
    )
    structure = build_structure(mesh)
    nodes = grid_nodes(across, along)
    fixed = nothing_fixed(structure)
    fixed[nodes[0]] = True
    figures = []
    # The tip lies on the y axis; its section runs along y, so in-plane shear acts along y.
    for label, component, target in (("in-plane", 1, 0.08734), ("out-of-plane", 2, 0.5022)):
        u = static(structure, fixed, edge_loads(structure, nodes[-1], component, 1.0))
        figures.append(
            Figure(
                f"curved cantilever {across}x{along}, {label}",
                float(u[nodes[-1], component].mean()),
                target,
            )
        )
    return figures


def twisted_beam(across: int = 2, along: int = 12, triangular: bool = False, thin: bool = False):
    """Beam 12 x 1.1 twisted by 90 degrees: unit tip shear in and out of plane.

    Thickness 0.32 as MacNeal and Harder, or ``thin`` 0.0032 as Belytschko, Wong and Stolarski,
    Assumed strain stabilization procedure for the 9-node Lagrange shell element, Int. J. Num.
    Meth. Eng. 28, 1989, 385-414 (targets there for a load of 1e-6).
    """

    def shape(s, t):
        angle = np.pi / 2 * t
        y = 1.1 * (s - 0.5)
        return np.stack([12 * t, y * np.cos(angle), y * np.sin(angle)], -1)

    mesh = surface(
        shape,
        across,
        along,
        triangular,
        thickness=0.0032 if thin else 0.32,
        substance=material(29e6, 0.22),
    )
    structure = build_structure(mesh)
    nodes = grid_nodes(across, along)
    fixed = nothing_fixed(structure)
    fixed[nodes[0]] = True
    targets = (5256.0, 1294.0) if thin else (5.424e-3, 1.754e-3)
    figures = []
    # At the tip the section stands along z: a force along z is in plane.
    for label, component, target in zip(("in-plane", "out-of-plane"), (2, 1), targets, strict=True):
        u = static(structure, fixed, edge_loads(structure, nodes[-1], component, 1.0))
        figures.append(
            Figure(
                f"{'thin ' if thin else ''}twisted beam {across}x{along}, {label}",
                float(u[nodes[-1], component].mean()),
                target,
            )
        )
    return figures


def scordelis_lo(density: int = 8, triangular: bool = False):
    """Roof R 25, L 50, 40 degrees each side, on end diaphragms: sag of the free edge's middle."""
    half_angle = np.radians(40)
    mesh = surface(
        lambda s, t: np.stack(
            [25 * np.sin(half_angle * s), 25 * t, 25 * np.cos(half_angle * s)], -1
        ),
        density,
        density,
        triangular,
        thickness=0.25,
        substance=material(4.32e8, 0.0),
    )
    structure = build_structure(mesh)
    nodes = grid_nodes(density, density)
    fixed = nothing_fixed(structure)
    fixed[nodes[-1], 0] = fixed[nodes[-1], 2] = True  # diaphragm
    _mirror(fixed, nodes[0], 1)  # middle of the length
    _mirror(fixed, nodes[:, 0], 0)  # crown
    loads = np.zeros(fixed.shape)
    quads = np.stack([nodes[:-1, :-1], nodes[:-1, 1:], nodes[1:, 1:], nodes[1:, :-1]], -1).reshape(
        -1, 4
    )
    loads[:, 2] = -90.0 * shares(quads, mesh.coordinates)
    u = static(structure, fixed, loads)
    return Figure(f"Scordelis-Lo roof {density}x{density}", -float(u[nodes[0, -1], 2]), 0.3024)


def pinched_cylinder(density: int = 32, triangular: bool = False):
    """Cylinder R 300, L 600, t 3 on end diaphragms, two opposite unit loads; an eighth of it."""
    mesh = surface(
        lambda s, t: np.stack(
            [300 * np.sin(np.pi / 2 * s), 300 * t, 300 * np.cos(np.pi / 2 * s)], -1
        ),
        density,
        density,
        triangular,
        thickness=3.0,
        substance=material(3e6, 0.3),
    )
    structure = build_structure(mesh)
    nodes = grid_nodes(density, density)
    fixed = nothing_fixed(structure)
    fixed[nodes[-1], 0] = fixed[nodes[-1], 2] = True  # diaphragm
    _mirror(fixed, nodes[0], 1)
    _mirror(fixed, nodes[:, 0], 0)
    _mirror(fixed, nodes[:, -1], 2)
    loads = np.zeros(fixed.shape)
    loads[nodes[0, 0], 2] = -0.25
    u = static(structure, fixed, loads)
    return Figure(f"pinched cylinder {density}x{density}", -float(u[nodes[0, 0], 2]), 1.8248e-5)


def hemisphere(density: int = 16, triangular: bool = False):
    """Hemisphere R 10 with an 18-degree hole, alternating unit radial loads on a quarter."""

    def shape(s, t):
        longitude, latitude = np.pi / 2 * s, np.radians(72) * t
        return 10 * np.stack(
            [
                np.cos(latitude) * np.cos(longitude),
                np.cos(latitude) * np.sin(longitude),
                np.sin(latitude),
            ],
            -1,
        )

    mesh = surface(
        shape, density, density, triangular, thickness=0.04, substance=material(6.825e7, 0.3)
    )
    structure = build_structure(mesh)
    nodes = grid_nodes(density, density)
    fixed = nothing_fixed(structure)
    _mirror(fixed, nodes[:, 0], 1)
    _mirror(fixed, nodes[:, -1], 0)
    fixed[nodes[-1, 0], 2] = True  # the remaining rigid translation
    loads = np.zeros(fixed.shape)
    # F = 2 on the whole is 1 on this quarter at each load point.
    loads[nodes[0, 0], 0], loads[nodes[0, -1], 1] = 1.0, -1.0
    u = static(structure, fixed, loads)
    return Figure(f"hemisphere with hole {density}x{density}", float(u[nodes[0, 0], 0]), 0.0940)


def raasch_hook(across: int = 20, per_arc: int = 36, triangular: bool = False):
    """Hook of two arcs (R 14, 60 degrees; R 46, 150 degrees), width 20, t 2, tip shear 1."""
    first = np.radians(60) * np.linspace(0, 1, max(2, round(per_arc * 0.4)) + 1)
    second = np.radians(150) * np.linspace(0, 1, per_arc + 1)[1:]
    # First arc about (14, 0), from the clamped end at the origin upwards, turning clockwise.
    start = np.stack([14 - 14 * np.cos(first), 14 * np.sin(first)], -1)
    joint = start[-1]
    # The second arc turns the other way, about the point on the same radius beyond the joint.
    outward = np.array([-np.cos(np.radians(60)), np.sin(np.radians(60))])
    centre = joint + 46 * outward
    opening = np.arctan2(*(joint - centre)[::-1])
    rest = centre + 46 * np.stack([np.cos(opening + second), np.sin(opening + second)], -1)
    profile = np.concatenate([start, rest])
    along = len(profile) - 1
    width = np.linspace(0, 20, across + 1)
    coordinates = np.zeros((along + 1, across + 1, 3))
    coordinates[..., :2] = profile[:, None]
    coordinates[..., 2] = width
    nodes = grid_nodes(across, along)
    quads = np.stack([nodes[:-1, :-1], nodes[:-1, 1:], nodes[1:, 1:], nodes[1:, :-1]], -1).reshape(
        -1, 4
    )
    options = {"thickness": 2.0, "substance": material(3300.0, 0.35)}
    mesh = (
        model(coordinates.reshape(-1, 3), triangles=split(quads), **options)
        if triangular
        else model(coordinates.reshape(-1, 3), quads=quads, **options)
    )
    structure = build_structure(mesh)
    fixed = nothing_fixed(structure)
    fixed[nodes[0]] = True
    u = static(structure, fixed, edge_loads(structure, nodes[-1], 2, 1.0))
    return Figure(f"Raasch hook {across}x{along}", float(u[nodes[-1], 2].mean()), 4.935)


def free_plate(density: int = 32, triangular: bool = False):
    """NAFEMS FV12: free square plate 10 x 10 x 0.05; in-plane freedoms at rest as published."""
    structure = _square_plate(density, triangular)
    fixed = nothing_fixed(structure)
    fixed[:, [0, 1, 5]] = True
    found = frequencies(structure, fixed, 10, shift=0.2)[3:9]
    targets = (1.622, 2.360, 2.922, 4.233, 4.233, 7.416)
    return [Figure(f"FV12 mode {k + 4}", float(found[k]), t) for k, t in enumerate(targets)]


def cantilevered_plate(density: int = 32, triangular: bool = False):
    """NAFEMS FV16: the same plate, one edge clamped."""
    structure = _square_plate(density, triangular)
    nodes = grid_nodes(density, density)
    fixed = nothing_fixed(structure)
    fixed[nodes[:, 0]] = True
    fixed[:, [0, 1, 5]] = True
    found = frequencies(structure, fixed, 6)
    targets = (0.421, 1.029, 2.582, 3.306, 3.753, 6.555)
    return [Figure(f"FV16 mode {k + 1}", float(found[k]), t) for k, t in enumerate(targets)]


def tapered_membrane(across: int = 8, along: int = 16, triangular: bool = False):
    """NAFEMS FV32: membrane 10 long, 5 deep at its clamped root, 1 at its tip, t 0.05."""

    def shape(s, t):
        return np.stack([10 * t, (s - 0.5) * (5 - 4 * t), 0 * s], -1)

    mesh = surface(
        shape, across, along, triangular, thickness=0.05, substance=material(200e9, 0.3, 8000.0)
    )
    structure = build_structure(mesh)
    nodes = grid_nodes(across, along)
    fixed = nothing_fixed(structure)
    fixed[:, 2:5] = True
    fixed[nodes[0], :2] = True
    found = frequencies(structure, fixed, 6)
    targets = (44.62, 130.0, 162.7, 246.1, 379.9, 391.4)
    return [Figure(f"FV32 mode {k + 1}", float(found[k]), t) for k, t in enumerate(targets)]


def _square_plate(density: int, triangular: bool) -> Structure:
    return build_structure(
        plate(
            10.0,
            10.0,
            density,
            density,
            triangular,
            thickness=0.05,
            substance=material(200e9, 0.3, 8000.0),
        )
    )


def _mirror(fixed: Array, nodes: Array, axis: int) -> None:
    """Hold what is odd about a plane of symmetry normal to ``axis``."""
    fixed[nodes, axis] = True
    for other in range(3):
        if other != axis:
            fixed[nodes, 3 + other] = True
