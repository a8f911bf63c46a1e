"""Elements from their bulk-data cards: CQUAD4, CTRIA3, CBAR, CONM2, RBE2, RBE3.

Each function returns identifiers as the file has them; `solver.aircraft.nastran` turns them into
rows once all nodes are known.
"""

from dataclasses import dataclass

import numpy as np

from solver.aircraft.nastran_cards import Card
from solver.arrays import Array

_OFFSET_NAMES = ("W1A", "W2A", "W3A", "W1B", "W2B", "W3B")
_INERTIA_NAMES = ("I11", "I21", "I22", "I31", "I32", "I33")


@dataclass(slots=True)
class ShellCard:
    """CQUAD4 or CTRIA3."""

    card: Card
    identifier: int
    property_identifier: int
    nodes: list[int]


@dataclass(slots=True)
class BarCard:
    """CBAR; the orientation is a vector or a node."""

    card: Card
    identifier: int
    property_identifier: int
    nodes: list[int]
    orientation: tuple[float, float, float] | None
    orientation_node: int | None
    offsets: list[float]  #: W1A to W3B


@dataclass(slots=True)
class MassCard:
    """CONM2."""

    card: Card
    identifier: int
    node: int
    coordinate_system: int
    mass: float
    offset: tuple[float, float, float]
    inertia: Array  #: (3, 3)


@dataclass(slots=True)
class RigidCard:
    """RBE2 over all six freedoms."""

    card: Card
    identifier: int
    independent: int
    dependents: list[int]


@dataclass(slots=True)
class InterpolationCard:
    """RBE3 with reference 123456 and translations 123."""

    card: Card
    identifier: int
    reference: int
    nodes: list[int]
    weights: list[float]


def shell(card: Card) -> ShellCard:
    """CQUAD4 or CTRIA3 in the middle plane.

    THETA, the material direction, is read and passed over: materials are isotropic and stresses
    are given in the element's own axes.
    """
    corners = 4 if card.name == "CQUAD4" else 3
    identifier = card.integer(0, "EID")
    nodes = [card.integer(2 + k, f"G{k + 1}") for k in range(corners)]
    if len(set(nodes)) < corners:
        raise card.error(f"a node is repeated in {nodes}")
    if len(card.fields) > 2 + corners:
        theta = card.text(2 + corners)
        if theta and "." in theta:
            card.real(2 + corners, "THETA")
        elif theta:
            card.integer(2 + corners, "MCID", minimum=0)
        card.refuse(3 + corners, "ZOFFS", "shells lie in their nodes' plane")
        card.refuse_beyond(4 + corners)
    return ShellCard(card, identifier, card.integer(1, "PID", identifier), nodes)


def bar(card: Card) -> BarCard:
    """CBAR with orientation vector or node and with offsets in basic axes."""
    card.refuse_beyond(16)
    identifier = card.integer(0, "EID")
    nodes = [card.integer(2, "GA"), card.integer(3, "GB")]
    if card.text(7) not in ("", "GGG"):
        raise card.error(f"field OFFT = {card.text(7)!r}: only GGG is supported")
    card.refuse(8, "PA", "released ends are not supported")
    card.refuse(9, "PB", "released ends are not supported")
    first = card.text(4)
    if not any(card.fields[4:7]):
        raise card.error("fields X1, X2, X3 are blank, an orientation is needed")
    orientation, node = None, None
    if first and "." not in first and not card.text(5) and not card.text(6):
        node = card.integer(4, "G0")
    else:
        orientation = card.vector(4, ("X1", "X2", "X3"))
    offsets = [card.real(10 + k, name, 0.0) for k, name in enumerate(_OFFSET_NAMES)]
    return BarCard(
        card, identifier, card.integer(1, "PID", identifier), nodes, orientation, node, offsets
    )


def point_mass(card: Card) -> MassCard:
    """CONM2: off-diagonal I21, I31, I32 are products of inertia, so the tensor takes them negative.

    ``I21 = integral of x1 x2 dm`` and so on (Quick Reference Guide, CONM2), about the mass's own
    centre in the axes of CID.
    """
    card.refuse_beyond(14)
    card.refuse(7, "9", "must be blank")
    system = card.integer(2, "CID", 0, minimum=-1)
    if system == -1:
        raise card.error("field CID = -1 is not supported; give the offset from the node")
    mass = card.real(3, "M")
    if mass < 0:
        raise card.error(f"field M = {mass:g} must not be negative")
    i11, i21, i22, i31, i32, i33 = (
        card.real(8 + k, name, 0.0) for k, name in enumerate(_INERTIA_NAMES)
    )
    inertia = np.array([[i11, -i21, -i31], [-i21, i22, -i32], [-i31, -i32, i33]])
    if any((i11, i21, i22, i31, i32, i33)):
        smallest, largest = np.linalg.eigvalsh(inertia)[[0, -1]]
        if smallest < -1e-9 * abs(largest):
            raise card.error(f"its inertia has the negative principal value {smallest:g}")
    return MassCard(
        card,
        card.integer(0, "EID"),
        card.integer(1, "G"),
        system,
        mass,
        card.vector(4, ("X1", "X2", "X3")),
        inertia,
    )


def rigid_body(card: Card) -> RigidCard:
    """RBE2 that ties all six freedoms."""
    _all_six(card, 2, "CM")
    dependents = [
        card.integer(index, f"GM{index - 2}")
        for index in range(3, len(card.fields))
        if card.fields[index]
    ]
    independent = card.integer(1, "GN")
    if not dependents:
        raise card.error("names no dependent node")
    if len(set(dependents)) < len(dependents) or independent in dependents:
        raise card.error("names a node twice")
    return RigidCard(card, card.integer(0, "EID"), independent, dependents)


def interpolation(card: Card) -> InterpolationCard:
    """RBE3: weight groups over translations; UM and thermal expansion are refused."""
    card.refuse(1, "3", "must be blank")
    _all_six(card, 3, "REFC")
    nodes: list[int] = []
    weights: list[float] = []
    weight: float | None = None
    index = 4
    while index < len(card.fields):
        text = card.fields[index]
        if not text:
            index += 1
        elif text in ("UM", "ALPHA"):
            raise card.error(f"{text} is not supported")
        elif "." in text:
            weight = card.real(index, "WT")
            if weight <= 0:
                raise card.error(f"weight {weight:g} must be above zero")
            if set(card.text(index + 1)) != set("123"):
                raise card.error(f"field C = {card.text(index + 1)!r}: only 123 is supported")
            index += 2
        elif weight is None:
            raise card.error("names nodes before a weight")
        else:
            nodes.append(card.integer(index, "G"))
            weights.append(weight)
            index += 1
    reference = card.integer(2, "REFGRID")
    if len(nodes) < 3:
        raise card.error(f"needs at least three nodes, has {len(nodes)}")
    if len(set(nodes)) < len(nodes) or reference in nodes:
        raise card.error("names a node twice")
    return InterpolationCard(card, card.integer(0, "EID"), reference, nodes, weights)


def _all_six(card: Card, index: int, name: str) -> None:
    if sorted(card.text(index)) != list("123456"):
        raise card.error(f"field {name} = {card.text(index)!r}: only 123456 is supported")
