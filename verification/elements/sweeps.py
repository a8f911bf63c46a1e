"""Benchmarks over a range of meshes: the error that is left against elements per side."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from verification.elements import cantilevers, curved_shells
from verification.elements.figures import Figure


@dataclass(frozen=True, slots=True)
class Case:
    """A benchmark that can be meshed more and more finely."""

    title: str
    side: str  #: along which elements are counted
    coarsest: int  #: elements along that side
    extra: int  #: doublings beyond those of the other cases
    solve: Callable[[int, bool], Figure]  #: from elements along the side, triangles or not


@dataclass(frozen=True, slots=True)
class Sweep:
    """One benchmark on meshes of growing density, of quadrilaterals and of triangles."""

    case: Case
    densities: Array  #: (k,) elements along the side that counts
    quads: tuple[Figure, ...]
    triangles: tuple[Figure, ...]

    def errors(self, triangular: bool) -> Array:
        """Absolute error (k,) relative to the published figure."""
        figures = self.triangles if triangular else self.quads
        return np.array([abs(figure.ratio - 1) for figure in figures])


CASES = (
    Case("Scordelis-Lo roof", "a quarter's side", 4, 0, curved_shells.scordelis_lo),
    Case("pinched cylinder", "an eighth's side", 4, 0, curved_shells.pinched_cylinder),
    Case("hemisphere with hole", "a quarter's side", 4, 0, curved_shells.hemisphere),
    Case(
        "Raasch hook",
        "the second arc",
        9,
        0,
        lambda d, tri: curved_shells.raasch_hook(max(2, d * 5 // 36), d, tri),
    ),
    Case(
        "thin twisted beam, in-plane load",
        "the length",
        12,
        0,
        lambda d, tri: cantilevers.twisted_beam(d // 6, d, tri, thin=True)[0],
    ),
    Case(
        "straight beam of trapezoids, in-plane load",
        "the length",
        6,
        1,
        lambda d, tri: cantilevers.straight_cantilever("trapezoidal", tri, d // 6)[1],
    ),
)


def sweep(case: Case, meshes: int) -> Sweep:
    """Solve a case on ``meshes`` meshes, each with twice the density of the one before."""
    densities = [case.coarsest * 2**k for k in range(meshes + case.extra)]
    return Sweep(
        case,
        np.array(densities, dtype=np.float64),
        tuple(case.solve(density, False) for density in densities),
        tuple(case.solve(density, True) for density in densities),
    )
