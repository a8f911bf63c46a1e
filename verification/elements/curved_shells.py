"""Curved shells: roof, pinched cylinder, hemisphere and hook.

R. H. MacNeal and R. L. Harder, A proposed standard set of problems to test finite element accuracy,
Finite Elements in Analysis and Design 1, 1985, 3-20 (roof, cylinder, hemisphere).
N. F. Knight, The Raasch challenge for shell elements, AIAA Journal 35, 1997, 375-381.
"""

import numpy as np

from solver.arrays import Array, BoolArray, IntArray
from solver.fe.structure import build_structure
from verification.elements.figures import Figure, edge_loads
from verification.elements.meshes import grid_nodes, grid_quads, material, shell_mesh, surface
from verification.elements.supported import nothing_fixed, shares, static


def scordelis_lo(density: int = 8, triangular: bool = False) -> Figure:
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
    quads = grid_quads(nodes)
    loads[:, 2] = -90.0 * shares(quads, mesh.coordinates)
    u = static(structure, fixed, loads)
    return Figure(f"Scordelis-Lo roof {density}x{density}", -float(u[nodes[0, -1], 2]), 0.3024)


def pinched_cylinder(density: int = 32, triangular: bool = False) -> Figure:
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


def hemisphere(density: int = 16, triangular: bool = False) -> Figure:
    """Hemisphere R 10 with an 18-degree hole, alternating unit radial loads on a quarter."""

    def shape(s: Array, t: Array) -> Array:
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


def raasch_hook(across: int = 20, per_arc: int = 36, triangular: bool = False) -> Figure:
    """Raasch's hook of two arcs (R 14, 60 degrees; R 46, 150 degrees), width 20, t 2, shear 1."""
    profile = _hook_profile(per_arc)
    along = len(profile) - 1
    width = np.linspace(0, 20, across + 1)
    coordinates = np.zeros((along + 1, across + 1, 3))
    coordinates[..., :2] = profile[:, None]
    coordinates[..., 2] = width
    nodes = grid_nodes(across, along)
    mesh = shell_mesh(
        coordinates.reshape(-1, 3),
        grid_quads(nodes),
        triangular,
        thickness=2.0,
        substance=material(3300.0, 0.35),
    )
    structure = build_structure(mesh)
    fixed = nothing_fixed(structure)
    fixed[nodes[0]] = True
    u = static(structure, fixed, edge_loads(structure, nodes[-1], 2, 1.0))
    return Figure(f"Raasch hook {across}x{along}", float(u[nodes[-1], 2].mean()), 4.935)


def raasch_strip() -> float:
    """Deflection of the hook by Saint-Venant's torsion and bending of a strip, warping free.

    Castigliano's theorem on the hook's line; an upper bound, as the clamped end's restraint of
    warping is left out: integral of T^2 / (G J) + M^2 / (E I) + 1 / (K G A).
    """
    line = _hook_profile(2000)
    width, thickness, young, shear = 20.0, 2.0, 3300.0, 3300.0 / 2.7
    step = np.diff(line, axis=0)
    length = np.linalg.norm(step, axis=1)
    tangent = step / length[:, None]
    arm = line[-1] - (line[1:] + line[:-1]) / 2
    torque = arm[:, 1] * tangent[:, 0] - arm[:, 0] * tangent[:, 1]
    moment = -(arm * tangent).sum(axis=1)
    constant = width * thickness**3 / 3 * (1 - 0.63 * thickness / width)
    twisting = length @ torque**2 / (shear * constant)
    bending = length @ moment**2 / (young * thickness * width**3 / 12)
    return float(twisting + bending + length.sum() / (5 / 6 * shear * width * thickness))


def _hook_profile(per_arc: int) -> Array:
    """Points (n, 2) along the hook, ``per_arc`` pieces on its second arc."""
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
    return np.concatenate([start, rest])


def _mirror(fixed: BoolArray, nodes: IntArray, axis: int) -> None:
    """Hold what is odd about a plane of symmetry normal to ``axis``."""
    fixed[nodes, axis] = True
    for other in range(3):
        if other != axis:
            fixed[nodes, 3 + other] = True
