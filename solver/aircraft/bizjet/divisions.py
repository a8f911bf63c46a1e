"""How finely the example aircraft is meshed.

A refinement below 1 has fewer, wider bays (for fast tests).  From 1 upwards the structure stays
the same and every bay is divided ``subdivisions`` times in both directions (for scaling studies).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from solver.arrays import Array, BoolArray
from solver.errors import ModelError


@dataclass(frozen=True, slots=True)
class Lines:
    """Positions of mesh lines; frames, ribs or stringers lie on the ``structural`` ones."""

    positions: Array  #: (n,) ascending
    structural: BoolArray  #: (n,)

    def index(self, position: float) -> int:
        """Which line lies at ``position``."""
        found = int(np.abs(self.positions - position).argmin())
        if abs(self.positions[found] - position) > 1e-9:
            raise ModelError(f"no mesh line at {position}")
        return found


@dataclass(frozen=True, slots=True)
class Divisions:
    """Numbers of divisions at one refinement."""

    refinement: float

    def __post_init__(self) -> None:
        if not 0.2 <= self.refinement <= 8:
            raise ModelError(f"refinement {self.refinement} must lie in 0.2 to 8")

    @property
    def subdivisions(self) -> int:
        """Elements along each side of a structural bay."""
        return max(1, round(self.refinement))

    def bays(self, count: int) -> int:
        """Structural bays where the full structure has ``count``."""
        return max(1, round(count * min(self.refinement, 1.0)))

    def elements(self, count: int) -> int:
        """Elements where the full structure has ``count`` bays."""
        return self.bays(count) * self.subdivisions

    def lines(self, keys: Sequence[float], counts: Sequence[int]) -> Lines:
        """Lines through all ``keys``, with ``counts`` bays between one key and the next."""
        parts, marks = [np.array(keys[:1], dtype=float)], [np.array([True])]
        for start, end, count in zip(keys[:-1], keys[1:], counts, strict=True):
            elements = self.elements(count)
            parts.append(np.linspace(start, end, elements + 1)[1:])
            marks.append(np.arange(1, elements + 1) % self.subdivisions == 0)
        return Lines(np.concatenate(parts), np.concatenate(marks))
