"""Builders of small models: strips, plates, curved shells and chains of beams."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from solver.arrays import Array, IntArray
from solver.fe.model import (
    BeamProperty,
    Beams,
    FiniteElementModel,
    Interpolation,
    Material,
    PointMasses,
    RigidBody,
    ShellProperty,
    Shells,
)

ELEMENT_STEP = 100_000  #: identifiers: quads from 1, triangles and beams from multiples of this


def material(young: float = 70e9, poisson: float = 0.3, density: float = 2700.0) -> Material:
    """Isotropic material of number 1."""
    return Material(1, young, young / (2 * (1 + poisson)), poisson, density)


def rectangle_section(width: float, height: float, identifier: int = 1) -> BeamProperty:
    """Solid rectangle: ``width`` along element y, ``height`` along element z; Saint-Venant J."""
    long, short = max(width, height), min(width, height)
    ratio = short / long
    torsion = long * short**3 * (1 / 3 - 0.21 * ratio * (1 - ratio**4 / 12))
    y, z = width / 2, height / 2
    return BeamProperty(
        identifier,
        1,
        width * height,
        height * width**3 / 12,
        width * height**3 / 12,
        torsion,
        np.array([[y, z], [y, -z], [-y, -z], [-y, z]]),
        torsion_radius=short,
        shear_factor_1=5 / 6,
        shear_factor_2=5 / 6,
    )


def no_shells(corners: int) -> Shells:
    """No elements of that many corners."""
    empty = np.zeros(0, dtype=np.int64)
    return Shells(empty, np.zeros((0, corners), dtype=np.int64), empty)


def no_beams() -> Beams:
    """No beams."""
    empty = np.zeros(0, dtype=np.int64)
    return Beams(
        empty, np.zeros((0, 2), dtype=np.int64), empty, np.zeros((0, 3)), np.zeros((0, 2, 3))
    )


def no_masses() -> PointMasses:
    """No lumped masses."""
    empty = np.zeros(0, dtype=np.int64)
    return PointMasses(empty, empty, np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3, 3)))


def lumped(
    nodes: Sequence[int] | IntArray,
    masses: Sequence[float] | Array,
    offsets: ArrayLike | None = None,
    inertias: ArrayLike | None = None,
) -> PointMasses:
    """Lumped masses [kg] at node rows, with offsets (k, 3) [m] and tensors (k, 3, 3) [kg m2]."""
    count = len(nodes)
    return PointMasses(
        np.arange(count) + 900_001,
        np.asarray(nodes),
        np.asarray(masses, dtype=float),
        np.zeros((count, 3)) if offsets is None else np.asarray(offsets, dtype=float),
        np.zeros((count, 3, 3)) if inertias is None else np.asarray(inertias, dtype=float),
    )


def model(
    coordinates: Array,
    quads: IntArray | None = None,
    triangles: IntArray | None = None,
    beams: Beams | None = None,
    thickness: float = 0.01,
    section: BeamProperty | Sequence[BeamProperty] | None = None,
    substance: Material | None = None,
    masses: PointMasses | None = None,
    rigid_bodies: Sequence[RigidBody] = (),
    interpolations: Sequence[Interpolation] = (),
    shell_mass: float = 0.0,
) -> FiniteElementModel:
    """One model of one material and one shell property, identifiers counted from 1."""
    sections = [section] if isinstance(section, BeamProperty) else list(section or ())

    def shells(nodes: IntArray | None, corners: int, start: int) -> Shells:
        if nodes is None:
            return no_shells(corners)
        ones = np.ones(len(nodes), dtype=np.int64)
        return Shells(start + np.arange(len(nodes)), np.asarray(nodes), ones)

    return FiniteElementModel(
        node_identifiers=np.arange(len(coordinates)) + 1,
        coordinates=np.asarray(coordinates, dtype=float),
        materials={1: substance or material()},
        shell_properties={1: ShellProperty(1, 1, thickness, shell_mass)},
        beam_properties={entry.identifier: entry for entry in sections},
        quads=shells(quads, 4, 1),
        triangles=shells(triangles, 3, ELEMENT_STEP),
        beams=beams or no_beams(),
        point_masses=masses or no_masses(),
        rigid_bodies=tuple(rigid_bodies),
        interpolations=tuple(interpolations),
    )


def grid_nodes(across: int, along: int) -> IntArray:
    """Node rows (along + 1, across + 1) of a structured mesh."""
    return np.arange((across + 1) * (along + 1)).reshape(along + 1, across + 1)


def grid_quads(nodes: IntArray) -> IntArray:
    """Quadrilaterals of a structured mesh, first index a, second b: normal along d/db x d/da."""
    return np.stack(
        [nodes[:-1, :-1], nodes[:-1, 1:], nodes[1:, 1:], nodes[1:, :-1]], axis=-1
    ).reshape(-1, 4)


def split(quads: IntArray, crossed: bool = True) -> IntArray:
    """Two triangles per quadrilateral, the diagonal alternating if ``crossed``."""
    a, b, c, d = quads.T
    flip = (np.arange(len(quads)) % 2 == 1) & crossed
    first = np.where(flip[:, None], np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    second = np.where(flip[:, None], np.stack([b, c, d], 1), np.stack([a, c, d], 1))
    return np.concatenate([first, second])


def shell_mesh(
    coordinates: Array,
    quads: IntArray,
    triangular: bool = False,
    crossed: bool = True,
    **options: Any,
) -> FiniteElementModel:
    """Shells on ``quads``, each split into two triangles if ``triangular``."""
    if triangular:
        return model(coordinates, triangles=split(quads, crossed), **options)
    return model(coordinates, quads=quads, **options)


def surface(
    shape: Callable[[Array, Array], Array],
    across: int,
    along: int,
    triangular: bool = False,
    **options: Any,
) -> FiniteElementModel:
    """Shell mesh of ``shape(s, t) -> (..., 3)`` over the unit square; s across, t along.

    Node row of (s_i, t_j) is ``grid_nodes(across, along)[j, i]``.
    """
    t, s = np.meshgrid(np.linspace(0, 1, along + 1), np.linspace(0, 1, across + 1), indexing="ij")
    coordinates = shape(s, t).reshape(-1, 3)
    quads = grid_quads(grid_nodes(across, along))
    return shell_mesh(coordinates, quads, triangular, **options)


def plate(
    width: float, length: float, across: int, along: int, triangular: bool = False, **options: Any
) -> FiniteElementModel:
    """Flat plate in the x-y plane, x across (0 to width), y along (0 to length)."""
    return surface(
        lambda s, t: np.stack([width * s, length * t, 0 * s], axis=-1),
        across,
        along,
        triangular,
        **options,
    )


def cylinder(
    radius: float, length: float, around: int, along: int, triangular: bool = False, **options: Any
) -> FiniteElementModel:
    """Mesh a closed circular cylinder about x from 0 to ``length``, normals outward."""
    angle = 2 * np.pi * np.arange(around) / around
    x = np.linspace(0, length, along + 1)
    ring = np.stack([0 * angle, radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
    coordinates = (ring[None] + x[:, None, None] * np.array([1.0, 0, 0])).reshape(-1, 3)
    nodes = np.arange(around * (along + 1)).reshape(along + 1, around)
    quads = grid_quads(np.concatenate([nodes, nodes[:, :1]], axis=1))
    return shell_mesh(coordinates, quads, triangular, **options)


def beam_chain(
    points: Array,
    section: BeamProperty,
    orientation: ArrayLike = (0.0, 1.0, 0.0),
    offset: ArrayLike | None = None,
    **options: Any,
) -> FiniteElementModel:
    """Beams joining ``points`` (n, 3) one after another; all ends shifted by ``offset``."""
    count = len(points) - 1
    nodes = np.stack([np.arange(count), np.arange(count) + 1], axis=1)
    return model(
        points,
        beams=beams_on(nodes, orientation=orientation, offset=offset),
        section=section,
        **options,
    )


def beams_on(
    nodes: IntArray,
    orientation: ArrayLike = (0.0, 1.0, 0.0),
    offset: ArrayLike | None = None,
    section: int = 1,
) -> Beams:
    """Beams on pairs of node rows (m, 2)."""
    count = len(nodes)
    offsets = np.zeros((count, 2, 3))
    if offset is not None:
        offsets[:] = np.asarray(offset, dtype=float)
    return Beams(
        2 * ELEMENT_STEP + np.arange(count),
        np.asarray(nodes),
        np.full(count, section),
        np.broadcast_to(np.asarray(orientation, dtype=float), (count, 3)).copy(),
        offsets,
    )


def straight_beam(
    length: float, count: int, section: BeamProperty, **options: Any
) -> FiniteElementModel:
    """Beam along x from 0 to ``length``."""
    points = np.zeros((count + 1, 3))
    points[:, 0] = np.linspace(0, length, count + 1)
    return beam_chain(points, section, **options)
