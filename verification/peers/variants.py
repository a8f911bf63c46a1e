"""The same model with other elements or another Poisson ratio, and its modes by the solver."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.sparse.linalg import LinearOperator, eigsh

from solver.arrays import Array, IntArray
from solver.fe.model import FiniteElementModel, Shells
from solver.fe.structure import build_structure
from solver.inertia_relief.factor import factorise

#: Eigenvalue about which the lowest modes are looked for; below zero, as rigid modes have zero.
SHIFT = -100.0
RIGID = 6


def triangulated(model: FiniteElementModel) -> FiniteElementModel:
    """Cut every quadrilateral into two triangles along its diagonal 1-3."""
    quads = model.quads
    first = int(model.element_identifiers.max(initial=0)) + 1
    halves = np.concatenate([quads.nodes[:, [0, 1, 2]], quads.nodes[:, [0, 2, 3]]])
    triangles = Shells(
        identifiers=np.concatenate(
            [model.triangles.identifiers, first + np.arange(2 * len(quads.nodes))]
        ),
        nodes=np.concatenate([model.triangles.nodes, halves]),
        properties=np.concatenate([model.triangles.properties, quads.properties, quads.properties]),
    )
    none = np.zeros(0, dtype=np.int64)
    return replace(
        model, quads=Shells(none, np.zeros((0, 4), dtype=np.int64), none), triangles=triangles
    )


def with_poisson_ratio(model: FiniteElementModel, ratio: float) -> FiniteElementModel:
    """Give all materials another Poisson ratio, the shear modulus that of isotropy."""
    materials = {
        number: replace(
            material,
            poisson_ratio=ratio,
            shear_modulus=material.young_modulus / (2.0 * (1.0 + ratio)),
        )
        for number, material in model.materials.items()
    }
    return replace(model, materials=materials)


@dataclass(frozen=True, slots=True)
class Modes:
    """Lowest elastic modes of an unsupported model."""

    frequencies: Array  #: (k,) [Hz]
    shapes: Array  #: (n, 6, k) of the model's nodes

    def __len__(self) -> int:
        return len(self.frequencies)

    def at(self, rows: IntArray) -> "Modes":
        """Take the shapes at some nodes only."""
        return Modes(self.frequencies, self.shapes[rows])


def elastic_modes(eigenvalues: Array, shapes: Array) -> Modes:
    """Leave out the six rigid modes."""
    return Modes(np.sqrt(eigenvalues[RIGID:]) / (2.0 * np.pi), shapes[:, :, RIGID:])


def solved(stiffness: Any, mass: Any, count: int) -> tuple[Array, Array]:
    """Lowest eigenvalues (count,) and eigenvectors (n, count) of a free structure."""
    factor = factorise(stiffness - SHIFT * mass)
    inverse = LinearOperator(mass.shape, matvec=factor.solve, dtype=np.float64)
    # A start of its own makes the run repeatable.
    start = np.random.default_rng(1).standard_normal(mass.shape[0])
    values, vectors = eigsh(stiffness, k=count, M=mass, sigma=SHIFT, OPinv=inverse, v0=start)
    rising = np.argsort(values)
    return values[rising], vectors[:, rising]


def our_modes(model: FiniteElementModel, count: int) -> Modes:
    """Lowest ``count`` elastic modes by the solver."""
    structure = build_structure(model)
    values, vectors = solved(structure.stiffness, structure.inertia.mass_matrix(), count + RIGID)
    return elastic_modes(values, structure.nodal_displacements(vectors))


def assurance(first: Modes, second: Modes) -> Array:
    """Modal assurance criterion (k, l) of the translations, 1 for shapes that are alike."""
    a = first.shapes[:, :3].reshape(-1, len(first))
    b = second.shapes[:, :3].reshape(-1, len(second))
    products = (a.T @ b) ** 2
    measured: Array = products / np.outer(np.sum(a * a, axis=0), np.sum(b * b, axis=0))
    return measured


@dataclass(frozen=True, slots=True)
class Pair:
    """A mode and the one of another computation that is most like it."""

    first: int
    second: int
    assurance: float


def paired(first: Modes, second: Modes) -> list[Pair]:
    """Pair every mode of ``first`` with the most similar one of ``second``."""
    table = assurance(first, second)
    best = np.argmax(table, axis=1)
    return [Pair(row, int(best[row]), float(table[row, best[row]])) for row in range(len(first))]


def likeness(first: Modes, second: Modes, within: float) -> Array:
    """How much of each shape of ``first`` the modes of ``second`` near the best one hold.

    Modes of nearly the same frequency are only determined together: their assurances, which for
    shapes orthogonal in the mean add up to 1, are summed over modes ``within`` that share of the
    frequency of the most similar one.
    """
    table = assurance(first, second)
    best = second.frequencies[np.argmax(table, axis=1)]
    near = np.abs(second.frequencies / best[:, None] - 1.0) <= within
    summed: Array = np.minimum(1.0, np.sum(table * near, axis=1))
    return summed
