"""A complete tiny aircraft for the tests: box wing, beam fuselage, plate tail, three gears.

Sizes, masses and gears are those of the example business jet; the mesh is as coarse as it can be
and still land.  ``write_mini_aircraft(folder)`` makes the pair that any aircraft consists of,
``definition.toml`` and ``airframe.bdf``.  Structural axes: x aft of the nose, y starboard, z up
from the ground.
"""

import math
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np

from solver.aircraft.nastran_sections import section_property
from solver.aircraft.nastran_writer import write_bulk_data
from solver.arrays import Array
from solver.fe.model import (
    Beams,
    FiniteElementModel,
    Interpolation,
    Material,
    PointMasses,
    RigidBody,
    ShellProperty,
    Shells,
)

DEFINITION = Path(__file__).with_name("mini_definition.toml")
EMPTY_MASS = 8235.0 - 2 * 95.0 - 28.0  #: without the unsprung masses [kg]
EMPTY_STATION = 10.02  #: centre of gravity of the empty airframe without unsprung masses [m]
TANK_CAPACITY = 2545.5
BAY_CAPACITY = 1200.0

#: Wing stations by the tens digit of their nodes' numbers: distance from the centre line [m].
STATIONS = {2: 0.9, 4: 1.2, 5: 1.5, 6: 1.8, 7: 3.4, 8: 5.5, 9: 9.65}
#: Corners of the wing box by the last digit: share of the chord, side of the middle plane.
CORNERS = {1: (0.15, -1.0), 2: (0.60, -1.0), 3: (0.15, 1.0), 4: (0.60, 1.0)}
FUSELAGE = [0.0, 1.0, 1.7, 2.7, 4.0, 5.5, 7.0, 8.84578, 10.40013, 12.0, 13.5, 14.5, 16.0, 18.2,
            19.35]  # fmt: skip
FRONT_SPAR, REAR_SPAR = 308, 309


