"""Slender beams of shells: straight, curved and twisted.

R. H. MacNeal and R. L. Harder, A proposed standard set of problems to test finite element accuracy,
Finite Elements in Analysis and Design 1, 1985, 3-20.
"""

import numpy as np

from solver.arrays import Array
from solver.fe.structure import build_structure
from verification.elements.figures import Figure, edge_loads
from verification.elements.meshes import grid_nodes, grid_quads, material, shell_mesh, surface
from verification.elements.supported import nothing_fixed, static


def straight_cantilever(
    shape: str = "regular", triangular: bool = False, refine: int = 1, slenderness: int = 5
) -> list[Figure]:
    """MacNeal-Harder slender beam: 6 x 1 elements; extension, in-plane, out-of-plane, twist.

    Refined parallelograms divide those of the published mesh; refined trapezoids keep their taper.
    ``slenderness`` is the length of an element over its width, 5 on the published mesh.
    """
    across, along = refine, 30 * refine // slenderness
    nodes = grid_nodes(along, across)
    base = np.linspace(0, 6, along + 1)
    x = np.stack([base] * (across + 1))
    if shape == "trapezoidal":
        sign = np.zeros(along + 1)
        sign[1:-1] = np.where(np.arange(1, along) % 2 == 1, 1.0, -1.0)
        x = x + 0.1 / refine * np.linspace(-1, 1, across + 1)[:, None] * sign
    if shape == "parallelogram":
        inner = np.minimum(1.0, np.minimum(base, 6 - base))  # clamped and loaded ends stay square
        x = x + 0.1 * np.linspace(-1, 1, across + 1)[:, None] * inner
    y = np.broadcast_to(np.linspace(0, 0.2, across + 1)[:, None], x.shape)
    coordinates = np.stack([x, y, 0 * x], -1).reshape(-1, 3)
    mesh = shell_mesh(
        coordinates,
        grid_quads(nodes),
        triangular,
        crossed=False,
        thickness=0.1,
        substance=material(1e7, 0.3),
    )
    structure = build_structure(mesh)
    fixed = nothing_fixed(structure)
    fixed[nodes[:, 0]] = True
    tip = nodes[:, -1]
    name = f"straight cantilever, {shape}{', triangles' if triangular else ''}"
    # extension, two shears, and a unit twist as a couple of the tip's outer nodes
    loads = [edge_loads(structure, tip, component, 1.0) for component in range(3)]
    couple = np.zeros(fixed.shape)
    couple[tip[0], 2], couple[tip[-1], 2] = -5.0, 5.0
    u = static(structure, fixed, np.stack([*loads, couple], axis=-1))
    found = [float(u[tip, component, component].mean()) for component in range(3)]
    found.append(float(u[tip[-1], 2, 3] - u[tip[0], 2, 3]) / 0.2)
    labels = ("extension", "in-plane", "out-of-plane", "twist")
    return [
        Figure(f"{name}, {label}", value, target)
        for label, value, target in zip(
            labels, found, (3.0e-5, 0.1081, 0.4321, 0.03208), strict=True
        )
    ]


def curved_cantilever(across: int = 1, along: int = 6, triangular: bool = False) -> list[Figure]:
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
    # The tip lies on the y axis; its section runs along y, so in-plane shear acts along y.
    loads = [edge_loads(structure, nodes[-1], component, 1.0) for component in (1, 2)]
    u = static(structure, fixed, np.stack(loads, axis=-1))
    name = f"curved cantilever {across}x{along}"
    return [
        Figure(f"{name}, in-plane", float(u[nodes[-1], 1, 0].mean()), 0.08734),
        Figure(f"{name}, out-of-plane", float(u[nodes[-1], 2, 1].mean()), 0.5022),
    ]


def twisted_beam(
    across: int = 2, along: int = 12, triangular: bool = False, thin: bool = False
) -> list[Figure]:
    """Beam 12 x 1.1 twisted by 90 degrees: unit tip shear in and out of plane.

    Thickness 0.32 as MacNeal and Harder, or ``thin`` 0.0032 as Belytschko, Wong and Stolarski,
    Assumed strain stabilization procedure for the 9-node Lagrange shell element, Int. J. Num.
    Meth. Eng. 28, 1989, 385-414 (targets there for a load of 1e-6).
    """

    def shape(s: Array, t: Array) -> Array:
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
    # At the tip the section stands along z: a force along z is in plane.
    loads = [edge_loads(structure, nodes[-1], component, 1.0) for component in (2, 1)]
    u = static(structure, fixed, np.stack(loads, axis=-1))
    name = f"{'thin ' if thin else ''}twisted beam {across}x{along}"
    return [
        Figure(f"{name}, in-plane", float(u[nodes[-1], 2, 0].mean()), targets[0]),
        Figure(f"{name}, out-of-plane", float(u[nodes[-1], 1, 1].mean()), targets[1]),
    ]
