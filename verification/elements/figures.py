"""A computed value beside its published one, and how a line load meets the nodes of an edge."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array, IntArray
from solver.fe.structure import Structure


@dataclass(frozen=True, slots=True)
class Figure:
    """A computed value beside its published one."""

    case: str
    computed: float
    target: float

    @property
    def ratio(self) -> float:
        """Computed over published."""
        return self.computed / self.target


def edge_loads(structure: Structure, edge: IntArray, component: int, total: float) -> Array:
    """Line load on an edge of equally spaced nodes, half shares at its ends."""
    loads = np.zeros((structure.model.node_count, 6))
    weight = np.ones(len(edge))
    weight[[0, -1]] = 0.5
    loads[edge, component] = total * weight / weight.sum()
    return loads
