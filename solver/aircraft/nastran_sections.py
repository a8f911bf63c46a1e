"""Cross-sections of PBARL: area, second moments, torsion, shear factors and stress points.

Seen from end A, element y points up and z to the right.  Stress points are the extreme fibres:
C upper right, D lower right, E lower left, F upper left (circles: C top, D right, E bottom,
F left).  Sections are made of rectangles, so area and second moments are exact; torsion is
Saint-Venant's: exact for bars, rods and tubes, Bredt's thin wall for boxes, the sum of b t^3 / 3
for open sections.  Only sections with a plane of symmetry are known: others (L, Z) have a product
of inertia, which the beam element does not model.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.errors import ModelError
from solver.fe.model import BeamProperty


@dataclass(frozen=True, slots=True)
class CrossSection:
    """Section figures about the centroid; see `solver.fe.model.BeamProperty`."""

    area: float
    inertia_1: float
    inertia_2: float
    torsion_constant: float
    torsion_radius: float
    shear_factor_1: float
    shear_factor_2: float
    stress_points: Array  #: (4, 2) y, z of C, D, E, F


@dataclass(frozen=True, slots=True)
class _Rectangle:
    """Part of a section: width along z, height along y, centre."""

    width: float
    height: float
    y: float
    z: float = 0.0


def section_property(
    identifier: int,
    material: int,
    shape: str,
    dimensions: Sequence[float],
    nonstructural_mass: float = 0.0,
) -> BeamProperty:
    """Beam property of a named cross-section (PBARL).

    Parameters
    ----------
    shape : str
        One of ``SHAPES``.
    dimensions : sequence of float
        DIM1, DIM2, ... of the Quick Reference Guide [m].
    nonstructural_mass : float
        [kg/m].

    Raises
    ------
    ModelError
        Unknown shape, wrong number of dimensions, or dimensions that do not close a section.
    """
    if shape not in SHAPES:
        raise ModelError(f"cross-section {shape!r} is not supported, only {', '.join(SHAPES)}")
    names, figures = SHAPES[shape]
    if len(dimensions) != len(names):
        raise ModelError(f"{shape} needs {len(names)} dimensions, has {len(dimensions)}")
    for number, value in enumerate(dimensions, 1):
        if not (value > 0.0 and math.isfinite(value)):
            raise ModelError(f"{shape} DIM{number} = {value} must be above zero")
    section = figures(*dimensions)
    return BeamProperty(
        identifier=identifier,
        material=material,
        area=section.area,
        inertia_1=section.inertia_1,
        inertia_2=section.inertia_2,
        torsion_constant=section.torsion_constant,
        stress_points=section.stress_points,
        torsion_radius=section.torsion_radius,
        shear_factor_1=section.shear_factor_1,
        shear_factor_2=section.shear_factor_2,
        nonstructural_mass=nonstructural_mass,
        shape=shape,
        dimensions=tuple(dimensions),
    )


def rectangle_torsion(width: float, height: float) -> tuple[float, float]:
    """Torsion constant [m4] and stress radius J tau / T [m] of a solid rectangle.

    Notes
    -----
    Timoshenko & Goodier, Theory of Elasticity, article 109: series over odd n, which falls off as
    n^-5 for the constant and faster than any power for the stress at the middle of the long side.
    """
    long, short = max(width, height), min(width, height)
    ratio = long / short
    odd = np.arange(1, 400, 2)
    angle = odd * math.pi * ratio / 2
    series = float(np.sum(np.tanh(angle) / odd**5))
    constant = long * short**3 / 3 * (1 - 192 / math.pi**5 / ratio * series)
    decay = float(np.sum(2 * np.exp(-angle) / (1 + np.exp(-2 * angle)) / odd**2))
    return constant, short * (1 - 8 / math.pi**2 * decay)


def _rod(radius: float) -> CrossSection:
    return _round(radius, 0.0, 0.9)


def _tube(outer: float, inner: float) -> CrossSection:
    if inner >= outer:
        raise ModelError(f"TUBE: inner radius {inner} must be less than the outer {outer}")
    return _round(outer, inner, 0.5)


def _round(outer: float, inner: float, shear_factor: float) -> CrossSection:
    inertia = math.pi / 4 * (outer**4 - inner**4)
    return CrossSection(
        area=math.pi * (outer**2 - inner**2),
        inertia_1=inertia,
        inertia_2=inertia,
        torsion_constant=2 * inertia,
        torsion_radius=outer,
        shear_factor_1=shear_factor,
        shear_factor_2=shear_factor,
        stress_points=np.array([[outer, 0.0], [0.0, outer], [-outer, 0.0], [0.0, -outer]]),
    )


def _bar(width: float, height: float) -> CrossSection:
    constant, radius = rectangle_torsion(width, height)
    return _composed(
        [_Rectangle(width, height, 0.0)],
        [(height / 2, width / 2), (-height / 2, width / 2)],
        constant, radius, 5 / 6, 5 / 6,
    )  # fmt: skip


def _box(width: float, height: float, flange: float, web: float) -> CrossSection:
    if 2 * web >= width or 2 * flange >= height:
        raise ModelError(f"BOX {width} x {height}: walls {flange} and {web} fill it")
    inner_width, inner_height = width - 2 * web, height - 2 * flange
    area = width * height - inner_width * inner_height
    enclosed = (width - web) * (height - flange)  # within the middle of the walls
    constant = 4 * enclosed**2 / (2 * (width - web) / flange + 2 * (height - flange) / web)
    return _composed(
        [
            _Rectangle(width, flange, (height - flange) / 2),
            _Rectangle(width, flange, (flange - height) / 2),
            _Rectangle(web, inner_height, 0.0, (width - web) / 2),
            _Rectangle(web, inner_height, 0.0, (web - width) / 2),
        ],
        [(height / 2, width / 2), (-height / 2, width / 2)],
        constant,
        constant / (2 * enclosed * min(flange, web)),
        2 * web * inner_height / area,
        2 * flange * inner_width / area,
    )


def _i(
    height: float, lower: float, upper: float, web: float, lower_flange: float, upper_flange: float
) -> CrossSection:
    depth = height - lower_flange - upper_flange
    if depth <= 0 or web > min(lower, upper):
        raise ModelError(f"I of height {height}: flanges or web {web} do not fit")
    parts = [
        _Rectangle(lower, lower_flange, lower_flange / 2),
        _Rectangle(web, depth, lower_flange + depth / 2),
        _Rectangle(upper, upper_flange, height - upper_flange / 2),
    ]
    area = _area(parts)
    return _composed(
        parts,
        [(height, upper / 2), (0.0, lower / 2)],
        (lower * lower_flange**3 + depth * web**3 + upper * upper_flange**3) / 3,
        max(web, lower_flange, upper_flange),
        web * depth / area,
        5 / 6 * (lower * lower_flange + upper * upper_flange) / area,
    )


def _t(width: float, height: float, flange: float, web: float) -> CrossSection:
    depth = height - flange
    if depth <= 0 or web > width:
        raise ModelError(f"T of height {height}: flange {flange} or web {web} do not fit")
    parts = [
        _Rectangle(width, flange, height - flange / 2),
        _Rectangle(web, depth, depth / 2),
    ]
    area = _area(parts)
    return _composed(
        parts,
        [(height, width / 2), (0.0, web / 2)],
        (width * flange**3 + depth * web**3) / 3,
        max(web, flange),
        web * depth / area,
        5 / 6 * width * flange / area,
    )


def _channel(width: float, height: float, web: float, flange: float) -> CrossSection:
    depth = height - 2 * flange
    if depth <= 0 or web >= width:
        raise ModelError(f"CHAN of height {height}: flanges {flange} or web {web} do not fit")
    # the web stands on the left, the flanges point to the right
    parts = [
        _Rectangle(width, flange, height - flange / 2, width / 2),
        _Rectangle(web, depth, height / 2, web / 2),
        _Rectangle(width, flange, flange / 2, width / 2),
    ]
    area = _area(parts)
    return _composed(
        parts,
        [(height, width), (0.0, width), (0.0, 0.0), (height, 0.0)],
        (2 * width * flange**3 + depth * web**3) / 3,
        max(web, flange),
        web * depth / area,
        2 * flange * (width - web) / area,
    )


def _hat(height: float, wall: float, width: float, lip: float) -> CrossSection:
    depth = height - 2 * wall
    if depth <= 0 or 2 * wall >= width:
        raise ModelError(f"HAT {width} x {height}: wall {wall} does not fit")
    arm = (width - wall) / 2
    reach = width / 2 + lip
    parts = [
        _Rectangle(width, wall, height - wall / 2),
        _Rectangle(wall, depth, height / 2, arm),
        _Rectangle(wall, depth, height / 2, -arm),
        _Rectangle(lip + wall, wall, wall / 2, reach - (lip + wall) / 2),
        _Rectangle(lip + wall, wall, wall / 2, (lip + wall) / 2 - reach),
    ]
    area = _area(parts)
    return _composed(
        parts,
        [(height, width / 2), (0.0, reach)],
        area * wall**2 / 3,
        wall,
        2 * wall * depth / area,
        (width + 2 * lip) * wall / area,
    )


def _area(parts: Sequence[_Rectangle]) -> float:
    return sum(part.width * part.height for part in parts)


def _composed(
    parts: Sequence[_Rectangle],
    points: Sequence[tuple[float, float]],
    torsion_constant: float,
    torsion_radius: float,
    shear_factor_1: float,
    shear_factor_2: float,
) -> CrossSection:
    """Rectangles put together; two ``points`` on the right are mirrored to the left."""
    area = _area(parts)
    y = sum(part.width * part.height * part.y for part in parts) / area
    z = sum(part.width * part.height * part.z for part in parts) / area
    if len(points) == 2:
        (top, top_right), (bottom, bottom_right) = points
        points = [*points, (bottom, -bottom_right), (top, -top_right)]
    return CrossSection(
        area=area,
        inertia_1=sum(
            part.width * part.height * (part.height**2 / 12 + (part.y - y) ** 2) for part in parts
        ),
        inertia_2=sum(
            part.width * part.height * (part.width**2 / 12 + (part.z - z) ** 2) for part in parts
        ),
        torsion_constant=torsion_constant,
        torsion_radius=torsion_radius,
        shear_factor_1=shear_factor_1,
        shear_factor_2=shear_factor_2,
        stress_points=np.array(points, dtype=float) - [y, z],
    )


#: Supported shapes: names of DIM1, DIM2, ... and the function of them.
SHAPES: dict[str, tuple[tuple[str, ...], Callable[..., CrossSection]]] = {
    "ROD": (("radius",), _rod),
    "TUBE": (("outer radius", "inner radius"), _tube),
    "BAR": (("width", "height"), _bar),
    "BOX": (("width", "height", "flange thickness", "web thickness"), _box),
    "I": (
        ("height", "lower width", "upper width", "web", "lower flange", "upper flange"),
        _i,
    ),
    "T": (("width", "height", "flange thickness", "web thickness"), _t),
    "CHAN": (("width", "height", "web thickness", "flange thickness"), _channel),
    "HAT": (("height", "thickness", "top width", "lip width"), _hat),
}
