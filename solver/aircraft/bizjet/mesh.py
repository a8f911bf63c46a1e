"""Collecting nodes, elements and masses into a finite-element model.

Nodes with equal coordinates are one node, so that parts built one by one from the same dimensions
join along their common lines; `Mesh.free_node` makes a node that joins nothing.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from solver.aircraft.bizjet.catalogue import Catalogue
from solver.arrays import Array, IntArray
from solver.fe.model import (
    Beams,
    FiniteElementModel,
    Interpolation,
    PointMasses,
    RigidBody,
    Shells,
)

#: Coordinates are written with this many decimals of a metre.
DECIMALS = 5
#: Nodes nearer than this are one node [m].
JOINT = 1e-4
#: A bay's name from an element's centroid (3,).
Label = str | Callable[[Array], str]


@dataclass
class Mesh:
    """The model under construction; node and element numbers are rows until `model`."""

    catalogue: Catalogue
    coordinates: list[tuple[float, float, float]] = field(default_factory=list)
    quads: list[tuple[tuple[int, ...], int]] = field(default_factory=list)
    triangles: list[tuple[tuple[int, ...], int]] = field(default_factory=list)
    beams: list[tuple[tuple[int, int], int, Array, Array]] = field(default_factory=list)
    masses: list[tuple[int, int, float, Array, Array]] = field(default_factory=list)
    rigid: list[tuple[int, list[int]]] = field(default_factory=list)
    interpolated: list[tuple[int, list[int]]] = field(default_factory=list)
    _rows: dict[tuple[int, int, int], int] = field(default_factory=dict)
    _mass_numbers: dict[int, int] = field(default_factory=dict)

    def node(self, x: float, y: float, z: float) -> int:
        """Row of the node at this point, new or not."""
        cell = (math.floor(x / JOINT), math.floor(y / JOINT), math.floor(z / JOINT))
        for near in product(*((k - 1, k, k + 1) for k in cell)):
            if near in self._rows and math.dist(self.coordinates[self._rows[near]], (x, y, z)) < (
                JOINT
            ):
                return self._rows[near]
        self._rows[cell] = self.free_node(x, y, z)
        return self._rows[cell]

    def free_node(self, x: float, y: float, z: float) -> int:
        """Row of a new node that no other part finds."""
        point = (float(x), float(y), float(z))
        self.coordinates.append(tuple(round(value, DECIMALS) + 0.0 for value in point))  # type: ignore[arg-type]
        return len(self.coordinates) - 1

    def grid(self, points: Array) -> IntArray:
        """Rows of nodes at points (..., 3); shape (...)."""
        flat = [self.node(*point) for point in points.reshape(-1, 3).tolist()]
        return np.array(flat, dtype=np.int64).reshape(points.shape[:-1])

    def points(self, rows: ArrayLike) -> Array:
        """Coordinates of node rows, (..., 3) [m]."""
        table = [self.coordinates[row] for row in np.asarray(rows).ravel()]
        return np.array(table).reshape(*np.shape(rows), 3)

    def shells(self, grid: IntArray, family: str, label: Label) -> None:
        """Fill a grid (m, n) of nodes with shells; cells with a collapsed side become triangles."""
        for i in range(grid.shape[0] - 1):
            for j in range(grid.shape[1] - 1):
                corners = (grid[i, j], grid[i + 1, j], grid[i + 1, j + 1], grid[i, j + 1])
                distinct = tuple(dict.fromkeys(int(corner) for corner in corners))
                if len(distinct) < 3:
                    continue
                centre = self.points(distinct).mean(axis=0)
                number = self.catalogue.property(family, _label(label, centre), centre)
                (self.quads if len(distinct) == 4 else self.triangles).append((distinct, number))

    def stiffener(
        self, path: IntArray, family: str, label: Label, inward: ArrayLike, offset: float
    ) -> None:
        """Beams along a path (n,) of nodes, their axis ``offset`` from it along ``inward``.

        ``inward`` is one unit vector or one for each node, (3,) or (n, 3); it is also the
        direction in which the section is deep.
        """
        directions = np.broadcast_to(np.asarray(inward, dtype=float), (len(path), 3))
        for k in range(len(path) - 1):
            a, b = int(path[k]), int(path[k + 1])
            if a == b:
                continue
            centre = self.points((a, b)).mean(axis=0)
            number = self.catalogue.property(family, _label(label, centre), centre)
            ends = directions[k : k + 2]
            # Rounded, so that a mirrored beam is written with the mirrored figures.
            orientation = np.round(ends.mean(axis=0), 6) + 0.0
            self.beams.append(((a, b), number, orientation, np.round(offset * ends, 6) + 0.0))

    def mass(
        self,
        row: int,
        mass: float,
        block: int,
        offset: ArrayLike = (0.0, 0.0, 0.0),
        inertia: Array | None = None,
    ) -> int:
        """Attach a lumped mass; its identifier counts up from ``block``."""
        identifier = self._mass_numbers.get(block, block)
        self._mass_numbers[block] = identifier + 1
        tensor = np.zeros((3, 3)) if inertia is None else inertia
        self.masses.append(
            (identifier, row, float(mass), np.round(np.asarray(offset, dtype=float), 6), tensor)
        )
        return identifier

    def model(self, masses: bool = True) -> FiniteElementModel:
        """Everything collected so far; a node's identifier is its row here plus one.

        Nodes that nothing is joined to (left over where a part leaves a grid open) are left out.
        """
        linked = {row for corners, _ in self.quads + self.triangles for row in corners}
        linked |= {row for beam in self.beams for row in beam[0]}
        linked |= {reference for reference, _ in self.rigid + self.interpolated}
        kept = np.array(sorted(linked), dtype=np.int64)
        new = np.full(len(self.coordinates), -1, dtype=np.int64)
        new[kept] = np.arange(len(kept))
        quads = _shells(self.quads, 4, 1, new)
        triangles = _shells(self.triangles, 3, 1 + len(self.quads), new)
        first = 1 + len(self.quads) + len(self.triangles)
        beams = Beams(
            identifiers=np.arange(first, first + len(self.beams)),
            nodes=new[np.array([beam[0] for beam in self.beams]).reshape(-1, 2)],
            properties=np.array([beam[1] for beam in self.beams], dtype=np.int64),
            orientations=np.array([beam[2] for beam in self.beams]).reshape(-1, 3),
            offsets=np.array([beam[3] for beam in self.beams]).reshape(-1, 2, 3),
        )
        lumped = sorted(self.masses, key=lambda item: item[0]) if masses else []
        used = {number for _, number in self.quads + self.triangles}
        used |= {beam[1] for beam in self.beams}
        first_link = first + len(self.beams)
        return FiniteElementModel(
            node_identifiers=kept + 1,
            coordinates=np.array(self.coordinates)[kept],
            materials=self.catalogue.materials,
            shell_properties={
                k: v for k, v in self.catalogue.shell_properties().items() if k in used
            },
            beam_properties={
                k: v for k, v in self.catalogue.beam_properties().items() if k in used
            },
            quads=quads,
            triangles=triangles,
            beams=beams,
            point_masses=PointMasses(
                identifiers=np.array([item[0] for item in lumped], dtype=np.int64),
                nodes=new[np.array([item[1] for item in lumped], dtype=np.int64)],
                masses=np.array([item[2] for item in lumped]),
                offsets=np.array([item[3] for item in lumped]).reshape(-1, 3),
                inertias=np.array([item[4] for item in lumped]).reshape(-1, 3, 3),
            ),
            rigid_bodies=tuple(
                RigidBody(first_link + k, int(new[independent]), new[dependents])
                for k, (independent, dependents) in enumerate(self.rigid)
            ),
            interpolations=tuple(
                Interpolation(
                    first_link + len(self.rigid) + k, int(new[row]), new[nodes], np.ones(len(nodes))
                )
                for k, (row, nodes) in enumerate(self.interpolated)
            ),
        )


def _label(label: Label, centre: Array) -> str:
    return label if isinstance(label, str) else label(centre)


def _shells(
    entries: Sequence[tuple[tuple[int, ...], int]], corners: int, first: int, new: IntArray
) -> Shells:
    return Shells(
        identifiers=np.arange(first, first + len(entries)),
        nodes=new[np.array([entry[0] for entry in entries], dtype=np.int64).reshape(-1, corners)],
        properties=np.array([entry[1] for entry in entries], dtype=np.int64),
    )
