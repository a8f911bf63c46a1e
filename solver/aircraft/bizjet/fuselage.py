"""Fuselage: skin, frames, stringers, bulkheads and cabin floor.

The section is circular but for the lower lobe over the wing, which is drawn down to the centre
box: there the box's lower skin closes the fuselage and its upper skin is the floor.
"""

import math
from dataclasses import dataclass

import numpy as np

from solver.aircraft.bizjet import dimensions as dim
from solver.aircraft.bizjet.divisions import Divisions, Lines
from solver.aircraft.bizjet.mesh import Mesh
from solver.arrays import Array, IntArray

#: Length over which the lower lobe passes from the circle to the centre box, ahead of it [m].
BLEND = 0.70


@dataclass(frozen=True, slots=True)
class Fuselage:
    """Rows of the fuselage's nodes and where its lines are."""

    stations: Lines
    angles: Lines  #: from the keel to the crown, one half
    nodes: IntArray  #: (n_stations, 2 n_angles - 1), port crown over keel to starboard crown
    floor: IntArray  #: (n_stations, 2 n_floor + 1), port to starboard edge
    box: slice  #: stations from front to rear spar
    cabin: slice  #: stations from pressure bulkhead to pressure bulkhead

    @property
    def crown(self) -> int:
        """Index of the crown among the half angles; also column of the keel in ``nodes``."""
        return len(self.angles.positions) - 1

    def column(self, angle: float, side: int) -> int:
        """Column of ``nodes`` at an angle from the keel on one side (-1 port, +1 starboard)."""
        return self.crown + side * self.angles.index(angle)

    @property
    def floor_half(self) -> int:
        """Number of floor cells on one side."""
        return (int(self.floor.shape[1]) - 1) // 2

    def keel_column(self, column: int) -> int:
        """Column of ``nodes`` straight below a column of ``floor``."""
        return self.crown + column - self.floor_half


def section_points(stations: Array, angles: Array) -> Array:
    """Points of the skin, (n_stations, n_angles, 3); negative angles are to port."""
    x, angle = np.meshgrid(stations, angles, indexing="ij")
    radius, axis = dim.fuselage_radius(x), dim.fuselage_axis(x)
    y, z = radius * np.sin(angle), axis - radius * np.cos(angle)
    front, rear = dim.centre_box_stations(1)
    ahead = np.clip((front - x) / BLEND, 0, 1)
    behind = np.clip((x - rear) / (dim.GEAR_BEAM_STATION - rear), 0, 1)
    share = np.where(np.abs(angle) < dim.FLOOR - 1e-9, 1 - ahead - behind, 0.0)
    return np.stack([x, y, (1 - share) * z + share * dim.wing_lower_at_body(x)], axis=-1)


def build_fuselage(mesh: Mesh, divisions: Divisions) -> Fuselage:
    """Add the fuselage to the mesh."""
    front, rear = dim.centre_box_stations(1)
    stations = divisions.lines(
        [dim.NOSE_CAP, dim.FORWARD_PRESSURE_BULKHEAD, dim.NOSE_TRUNNION_STATION,
         dim.NOSE_BRACE_STATION, dim.NOSE_END, front, rear, dim.GEAR_BEAM_STATION,
         dim.TAIL_START, dim.PYLON_FRONT, dim.PYLON_REAR, dim.FIN_FRONT, dim.FIN_REAR,
         dim.TAIL_CAP],
        [3, 3, 2, 2, 18, 6, 3, 7, 2, 3, 3, 4, 5],
    )  # fmt: skip
    angles = divisions.lines(
        [0.0, dim.KEEL_WEB, dim.FLOOR, dim.PYLON_LOWER, dim.PYLON_UPPER, dim.FIN_ROOT, math.pi],
        [1, 3, 4, 1, 5, 1],
    )
    half = angles.positions
    points = section_points(stations.positions, np.concatenate([-half[:0:-1], half]))
    nodes = mesh.grid(points)
    nodes[:, 0] = nodes[:, -1]
    edge = angles.index(dim.FLOOR)
    keel = len(half) - 1
    flat = points[:, keel - edge : keel + edge + 1].copy()
    flat[..., 2] = flat[:, -1:, 2]
    # The floor's cross beams lie under it; its nodes at the edge are the skin's.
    floor = np.full(flat.shape[:2], -1, dtype=np.int64)
    cabin = slice(
        stations.index(dim.FORWARD_PRESSURE_BULKHEAD), stations.index(dim.AFT_PRESSURE_BULKHEAD) + 1
    )
    floor[cabin] = mesh.grid(flat[cabin])
    box = slice(stations.index(front), stations.index(rear) + 1)
    fuselage = Fuselage(stations, angles, nodes, floor, box, cabin)
    _skin(mesh, fuselage)
    _stiffeners(mesh, fuselage)
    _floor(mesh, fuselage)
    _bulkheads(mesh, fuselage, divisions)
    return fuselage


