"""Large-rotation statics of shells and beams with published or closed solutions.

Sources.  K. Y. Sze, X. H. Liu, S. H. Lo, Popular benchmark problems for geometric nonlinear
analysis of shells, Finite Elements in Analysis and Design 40, 2004, 1551-1569.  K.-J. Bathe,
S. Bolourchi, Large displacement analysis of three-dimensional beam structures, Int. J. Num. Meth.
Eng. 14, 1979, 961-986.  J. C. Simo, L. Vu-Quoc, A three-dimensional finite-strain rod model, part
II, Comp. Meth. Appl. Mech. Eng. 58, 1986, 79-116.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.fe.model import BeamProperty
from solver.nonlinear.static import equilibrium_path
from solver.nonlinear.structure import nonlinear_structure
from verification.elements import meshes

#: Tip of the strip under an end shear of 4 (Sze et al. 2004, table 1): back and up.
SHEARED_STRIP = (3.286, 6.698)
#: End moment that bends the other strip to a full circle: 2 pi E I / L.
FULL_CIRCLE = 50.0 * np.pi / 3.0
#: Tip of the bend under 600 (Bathe and Bolourchi 1979), as quoted by Simo and Vu-Quoc 1986.
BEND = (15.8, 47.2, 53.4)
#: Annular plate slit along a radius under a line load of 0.8 (Sze et al. 2004, table 3): rise of
#: the inner and of the outer corner of the loaded edge.
SLIT_PLATE = (13.891, 17.528)


@dataclass(frozen=True, slots=True)
class LoadedStrip:
    """Where the tip of a strip went at every load level."""

    levels: Array  #: (k,)
    back: Array  #: (k,) towards the support
    up: Array  #: (k,)
    iterations: int


def sheared_strip(along: int, triangular: bool = False, levels: int = 10) -> LoadedStrip:
    """Cantilever strip 10 x 1 x 0.1, E 1.2e6, no Poisson effect, end shear up to 4."""
    return _strip(10.0, along, triangular, component=2, size=4.0, levels=levels)


def rolled_strip(along: int, triangular: bool = False, levels: int = 20) -> LoadedStrip:
    """Cantilever strip 12 x 1 x 0.1, E 1.2e6, end moment up to 50 pi / 3."""
    return _strip(12.0, along, triangular, component=3, size=FULL_CIRCLE, levels=levels)


def _strip(
    length: float, along: int, triangular: bool, component: int, size: float, levels: int
) -> LoadedStrip:
    substance = meshes.material(1.2e6, 0.0, 1.0)
    model = meshes.plate(1.0, length, 1, along, triangular, thickness=0.1, substance=substance)
    edges = meshes.grid_nodes(1, along)
    fixed = np.zeros((model.node_count, 6), dtype=bool)
    fixed[edges[0]] = True
    loads = np.zeros((model.node_count, 6))
    loads[edges[-1], component] = size / 2
    path = equilibrium_path(
        nonlinear_structure(model), fixed, loads, np.linspace(0.0, 1.0, levels + 1)[1:]
    )
    tip = path.positions[:, edges[-1]].mean(axis=1) - model.coordinates[edges[-1]].mean(axis=0)
    return LoadedStrip(path.levels, -tip[:, 1], tip[:, 2], path.iterations)


def bend(count: int, levels: int = 10) -> Array:
    """Tip (3,) of a 45-degree bend of radius 100, 1 x 1, E 1e7, loaded by 600 out of its plane.

    Given as Bathe and Bolourchi do: x away from the support's centre of curvature, y along the
    support's tangent, z with the load.
    """
    angle = np.linspace(0.0, np.pi / 4, count + 1)
    points = 100.0 * np.stack([np.sin(angle), 1.0 - np.cos(angle), 0.0 * angle], axis=1)
    section = BeamProperty(
        1, 1, 1.0, 1 / 12, 1 / 12, 1 / 6, np.zeros((4, 2)), 0.0, shear_factor_1=5 / 6,
        shear_factor_2=5 / 6,
    )  # fmt: skip
    model = meshes.beam_chain(
        points, section, orientation=(0.0, 0.0, 1.0), substance=meshes.material(1e7, 0.0, 1.0)
    )
    fixed = np.zeros((count + 1, 6), dtype=bool)
    fixed[0] = True
    loads = np.zeros((count + 1, 6))
    loads[-1, 2] = 600.0
    path = equilibrium_path(
        nonlinear_structure(model), fixed, loads, np.linspace(0.0, 1.0, levels + 1)[1:]
    )
    x, y, z = path.positions[-1, -1]
    return np.array([y, x, z])


def slit_plate(across: int, around: int) -> tuple[float, float]:
    """Rise of the inner and outer corner of a slit annular plate's loaded edge.

    Radii 6 and 10, thickness 0.03, E 21e6, no Poisson effect; one edge of the slit is clamped, the
    other carries a lift of 0.8 for each unit of its length.
    """
    model = meshes.surface(
        lambda s, t: np.stack(
            [
                (6.0 + 4.0 * s) * np.cos(2 * np.pi * t),
                (6.0 + 4.0 * s) * np.sin(2 * np.pi * t),
                0.0 * s,
            ],
            axis=-1,
        ),
        across,
        around,
        thickness=0.03,
        substance=meshes.material(21e6, 0.0, 1.0),
    )
    edges = meshes.grid_nodes(across, around)
    fixed = np.zeros((model.node_count, 6), dtype=bool)
    fixed[edges[0]] = True
    shares = np.full(across + 1, 4.0 / across)
    shares[[0, -1]] /= 2
    loads = np.zeros((model.node_count, 6))
    loads[edges[-1], 2] = 0.8 * shares
    # limp at first, where small loads turn it far
    rising = np.concatenate([np.linspace(0.01, 0.1, 8), np.linspace(0.16, 1.0, 15)])
    path = equilibrium_path(nonlinear_structure(model), fixed, loads, rising)
    inner, outer = path.positions[-1, edges[-1][[0, -1]], 2]
    return float(inner), float(outer)
