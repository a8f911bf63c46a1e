"""Nastran bulk data in: a file of supported cards becomes a `FiniteElementModel`, or is refused.

Read are GRID, CORD2R, CQUAD4, CTRIA3, CBAR, PSHELL, PBAR, PBARL, MAT1, CONM2, RBE2 and RBE3, in
small, large and free field format.  ``PARAM`` is passed over when it only asks for output or tunes
a solver (`HARMLESS_PARAMETERS`).  Every other card, and every field whose meaning the solver does
not honour, is refused with file, line, card and field: a model is never half read.

Field meanings: MSC/NX Nastran Quick Reference Guide, bulk data entries of these names.
"""

from collections import defaultdict
from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, TypeVar

import numpy as np

from solver.aircraft import nastran_elements as elements
from solver.aircraft import nastran_properties as properties
from solver.aircraft.nastran_cards import Card, read_cards
from solver.aircraft.nastran_coordinates import CoordinateSystem, coordinate_systems
from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.fe.model import (
    BeamProperty,
    Beams,
    FiniteElementModel,
    Interpolation,
    PointMasses,
    RigidBody,
    ShellProperty,
    Shells,
)

#: Parameters without influence on what is computed here: output requests, Nastran's own
#: singularity handling, drilling stiffness and choice of mass matrix.
HARMLESS_PARAMETERS = frozenset(
    {
        "AUTOSPC", "BAILOUT", "COUPMASS", "GRDPNT", "K6ROT", "MAXRATIO", "NOCOMPS", "OGEOM",
        "PATVER", "POST", "PRGPST", "PRTMAXIM", "SNORM", "TINY", "USETPRT",
    }
)  # fmt: skip
#: Every card that is read (``PARAM`` only to be passed over or refused).
SUPPORTED_CARDS = frozenset(
    {
        "GRID", "CORD2R", "CQUAD4", "CTRIA3", "CBAR", "PSHELL", "PBAR", "PBARL", "MAT1", "CONM2",
        "RBE2", "RBE3", "PARAM",
    }
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Deck:
    """A bulk-data file that was read."""

    model: FiniteElementModel
    ignored_parameters: tuple[str, ...]  #: ``PARAM`` cards passed over, "NAME (line n)"


def read_bulk_data(path: Path) -> Deck:
    """Read a bulk-data file.

    Raises
    ------
    ModelError
        The file cannot be read, or holds anything that is not supported; says where.
    """
    try:
        text = path.read_text(encoding="latin-1")
    except OSError as error:
        raise ModelError(f"{path}: cannot be read: {error.strerror}") from error
    return parse_bulk_data(text, path.name)


def parse_bulk_data(text: str, source: str = "bulk data") -> Deck:
    """Read bulk data from a string; ``source`` names it in messages."""
    cards: dict[str, list[Card]] = defaultdict(list)
    for card in read_cards(text, source):
        if card.name not in SUPPORTED_CARDS:
            raise card.error("this card is not supported")
        cards[card.name].append(card)
    if not cards["GRID"]:
        raise ModelError(f"{source}: holds no GRID")
    systems = coordinate_systems(cards["CORD2R"])
    identifiers, coordinates = _nodes(cards["GRID"], systems)
    rows = {identifier: row for row, identifier in enumerate(identifiers.tolist())}
    quads = [elements.shell(card) for card in cards["CQUAD4"]]
    triangles = [elements.shell(card) for card in cards["CTRIA3"]]
    bars = [elements.bar(card) for card in cards["CBAR"]]
    masses = [elements.point_mass(card) for card in cards["CONM2"]]
    rigid = [elements.rigid_body(card) for card in cards["RBE2"]]
    means = [elements.interpolation(card) for card in cards["RBE3"]]
    _unique([*quads, *triangles, *bars, *masses, *rigid, *means])
    materials = _by_identifier(cards["MAT1"], properties.material)
    shell_properties = _by_identifier(cards["PSHELL"], properties.shell_property)
    beam_properties = _by_identifier(cards["PBAR"], properties.bar_property)
    named = _by_identifier(cards["PBARL"], properties.named_bar_property)
    for identifier in sorted(beam_properties.keys() & named.keys()):
        raise ModelError(f"{source}: PBAR and PBARL are both numbered {identifier}")
    beam_properties |= named
    for identifier in sorted(beam_properties.keys() & shell_properties.keys()):
        raise ModelError(f"{source}: PSHELL and PBAR(L) are both numbered {identifier}")
    sections: list[ShellProperty | BeamProperty] = [
        *shell_properties.values(),
        *beam_properties.values(),
    ]
    for section in sections:
        if section.material not in materials:
            raise ModelError(
                f"{source}: property {section.identifier} names MAT1 {section.material}, "
                "which is missing"
            )
    model = FiniteElementModel(
        node_identifiers=identifiers,
        coordinates=coordinates,
        materials=materials,
        shell_properties=shell_properties,
        beam_properties=beam_properties,
        quads=_shells(quads, 4, rows, shell_properties),
        triangles=_shells(triangles, 3, rows, shell_properties),
        beams=_beams(bars, rows, beam_properties, coordinates),
        point_masses=_point_masses(masses, rows, systems),
        rigid_bodies=tuple(
            RigidBody(
                identifier=item.identifier,
                independent=_row(item.card, rows, item.independent),
                dependents=_rows(item.card, rows, item.dependents),
            )
            for item in rigid
        ),
        interpolations=tuple(
            Interpolation(
                identifier=item.identifier,
                reference=_row(item.card, rows, item.reference),
                nodes=_rows(item.card, rows, item.nodes),
                weights=np.array(item.weights),
            )
            for item in means
        ),
    )
    return Deck(model, tuple(_parameter(card) for card in cards["PARAM"]))


def _parameter(card: Card) -> str:
    name = card.text(0)
    if name == "WTMASS":
        if card.real(1, "V1") != 1.0:
            raise card.error("scales mass and is not supported; give densities and masses in SI")
        return f"WTMASS (line {card.line})"
    if name not in HARMLESS_PARAMETERS:
        raise card.error("this parameter is not known to be harmless")
    return f"{name} (line {card.line})"


def _nodes(cards: list[Card], systems: Mapping[int, CoordinateSystem]) -> tuple[IntArray, Array]:
    identifiers = np.empty(len(cards), dtype=np.int64)
    coordinates = np.empty((len(cards), 3))
    for row, card in enumerate(cards):
        identifiers[row] = card.integer(0, "ID")
        coordinates[row] = card.vector(2, ("X1", "X2", "X3"))
        system = card.integer(1, "CP", 0, minimum=0)
        if system:
            if system not in systems:
                raise card.error(f"field CP = {system}: this CORD2R is missing")
            coordinates[row] = systems[system].position(coordinates[row])
        if len(card.fields) > 5:
            card.refuse(5, "CD", "displacements are in the basic system only")
            card.refuse(6, "PS", "an aircraft in flight has no supports")
            card.refuse(7, "SEID", "superelements are not supported")
            card.refuse_beyond(8)
    order = np.argsort(identifiers, kind="stable")
    ordered = identifiers[order]
    repeated = np.flatnonzero(ordered[1:] == ordered[:-1])
    if len(repeated):
        raise cards[order[repeated[0] + 1]].error("is defined twice")
    return ordered, coordinates[order]


class _Numbered(Protocol):
    """A card or value with an identifier."""

    @property
    def identifier(self) -> int: ...


class _Element(_Numbered, Protocol):
    """An element as its card gives it."""

    @property
    def card(self) -> Card: ...


Value = TypeVar("Value", bound=_Numbered)


def _by_identifier(cards: list[Card], read: Callable[[Card], Value]) -> dict[int, Value]:
    values: dict[int, Value] = {}
    for card in cards:
        value = read(card)
        if value.identifier in values:
            raise card.error("is defined twice")
        values[value.identifier] = value
    return values


def _unique(items: Iterable[_Element]) -> None:
    """Refuse element identifiers used twice; all element cards share one numbering."""
    seen: set[int] = set()
    for item in items:
        if item.identifier in seen:
            raise item.card.error("its element number is used before")
        seen.add(item.identifier)


def _row(card: Card, rows: Mapping[int, int], node: int) -> int:
    if node not in rows:
        raise card.error(f"names GRID {node}, which is missing")
    return rows[node]


def _rows(card: Card, rows: Mapping[int, int], nodes: Sequence[int]) -> IntArray:
    return np.array([_row(card, rows, node) for node in nodes], dtype=np.int64)


def _shells(
    cards: Sequence[elements.ShellCard],
    corners: int,
    rows: Mapping[int, int],
    known: Container[int],
) -> Shells:
    for item in cards:
        if item.property_identifier not in known:
            raise item.card.error(f"names PSHELL {item.property_identifier}, which is missing")
    return Shells(
        identifiers=np.array([item.identifier for item in cards], dtype=np.int64),
        nodes=np.array(
            [[_row(item.card, rows, node) for node in item.nodes] for item in cards],
            dtype=np.int64,
        ).reshape(-1, corners),
        properties=np.array([item.property_identifier for item in cards], dtype=np.int64),
    )


def _beams(
    cards: Sequence[elements.BarCard],
    rows: Mapping[int, int],
    known: Container[int],
    coordinates: Array,
) -> Beams:
    nodes = np.empty((len(cards), 2), dtype=np.int64)
    orientations = np.empty((len(cards), 3))
    offsets = np.empty((len(cards), 2, 3))
    for k, item in enumerate(cards):
        if item.property_identifier not in known:
            raise item.card.error(f"names PBAR(L) {item.property_identifier}, which is missing")
        nodes[k] = _rows(item.card, rows, item.nodes)
        offsets[k] = np.reshape(item.offsets, (2, 3))
        if item.orientation is not None:
            orientations[k] = item.orientation
        elif item.orientation_node is not None:
            guide = coordinates[_row(item.card, rows, item.orientation_node)]
            orientations[k] = guide - coordinates[nodes[k, 0]]
    axes = np.diff(coordinates[nodes] + offsets, axis=1)[:, 0]
    lengths = np.linalg.norm(axes, axis=1)
    normals = np.linalg.norm(np.cross(axes, orientations), axis=1)
    for k in np.flatnonzero(lengths == 0.0)[:1]:
        raise cards[k].card.error("its ends coincide")
    limits = 1e-6 * lengths * np.linalg.norm(orientations, axis=1)
    for k in np.flatnonzero(normals <= limits)[:1]:
        raise cards[k].card.error("its orientation vector is zero or lies along the bar")
    return Beams(
        identifiers=np.array([item.identifier for item in cards], dtype=np.int64),
        nodes=nodes,
        properties=np.array([item.property_identifier for item in cards], dtype=np.int64),
        orientations=orientations,
        offsets=offsets,
    )


def _point_masses(
    cards: Sequence[elements.MassCard],
    rows: Mapping[int, int],
    systems: Mapping[int, CoordinateSystem],
) -> PointMasses:
    offsets = np.empty((len(cards), 3))
    inertias = np.empty((len(cards), 3, 3))
    for k, item in enumerate(cards):
        if item.coordinate_system not in systems:
            raise item.card.error(f"field CID = {item.coordinate_system}: this CORD2R is missing")
        if item.coordinate_system:
            axes = systems[item.coordinate_system].axes
            offsets[k] = axes @ item.offset
            inertias[k] = axes @ item.inertia @ axes.T
        else:
            offsets[k] = item.offset
            inertias[k] = item.inertia
    return PointMasses(
        identifiers=np.array([item.identifier for item in cards], dtype=np.int64),
        nodes=np.array([_row(item.card, rows, item.node) for item in cards], dtype=np.int64),
        masses=np.array([item.mass for item in cards], dtype=float),
        offsets=offsets,
        inertias=inertias,
    )