def write_mini_aircraft(folder: Path) -> Path:
    """Write the aircraft's two files into ``folder`` (made if missing) and return it."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "definition.toml").write_bytes(DEFINITION.read_bytes())
    write_bulk_data(mini_model(), folder / "airframe.bdf", ["Mini jet, coarse test airframe"])
    return folder


def chord(span: float) -> tuple[float, float]:
    """Leading edge station and chord of the wing at a distance from the centre line [m]."""
    share = span / 9.65
    return 8.0701 + share * (10.8372 - 8.0701), 3.6768 + share * (1.2869 - 3.6768)


def wing_corner(span: float, side: float, corner: int) -> tuple[float, float, float]:
    leading_edge, length = chord(span)
    share, face = CORNERS[corner]
    height = 1.45 + math.tan(math.radians(3.0)) * span + face * 0.05 * length
    return leading_edge + share * length, side * span, height


class _Mesh:
    """Nodes and elements as they are put down, by number."""

    def __init__(self) -> None:
        self.nodes: dict[int, tuple[float, float, float]] = {}
        self.quads: list[tuple[int, list[int]]] = []
        self.beams: list[tuple[int, list[int], list[float], list[list[float]]]] = []
        self.masses: list[tuple[int, int, float, list[float], Array]] = []
        self.bodies: list[tuple[int, list[int]]] = []

    def mass(
        self, identifier: int, node: int, mass: float, up: float = 0.0, radius: float = 0.0
    ) -> None:
        """Lumped mass above its node, a ball of that radius of gyration."""
        self.masses.append((identifier, node, mass, [0.0, 0.0, up], mass * radius**2 * np.eye(3)))


@cache
def mini_model() -> FiniteElementModel:
    """The airframe with full tanks and bay, as its bulk data has it."""
    mesh = _Mesh()
    _wing(mesh)
    _fuselage(mesh)
    _tail(mesh)
    _loading(mesh)
    _systems(mesh)
    return _model(mesh)


def _wing(mesh: _Mesh) -> None:
    for corner in CORNERS:
        mesh.nodes[10 + corner] = wing_corner(0.0, 1.0, corner)
    for first, side, skin, spar, cap in ((100, -1.0, 10, 14, 12), (200, 1.0, 11, 15, 13)):
        inner = 10
        for tens, span in STATIONS.items():
            outer = first + 10 * tens
            for corner in CORNERS:
                mesh.nodes[outer + corner] = wing_corner(span, side, corner)
            for pair, section in (((1, 2), skin), ((3, 4), skin), ((1, 3), spar), ((2, 4), spar)):
                a, b = pair
                mesh.quads.append((section, [inner + a, inner + b, outer + b, outer + a]))
            mesh.quads.append((spar, [outer + 1, outer + 2, outer + 4, outer + 3]))
            for corner, inward in ((2, 0.02), (4, -0.02)):
                offset = [0.0, 0.0, inward]
                nodes = [inner + corner, outer + corner]
                mesh.beams.append((cap, nodes, [0.0, 0.0, 1.0], [offset, offset]))
            inner = outer
    mesh.quads.append((14, [11, 12, 14, 13]))


def _fuselage(mesh: _Mesh) -> None:
    for k, station in enumerate(FUSELAGE):
        mesh.nodes[301 + k] = (station, 0.0, 2.2)
    still = [[0.0] * 3, [0.0] * 3]
    for k in range(len(FUSELAGE) - 1):
        mesh.beams.append((40, [301 + k, 302 + k], [0.0, 0.0, 1.0], still))
    for spar, corners in ((FRONT_SPAR, (1, 3)), (REAR_SPAR, (2, 4))):
        mesh.bodies.append((spar, [root + c for root in (120, 220) for c in corners]))
    for number, above, side in ((901, 303, -1), (902, 303, 1), (903, 304, -1), (904, 304, 1)):
        mesh.nodes[number] = (mesh.nodes[above][0], 0.25 * side, 1.35)
        mesh.beams.append((51, [above, number], [1.0, 0.0, 0.0], still))
    mesh.quads.append((50, [901, 903, 904, 902]))


def _tail(mesh: _Mesh) -> None:
    for k, (x, z) in enumerate(
        [(16.0, 3.0), (18.2, 3.0), (16.6, 4.0), (18.4, 4.0), (17.4, 5.0), (18.6, 5.0)]
    ):
        mesh.nodes[401 + k] = (x, 0.0, z)
    mesh.quads += [(30, [401, 402, 404, 403]), (30, [403, 404, 406, 405])]
    mesh.bodies += [(313, [401]), (314, [402])]
    for k, y in enumerate([-3.0, -1.5, 0.0, 1.5, 3.0]):
        mesh.nodes[501 + 2 * k] = (18.0 + abs(y) / 7.5, y, 2.6)
        mesh.nodes[502 + 2 * k] = (19.0 + abs(y) / 15.0, y, 2.6)
        if k:
            mesh.quads.append((20, [499 + 2 * k, 500 + 2 * k, 502 + 2 * k, 501 + 2 * k]))
    mesh.bodies[-1][1].append(505)
    mesh.bodies.append((315, [506]))


def _loading(mesh: _Mesh) -> None:
    """Full tanks by box volume between the stations, full cabin, one CONM2 each."""
    spans = [STATIONS[tens] for tens in (4, 5, 6, 7, 8)]
    widths = np.diff([1.0, *((a + b) / 2 for a, b in pairwise(spans)), 8.6])
    volumes = [width * chord(span)[1] ** 2 for width, span in zip(widths, spans, strict=True)]
    for first, wing in ((7001, 100), (7101, 200)):
        number = first
        for tens, volume in zip((4, 5, 6, 7, 8), volumes, strict=True):
            for corner in CORNERS:
                mesh.mass(
                    number, wing + 10 * tens + corner, TANK_CAPACITY * volume / sum(volumes) / 4
                )
                number += 1
    for k, node in enumerate((305, 306, 307, 308)):
        mesh.mass(8001 + k, node, BAY_CAPACITY / 4, -0.5, 0.3)


def _systems(mesh: _Mesh) -> None:
    """Engines, upper struts, systems; furnishings fore and aft trim mass and centre of gravity."""
    for k, side in enumerate((-1, 1)):
        mesh.nodes[601 + k] = (14.5, 1.4 * side, 2.6)
        mesh.mass(9001 + k, 601 + k, 560.0, 0.05, 0.5)
    mesh.bodies.append((312, [601, 602]))
    mesh.nodes[603] = (9.7, 0.0, 1.5)
    mesh.mass(9003, 603, 400.0, 0.0, 0.7)
    for number, (node, mass) in enumerate(((142, 45.0), (242, 45.0), (901, 10.0), (902, 10.0))):
        mesh.mass(9011 + number, node, mass)
    model = _model(mesh)
    kept = model.point_masses.identifiers >= 9000
    mass, moment = _structural_mass(model)
    mass += float(model.point_masses.masses[kept].sum())
    places = model.coordinates[model.point_masses.nodes] + model.point_masses.offsets
    moment += float(model.point_masses.masses[kept] @ places[kept, 0])
    fore, aft = (304, 305, 306, 307), (309, 310, 311)
    centres = [float(np.mean([mesh.nodes[node][0] for node in group])) for group in (fore, aft)]
    needed = np.linalg.solve(
        [[1.0, 1.0], centres], [EMPTY_MASS - mass, EMPTY_MASS * EMPTY_STATION - moment]
    )
    for first, group, total in ((9101, fore, needed[0]), (9201, aft, needed[1])):
        assert total > 0.0
        for k, node in enumerate(group):
            mesh.mass(first + k, node, float(total) / len(group), -0.2, 0.4)


def _structural_mass(model: FiniteElementModel) -> tuple[float, float]:
    """Mass of skin and beams and its moment about the nose; trapezia by their two triangles."""
    mass = moment = 0.0
    for nodes, section in zip(model.quads.nodes, model.quads.properties, strict=True):
        a, b, c, d = model.coordinates[nodes]
        shell = model.shell_properties[int(section)]
        weight = shell.thickness * model.materials[shell.material].density
        for p, q, r in ((a, b, c), (a, c, d)):
            part = weight * float(np.linalg.norm(np.cross(q - p, r - p))) / 2
            mass, moment = mass + part, moment + part * float(p[0] + q[0] + r[0]) / 3
    for nodes, section in zip(model.beams.nodes, model.beams.properties, strict=True):
        a, b = model.coordinates[nodes]
        beam = model.beam_properties[int(section)]
        part = beam.area * model.materials[beam.material].density * float(np.linalg.norm(b - a))
        mass, moment = mass + part, moment + part * float(a[0] + b[0]) / 2
    return mass, moment


def _model(mesh: _Mesh) -> FiniteElementModel:
    identifiers = sorted(mesh.nodes)
    rows = {identifier: row for row, identifier in enumerate(identifiers)}

    def at(nodes: list[int]) -> Array:
        return np.array([rows[node] for node in nodes], dtype=np.int64)

    sheet, sandwich, bar = (
        Material(1, 72e9, 72e9 / 2.66, 0.33, 2780.0),
        Material(2, 5e9, 5e9 / 2.6, 0.3, 120.0),
        Material(3, 71e9, 71e9 / 2.66, 0.33, 2810.0),
    )
    thicknesses = {10: (1, 0.0030), 11: (1, 0.0030), 14: (1, 0.0060), 15: (1, 0.0060),
                   20: (2, 0.08), 30: (2, 0.1), 50: (1, 0.01)}  # fmt: skip
    sections = [
        section_property(12, 3, "T", [0.06, 0.05, 0.006, 0.006]),
        section_property(13, 3, "T", [0.06, 0.05, 0.006, 0.006]),
        section_property(40, 1, "TUBE", [0.9, 0.8975]),
        section_property(51, 3, "BOX", [0.1, 0.1, 0.008, 0.008]),
    ]
    none = np.empty((0, 3))
    return FiniteElementModel(
        node_identifiers=np.array(identifiers, dtype=np.int64),
        coordinates=np.array([mesh.nodes[identifier] for identifier in identifiers]),
        materials={material.identifier: material for material in (sheet, sandwich, bar)},
        shell_properties={k: ShellProperty(k, m, t) for k, (m, t) in thicknesses.items()},
        beam_properties={section.identifier: section for section in sections},
        quads=Shells(
            identifiers=np.arange(1, len(mesh.quads) + 1),
            nodes=np.array([at(nodes) for _, nodes in mesh.quads]),
            properties=np.array([section for section, _ in mesh.quads]),
        ),
        triangles=Shells(none[:, 0].astype(int), none.astype(int), none[:, 0].astype(int)),
        beams=Beams(
            identifiers=np.arange(1001, 1001 + len(mesh.beams)),
            nodes=np.array([at(nodes) for _, nodes, _, _ in mesh.beams]),
            properties=np.array([section for section, _, _, _ in mesh.beams]),
            orientations=np.array([vector for _, _, vector, _ in mesh.beams]),
            offsets=np.array([offsets for _, _, _, offsets in mesh.beams]),
        ),
        point_masses=PointMasses(
            identifiers=np.array([mass[0] for mass in mesh.masses]),
            nodes=at([mass[1] for mass in mesh.masses]),
            masses=np.array([mass[2] for mass in mesh.masses]),
            offsets=np.array([mass[3] for mass in mesh.masses]),
            inertias=np.array([mass[4] for mass in mesh.masses]),
        ),
        rigid_bodies=tuple(
            RigidBody(5001 + k, rows[independent], at(dependents))
            for k, (independent, dependents) in enumerate(mesh.bodies)
        ),
        interpolations=(
            Interpolation(
                5101,
                rows[603],
                at([141, 142, 143, 144, 241, 242, 243, 244]),
                np.ones(8),
            ),
        ),
    )
