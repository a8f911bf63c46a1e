"""Natural frequencies of plates and of a membrane.

NAFEMS, Selected benchmarks for natural frequency analysis, 1987, and The standard NAFEMS
benchmarks, 1990: FV12, FV16, FV32.
"""

import numpy as np

from solver.arrays import Array
from solver.fe.structure import Structure, build_structure
from verification.elements.figures import Figure
from verification.elements.meshes import grid_nodes, material, plate, surface
from verification.elements.supported import frequencies, nothing_fixed


def free_plate(density: int = 32, triangular: bool = False) -> list[Figure]:
    """NAFEMS FV12: free square plate 10 x 10 x 0.05; in-plane freedoms at rest as published."""
    structure = _square_plate(density, triangular)
    fixed = nothing_fixed(structure)
    fixed[:, [0, 1, 5]] = True
    found = frequencies(structure, fixed, 10, shift=0.2)[3:9]
    targets = (1.622, 2.360, 2.922, 4.233, 4.233, 7.416)
    return [Figure(f"FV12 mode {k + 4}", float(found[k]), t) for k, t in enumerate(targets)]


def cantilevered_plate(density: int = 32, triangular: bool = False) -> list[Figure]:
    """NAFEMS FV16: the same plate, one edge clamped."""
    structure = _square_plate(density, triangular)
    nodes = grid_nodes(density, density)
    fixed = nothing_fixed(structure)
    fixed[nodes[:, 0]] = True
    fixed[:, [0, 1, 5]] = True
    found = frequencies(structure, fixed, 6)
    targets = (0.421, 1.029, 2.582, 3.306, 3.753, 6.555)
    return [Figure(f"FV16 mode {k + 1}", float(found[k]), t) for k, t in enumerate(targets)]


def tapered_membrane(across: int = 8, along: int = 16, triangular: bool = False) -> list[Figure]:
    """NAFEMS FV32: membrane 10 long, 5 deep at its clamped root, 1 at its tip, t 0.05."""

    def shape(s: Array, t: Array) -> Array:
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
