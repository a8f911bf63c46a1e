"""Rectangular coordinate systems (CORD2R), defined in one another down to the basic one."""

from dataclasses import dataclass

import numpy as np

from solver.aircraft.nastran_cards import Card
from solver.arrays import Array

_NAMES = ("A1", "A2", "A3", "B1", "B2", "B3", "C1", "C2", "C3")


@dataclass(slots=True)
class CoordinateSystem:
    """Origin and axes in basic components."""

    origin: Array  #: (3,)
    axes: Array  #: (3, 3) columns are the axes

    def position(self, local: Array) -> Array:
        """Turn coordinates in this system into basic ones."""
        return np.asarray(self.origin + self.axes @ local)


def coordinate_systems(cards: list[Card]) -> dict[int, CoordinateSystem]:
    """All systems by identifier; 0 is the basic one.

    Raises
    ------
    ModelError
        A system is defined twice, on itself, on one that is missing, or by points in a line.
    """
    known = {0: CoordinateSystem(np.zeros(3), np.eye(3))}
    waiting: dict[int, Card] = {}
    for card in cards:
        card.refuse_beyond(11)
        identifier = card.integer(0, "CID")
        if identifier in waiting:
            raise card.error("is defined twice")
        waiting[identifier] = card
    while waiting:
        ready = [k for k, card in waiting.items() if card.integer(1, "RID", 0, minimum=0) in known]
        if not ready:
            identifier, card = next(iter(waiting.items()))
            raise card.error(f"field RID = {card.text(1)} is missing or leads back to {identifier}")
        for identifier in ready:
            card = waiting.pop(identifier)
            known[identifier] = _system(card, known[card.integer(1, "RID", 0, minimum=0)])
    return known


def _system(card: Card, reference: CoordinateSystem) -> CoordinateSystem:
    """System from its origin A, a point B on its z axis and a point C in its x-z plane."""
    values = [card.real(2 + k, name, 0.0) for k, name in enumerate(_NAMES)]
    a, b, c = (reference.position(np.array(values[k : k + 3])) for k in (0, 3, 6))
    z, in_plane = b - a, c - a
    y = np.cross(z, in_plane)
    if np.linalg.norm(y) <= 1e-9 * np.linalg.norm(z) * np.linalg.norm(in_plane):
        raise card.error("points A, B and C lie in one line")
    z /= np.linalg.norm(z)
    y /= np.linalg.norm(y)
    return CoordinateSystem(a, np.column_stack([np.cross(y, z), y, z]))