def part_of(station: float) -> str:
    """Forward, centre or aft fuselage, parted at the ends of metre-long bays."""
    if station < 8.0:
        return "forward"
    return "centre" if station < 12.0 else "aft"


def bay_label(point: Array) -> str:
    """Name of the metre-long bay and the sector (keel, side, crown) at a point."""
    radius = math.hypot(point[1], point[2] - float(dim.fuselage_axis(point[0])))
    height = (float(dim.fuselage_axis(point[0])) - point[2]) / max(radius, 1e-9)
    sector = "keel" if height > 0.6 else ("side" if height > -0.6 else "crown")
    return f"station {int(point[0]):02d} {sector}"


def inward(mesh: Mesh, rows: IntArray) -> Array:
    """Give unit vectors from skin nodes towards the fuselage's axis, (n, 3)."""
    points = mesh.points(rows)
    vectors = np.stack(
        [np.zeros(len(points)), -points[:, 1], dim.fuselage_axis(points[:, 0]) - points[:, 2]],
        axis=1,
    )
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1)[:, None])


def _skin(mesh: Mesh, fuselage: Fuselage) -> None:
    edge = fuselage.floor_half
    keel = fuselage.crown
    for i in range(len(fuselage.nodes) - 1):
        strip = fuselage.nodes[i : i + 2]
        middle = fuselage.stations.positions[i : i + 2].mean()
        family = f"fuselage skin {part_of(middle)}"
        if fuselage.box.start <= i < fuselage.box.stop - 1:
            mesh.shells(strip[:, : keel - edge + 1], family, bay_label)
            mesh.shells(strip[:, keel + edge :], family, bay_label)
        else:
            mesh.shells(strip, family, bay_label)


def _stiffeners(mesh: Mesh, fuselage: Fuselage) -> None:
    nodes, keel, edge = fuselage.nodes, fuselage.crown, fuselage.floor_half
    box = fuselage.box
    for i in np.flatnonzero(fuselage.stations.structural):
        family = f"fuselage frames {part_of(fuselage.stations.positions[i])}"
        open_below = box.start <= i < box.stop
        arcs = [nodes[i, : keel - edge + 1], nodes[i, keel + edge :]] if open_below else [nodes[i]]
        for arc in arcs:
            mesh.stiffener(arc, family, bay_label, inward(mesh, arc), 0.045)
    # Every third structural line carries a stringer, keel, floor edge and crown always.
    lines = np.flatnonzero(fuselage.angles.structural)
    always = [0, edge, keel, fuselage.angles.index(dim.KEEL_WEB)]
    chosen = sorted(set(lines[::3].tolist()) | set(always))
    for line in chosen:
        for column in sorted({keel - line, keel + line} - ({0} if line == keel else set())):
            below = line < edge
            pieces = (
                [nodes[: box.start + 1, column], nodes[box.stop - 1 :, column]]
                if below
                else [nodes[:, column]]
            )
            for piece in pieces:
                mesh.stiffener(piece, "fuselage stringers", bay_label, inward(mesh, piece), 0.018)


def _floor(mesh: Mesh, fuselage: Fuselage) -> None:
    box, cabin, floor = fuselage.box, fuselage.cabin, fuselage.floor

    def label(point: Array) -> str:
        return f"station {int(point[0]):02d}"

    mesh.shells(floor[cabin.start : box.start + 1], "cabin floor", label)
    mesh.shells(floor[box.stop - 1 : cabin.stop], "cabin floor", label)
    down = np.array([0.0, 0.0, -1.0])
    for i in np.flatnonzero(fuselage.stations.structural):
        if cabin.start <= i < cabin.stop and not box.start <= i < box.stop:
            mesh.stiffener(floor[i], "floor beams", label, down, 0.050)
    # Seat tracks run over the keel-web lines and, on the box, along its ribs.
    track = fuselage.angles.index(dim.KEEL_WEB)
    for column in (fuselage.floor_half - track, fuselage.floor_half + track):
        mesh.stiffener(floor[cabin.start : box.start + 1, column], "floor beams", label, down, 0.03)
        mesh.stiffener(floor[box.stop - 1 : cabin.stop, column], "floor beams", label, down, 0.03)


