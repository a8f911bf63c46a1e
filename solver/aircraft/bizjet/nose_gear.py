"""Nose gear attachment: keel webs, frames under the floor, and the four pins.

The trunnion turns between two keel webs; the two drag braces end on the same webs further aft.
"""

import numpy as np

from solver.aircraft.bizjet import dimensions as dim
from solver.aircraft.bizjet.divisions import Divisions
from solver.aircraft.bizjet.fuselage import Fuselage
from solver.aircraft.bizjet.main_gear import PinNode
from solver.aircraft.bizjet.mesh import Mesh
from solver.arrays import Array, BoolArray, IntArray

#: Half the length of a lug's footprint along the web [m].
FOOTPRINT = 0.30


def build_nose_gear(mesh: Mesh, divisions: Divisions, fuselage: Fuselage) -> list[PinNode]:
    """Add the nose gear bay; returns port and starboard trunnion, port and starboard brace."""
    first = fuselage.stations.index(dim.FORWARD_PRESSURE_BULKHEAD)
    last = fuselage.stations.index(dim.NOSE_END)
    heights = 2 * divisions.subdivisions
    x = fuselage.stations.positions[first : last + 1]
    track = fuselage.angles.index(dim.KEEL_WEB)
    trunnions, braces = [], []
    for side, name in ((-1, "port"), (1, "starboard")):
        column = fuselage.floor_half + side * track
        lower = mesh.points(fuselage.nodes[first : last + 1, fuselage.keel_column(column)])
        upper = mesh.points(fuselage.floor[first : last + 1, column])
        share = np.linspace(0, 1, heights + 1)[:, None]
        web = mesh.grid(lower[:, None] + share * (upper - lower)[:, None])
        _web(mesh, web, x)
        for path, direction, label in ((web[:, 0], 1.0, "lower"), (web[:, -1], -1.0, "upper")):
            mesh.stiffener(path, "nose gear bay stiffeners", lambda p, s=label: f"{s} {_part(p)}",  # type: ignore[misc]
                           [0.0, 0.0, direction], 0.02)  # fmt: skip
        for station in (dim.NOSE_TRUNNION_STATION, dim.NOSE_BRACE_STATION):
            i = int(np.abs(x - station).argmin())
            mesh.stiffener(web[i], "nose gear bay stiffeners", f"post {station:.2f}",
                           [1.0, 0.0, 0.0], 0.0)  # fmt: skip
        half = heights // 2
        y = float(dim.fuselage_radius(dim.NOSE_TRUNNION_STATION) * np.sin(dim.KEEL_WEB)) * side
        trunnions.append(
            _pin(mesh, f"{name} trunnion", (dim.NOSE_TRUNNION_STATION, y, dim.NOSE_PIVOT[2]),
                 web[_footprint(x, dim.NOSE_TRUNNION_STATION), : half + 1])
        )  # fmt: skip
        y = float(dim.fuselage_radius(dim.NOSE_BRACE_STATION) * np.sin(dim.KEEL_WEB)) * side
        braces.append(
            _pin(mesh, f"{name} drag brace", (dim.NOSE_BRACE_STATION, y, 1.46),
                 web[_footprint(x, dim.NOSE_BRACE_STATION), half:])
        )  # fmt: skip
    _frames(mesh, fuselage, heights)
    return trunnions + braces


def _footprint(x: Array, station: float) -> BoolArray:
    """Stations under a lug, never fewer than two bays."""
    distance = np.abs(x - station)
    return np.asarray(distance <= max(FOOTPRINT, float(np.sort(distance)[2])) + 1e-6)


def _part(point: Array) -> str:
    if point[0] < dim.NOSE_TRUNNION_STATION - FOOTPRINT:
        return "forward"
    if point[0] < dim.NOSE_BRACE_STATION - FOOTPRINT:
        return "trunnion"
    return "brace" if point[0] < dim.NOSE_BRACE_STATION + FOOTPRINT else "aft"


def _pin(mesh: Mesh, name: str, point: tuple[float, float, float], lug: IntArray) -> PinNode:
    row = mesh.free_node(*point)
    mesh.interpolated.append((row, sorted({int(node) for node in lug.ravel()})))
    return PinNode(name, row)


def _web(mesh: Mesh, web: IntArray, x: Array) -> None:
    for i in range(len(x) - 1):
        middle = x[i : i + 2].mean()
        near = min(abs(middle - dim.NOSE_TRUNNION_STATION), abs(middle - dim.NOSE_BRACE_STATION))
        family = "nose gear fitting" if near < FOOTPRINT else "nose gear bay webs"
        mesh.shells(web[i : i + 2], family, _part)


def _frames(mesh: Mesh, fuselage: Fuselage, heights: int) -> None:
    """Webs across the fuselage under the floor; open between the keel webs where the leg folds."""
    track = fuselage.angles.index(dim.KEEL_WEB)
    edge = fuselage.floor_half
    share = np.linspace(0, 1, heights + 1)[:, None]
    for station, open_between in (
        (dim.NOSE_TRUNNION_STATION, True),
        (dim.NOSE_BRACE_STATION, False),
        (dim.NOSE_END, False),
    ):
        i = fuselage.stations.index(station)
        columns = range(2 * edge + 1)
        lower = mesh.points(fuselage.nodes[i, [fuselage.keel_column(c) for c in columns]])
        upper = mesh.points(fuselage.floor[i])
        web = mesh.grid(lower[:, None] + share * (upper - lower)[:, None])
        parts = [web[: edge - track + 1], web[edge + track :]]
        if not open_between:
            parts.append(web[edge - track : edge + track + 1])
        for part in parts:
            mesh.shells(part, "nose gear frames", f"station {station:.2f}")
