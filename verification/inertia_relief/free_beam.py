"""Free uniform beams: the structure, its loads, its constants and its modes in closed form."""

from typing import Any

import numpy as np

from solver.arrays import Array
from solver.fe.structure import Structure, build_structure
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.free_body import FreeBody
from solver.inertia_relief.full_order import BodyLoads, integrate_full_order
from verification.elements import meshes

UNDAMPED = RayleighDamping(0.0)
#: beta L of the symmetric modes of a free-free uniform beam, tan(b / 2) + tanh(b / 2) = 0.
SYMMETRIC = np.array([4.7300407449, 10.9956078380, 17.2787596574, 23.5619449020, 29.8451302091])


def beam_structure(
    length: float = 2.0,
    count: int = 40,
    width: float = 0.05,
    height: float = 0.04,
    **options: Any,
) -> Structure:
    """Beam of a solid rectangle along x, ``width`` along y and ``height`` along z [m]."""
    section = meshes.rectangle_section(width, height)
    return build_structure(meshes.straight_beam(length, count, section, **options))


def point_loads(structure: Structure, loads: dict[tuple[int, int], float]) -> Array:
    """Load vector (n_free,) from {(node row, component): value}."""
    total = np.zeros(6 * structure.model.node_count)
    for (node, component), value in loads.items():
        total[6 * node + component] = value
    free: Array = structure.transformation.T @ total
    return free


def bending_moments(structure: Structure, stress: Array) -> Array:
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


def beam_constants(structure: Structure) -> tuple[float, float]:
    """Bending stiffness EI in the x-z plane [N m2] and mass for each length [kg/m]."""
    section, material = structure.model.beam_properties[1], structure.model.materials[1]
    return material.young_modulus * section.inertia_2, material.density * section.area


def symmetric_shapes(x: Array) -> Array:
    """Symmetric free-free modes (5, nx) at ``x`` in -1/2 to 1/2; value 2 at the ends."""
    half = SYMMETRIC[:, None] / 2
    shapes: Array = np.cos(2 * half * x) / np.cos(half) + np.cosh(2 * half * x) / np.cosh(half)
    return shapes


def history(
    body: FreeBody, loads: BodyLoads, damping: RayleighDamping = UNDAMPED, substeps: int = 1
) -> Array:
    """Displacements (n_free, nt) of the full-order integration."""
    samples: list[Array] = []
    integrate_full_order(
        body, loads, damping, lambda _, u: samples.append(u.copy()), substeps, block=50
    )
    return np.hstack(samples)
