"""Small free structures at the airframe's mesh density: where element formulations part.

A flat and a curved panel of bare skin, a panel with offset stringers and frames, and a ribbed box
beam, all with elements of the airframe's size and gauge.  ``fineness`` divides every element.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from solver.arrays import Array, IntArray
from solver.fe.model import (
    BeamProperty,
    Beams,
    FiniteElementModel,
    Material,
    PointMasses,
    ShellProperty,
    Shells,
)

#: Aluminium of the airframe's skins.
ALUMINIUM = Material(1, 72.4e9, 72.4e9 / (2 * 1.33), 0.33, 2780.0)
SIDE = 0.2  #: of an element at fineness 1, about that of the airframe [m]
GAUGE = 1.5e-3  #: [m]
RADIUS = 0.95  #: of a fuselage [m]
#: A stringer of I section, 30 mm high: area, moments of inertia, torsion constant.
STRINGER = BeamProperty(
    1,
    1,
    1.2e-4,
    1.8e-8,
    2.0e-9,
    8.0e-11,
    np.zeros((4, 2)),
    shear_factor_1=0.45,
    shear_factor_2=0.45,
)
STRINGER_OFFSET = 0.018  #: of its centroid from the skin's middle surface [m]


def flat_panel(fineness: int) -> FiniteElementModel:
    """Bare flat panel, 5 x 4 elements."""
    coordinates, quads = _grid(5 * fineness, 4 * fineness)
    return _shells(coordinates * (SIDE / fineness), quads)


def curved_panel(fineness: int) -> FiniteElementModel:
    """Bare panel of a fuselage's curvature, 5 elements along and 4 around."""
    coordinates, quads = _grid(5 * fineness, 4 * fineness)
    flat = coordinates * (SIDE / fineness)
    angle = flat[:, 1] / RADIUS
    bent = np.stack([flat[:, 0], RADIUS * np.sin(angle), RADIUS * np.cos(angle)], axis=1)
    return _shells(bent, quads)


def stiffened_panel(fineness: int) -> FiniteElementModel:
    """Flat panel with three offset stringers along it and two across."""
    columns, rows = 5 * fineness, 4 * fineness
    coordinates, quads = _grid(columns, rows)
    number = np.arange(len(coordinates)).reshape(rows + 1, columns + 1)
    lines = [number[row * fineness] for row in (1, 2, 3)]
    lines += [number[:, column * fineness] for column in (1, 4)]
    nodes = np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in lines])
    model = _shells(coordinates * (SIDE / fineness), quads)
    return _with_stringers(model, nodes)


def ribbed_box(fineness: int) -> FiniteElementModel:
    """Square box beam of ten bays, one element to each wall of a bay, with a rib between bays."""
    return box_beam(10, fineness, has_ribs=True)


def box_beam(bays: int, fineness: int, has_ribs: bool) -> FiniteElementModel:
    """Square tube of `SIDE` along x, its bays as long as wide; ribs at their ends if asked."""
    steps = np.arange(fineness + 1)
    inside = np.array([(j, k) for j in steps for k in steps])
    rim = (inside == 0).any(axis=1) | (inside == fineness).any(axis=1)
    sections: dict[tuple[int, int, int], int] = {}
    coordinates: list[Array] = []
    for station in range(bays * fineness + 1):
        is_rib = has_ribs and station % fineness == 0
        for (j, k), on_rim in zip(inside.tolist(), rim, strict=True):
            if on_rim or is_rib:
                sections[station, j, k] = len(coordinates)
                coordinates.append(np.array([station, j, k], dtype=float))
    quads = []
    for station in range(bays * fineness):
        for (a, b), (c, d) in _rim_sides(fineness):
            corners = ((station, a, b), (station, c, d), (station + 1, c, d), (station + 1, a, b))
            quads.append([sections[corner] for corner in corners])
    for station in range(0, bays * fineness + 1, fineness) if has_ribs else ():
        quads += [
            [sections[station, *at] for at in _square(j, k)]
            for j in range(fineness)
            for k in range(fineness)
        ]
    return _shells(np.array(coordinates) * (SIDE / fineness), np.array(quads))


def _square(j: int, k: int) -> tuple[tuple[int, int], ...]:
    return (j, k), (j + 1, k), (j + 1, k + 1), (j, k + 1)


def _rim_sides(count: int) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Sides of a square of ``count`` elements, once round."""
    corners = [(i, 0) for i in range(count)] + [(count, i) for i in range(count)]
    corners += [(count - i, count) for i in range(count)] + [(0, count - i) for i in range(count)]
    return list(zip(corners, corners[1:] + corners[:1], strict=True))


@dataclass(frozen=True, slots=True)
class Panel:
    """A case: its name and what builds it at a fineness."""

    name: str
    build: Callable[[int], FiniteElementModel]


PANELS = (
    Panel("flat panel", flat_panel),
    Panel("curved panel", curved_panel),
    Panel("stiffened panel", stiffened_panel),
    Panel("ribbed box", ribbed_box),
)


def _grid(columns: int, rows: int) -> tuple[Array, IntArray]:
    """Lay out a unit grid: node positions, row by row, and quadrilaterals."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
    coordinates = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    number = np.arange(x.size).reshape(rows + 1, columns + 1)
    quads = np.stack(
        [number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], axis=-1
    ).reshape(-1, 4)
    return coordinates, quads


def _shells(coordinates: Array, quads: IntArray) -> FiniteElementModel:
    none = np.zeros(0, dtype=np.int64)
    count = len(quads)
    return FiniteElementModel(
        node_identifiers=np.arange(1, len(coordinates) + 1),
        coordinates=coordinates,
        materials={1: ALUMINIUM},
        shell_properties={1: ShellProperty(1, 1, GAUGE)},
        beam_properties={1: STRINGER},
        quads=Shells(np.arange(1, count + 1), quads, np.ones(count, dtype=np.int64)),
        triangles=Shells(none, np.zeros((0, 3), dtype=np.int64), none),
        beams=Beams(
            none, np.zeros((0, 2), dtype=np.int64), none, np.zeros((0, 3)), np.zeros((0, 2, 3))
        ),
        point_masses=PointMasses(none, none, np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3, 3))),
    )


def _with_stringers(model: FiniteElementModel, nodes: IntArray) -> FiniteElementModel:
    count = len(nodes)
    first = len(model.quads.identifiers) + 1
    offsets = np.zeros((count, 2, 3))
    offsets[:, :, 2] = STRINGER_OFFSET
    beams = Beams(
        identifiers=first + np.arange(count),
        nodes=nodes,
        properties=np.ones(count, dtype=np.int64),
        orientations=np.tile([0.0, 0.0, 1.0], (count, 1)),
        offsets=offsets,
    )
    return replace(model, beams=beams)