def _bulkheads(mesh: Mesh, fuselage: Fuselage, divisions: Divisions) -> None:
    for station, family in (
        (dim.NOSE_CAP, "nose and tail caps"),
        (dim.FORWARD_PRESSURE_BULKHEAD, "forward pressure bulkhead"),
        (dim.AFT_PRESSURE_BULKHEAD, "aft pressure bulkhead"),
        (dim.TAIL_CAP, "nose and tail caps"),
    ):
        _disc(mesh, fuselage, fuselage.stations.index(station), family, divisions)
    front, rear = dim.centre_box_stations(1)
    for station, family, depth in (
        (front, "wing frames", 0.14),
        (rear, "wing frames", 0.14),
        (dim.GEAR_BEAM_STATION, "wing frames", 0.14),
        (dim.PYLON_FRONT, "engine frames", 0.14),
        (dim.PYLON_REAR, "engine frames", 0.14),
        (dim.FIN_FRONT, "fin frames", 0.14),
        (dim.FIN_REAR, "fin frames", 0.12),
    ):
        _ring(mesh, fuselage, fuselage.stations.index(station), family, depth)


def _scaled(mesh: Mesh, fuselage: Fuselage, i: int, factors: Array) -> Array:
    """Points of section ``i`` drawn towards its centre, (n_factors, n_columns, 3)."""
    skin = mesh.points(fuselage.nodes[i])
    x = fuselage.stations.positions[i]
    centre = np.array([x, 0.0, float(dim.fuselage_axis(x))])
    return np.asarray(centre + factors[:, None, None] * (skin - centre))


def _disc(mesh: Mesh, fuselage: Fuselage, i: int, family: str, divisions: Divisions) -> None:
    count = divisions.elements(3)
    rings = mesh.grid(_scaled(mesh, fuselage, i, np.linspace(1.0, 0.0, count + 1)))
    rings[:, 0] = rings[:, -1]
    mesh.shells(rings, family, lambda point: bay_label(point).split()[2])
    forward = np.array([1.0, 0.0, 0.0])
    columns = fuselage.angles.structural.nonzero()[0]
    for line in columns[:: max(1, len(columns) // 4)]:
        for column in sorted({fuselage.crown - line, fuselage.crown + line} - {0}):
            mesh.stiffener(rings[:, column], "bulkhead stiffeners", family, forward, 0.03)


def _ring(mesh: Mesh, fuselage: Fuselage, i: int, family: str, depth: float) -> None:
    """Web of a deep frame with a flange along its inner edge."""
    factor = 1.0 - depth / float(dim.fuselage_radius(fuselage.stations.positions[i]))
    rings = mesh.grid(_scaled(mesh, fuselage, i, np.array([1.0, factor])))
    rings[1, 0] = rings[1, -1]
    keel, edge = fuselage.crown, fuselage.floor_half
    # Over the wing the web ends on the floor; the centre box goes on below.
    over_wing = family == "wing frames"
    arcs = [rings[:, : keel - edge + 1], rings[:, keel + edge :]] if over_wing else [rings]
    x = fuselage.stations.positions[i]
    for arc in arcs:
        web = arc
        if over_wing:
            web = _joined_to_floor(fuselage, i, arc)
        mesh.shells(web, family, lambda point: f"{x:.2f} {bay_label(point).split()[2]}")
        mesh.stiffener(
            web[1],
            f"fuselage frames {part_of(x)}",
            lambda point: f"inner cap {x:.2f} {bay_label(point).split()[2]}",
            inward(mesh, web[1]),
            0.0,
        )


def _joined_to_floor(fuselage: Fuselage, i: int, arc: IntArray) -> IntArray:
    """Make the web's inner corner at the floor edge the next floor node inboard."""
    edge = fuselage.floor_half
    web = arc.copy()
    if web[0, -1] == fuselage.floor[i, 0]:
        web[1, -1] = fuselage.floor[i, 1]
    else:
        web[1, 0] = fuselage.floor[i, 2 * edge - 1]
    return web
