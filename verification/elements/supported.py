"""Supported solutions of structures without constraints, to compare with published cases."""

import numpy as np
from scipy.sparse.linalg import eigsh, splu

from solver.arrays import Array, BoolArray, IntArray
from solver.fe.structure import Structure


def nothing_fixed(structure: Structure) -> BoolArray:
    """No freedom (n, 6) held."""
    return np.zeros((structure.model.node_count, 6), dtype=bool)


def static(structure: Structure, fixed: BoolArray, loads: Array) -> Array:
    """Displacements (n, 6) under nodal ``loads`` (n, 6) with the ``fixed`` (n, 6) at rest.

    Several loads (n, 6, k) give as many displacements, with one factorisation.
    """
    moving = np.flatnonzero(~fixed.ravel())
    stiffness = structure.stiffness[moving][:, moving].tocsc()
    columns = loads.reshape(fixed.size, -1)
    displacement = np.zeros_like(columns)
    displacement[moving] = splu(stiffness).solve(columns[moving])
    return displacement.reshape(loads.shape)


def prescribed(structure: Structure, known: BoolArray, values: Array) -> Array:
    """Displacements (n, 6) without loads where the ``known`` freedoms take ``values`` (n, 6)."""
    moving = np.flatnonzero(~known.ravel())
    held = np.flatnonzero(known.ravel())
    displacement = np.where(known, values, 0.0).ravel()
    rows = structure.stiffness[moving]
    displacement[moving] = splu(rows[:, moving].tocsc()).solve(-rows[:, held] @ displacement[held])
    return displacement.reshape(known.shape)


def frequencies(structure: Structure, fixed: BoolArray, count: int, shift: float = 0.0) -> Array:
    """Lowest natural frequencies [Hz] with the ``fixed`` freedoms at rest.

    ``shift`` [Hz] moves the centre of the inverse iteration below zero for a free structure.
    """
    moving = np.flatnonzero(~fixed.ravel())
    stiffness = structure.stiffness[moving][:, moving].tocsc()
    mass = structure.inertia.mass_matrix()[moving][:, moving].tocsc()
    sigma = -((2 * np.pi * shift) ** 2)
    start = np.random.default_rng(7).normal(size=len(moving))
    values = eigsh(
        stiffness, count, mass, sigma=sigma, which="LM", return_eigenvectors=False, v0=start
    )
    found: Array = np.sqrt(np.clip(np.sort(values), 0.0, None)) / (2 * np.pi)
    return found


def shares(quads: IntArray, coordinates: Array) -> Array:
    """Surface area (n,) that belongs to each node of flat quadrilaterals."""
    corner = coordinates[quads]
    normal = np.cross(corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1])
    areas = np.linalg.norm(normal, axis=1) / 2
    total = np.zeros(len(coordinates))
    np.add.at(total, quads.ravel(), np.repeat(areas / 4, 4))
    return total
