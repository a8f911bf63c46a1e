"""Main gear attachment: gear beam, ribs and panels aft of the rear spar, and the three pins.

The trunnion turns between a pin on the rear spar and one on the gear beam, both held between two
ribs; the side brace ends on the rear spar next to the side of body.  Every pin is joined by an
interpolation to the whole footprint of its fitting, so that the footprint's area, not the mesh,
sets the local stress.  A trunnion housing is held by both ribs over a bay's length on either side:
drag enters the ribs in their plane and does not bend the spar web between them.
"""

from dataclasses import dataclass

import numpy as np

from solver.aircraft.bizjet import dimensions as dim
from solver.aircraft.bizjet.divisions import Divisions
from solver.aircraft.bizjet.fuselage import Fuselage
from solver.aircraft.bizjet.mesh import Mesh
from solver.aircraft.bizjet.wing import Wing, wing_label
from solver.arrays import Array, IntArray


@dataclass(frozen=True, slots=True)
class PinNode:
    """A pin's node in the mesh."""

    name: str
    row: int


def gear_beam_points(y: Array, heights: int) -> Array:
    """Points of the starboard gear beam, (n_span, heights + 1, 3)."""
    kink = dim.GEAR_RIBS[1]
    end = dim.GEAR_BEAM_END
    depth = float(dim.half_thickness(dim.REAR_SPAR) * dim.WING_THICKNESS * dim.wing_chord(end))
    spans = np.array([dim.SIDE_OF_BODY, kink, end])
    stations = [
        dim.GEAR_BEAM_STATION, dim.GEAR_BEAM_KINK_STATION, float(dim.wing_station(end, 0.6))
    ]  # fmt: skip
    middle = dim.wing_height(np.array([kink, end]))
    x = np.interp(y, spans, stations)
    upper = np.interp(y, spans, [dim.FLOOR_HEIGHT, middle[0] + 0.12, middle[1] + depth])
    lower = np.interp(y, spans, [dim.FLOOR_HEIGHT - 0.26, middle[0] - 0.12, middle[1] - depth])
    share = np.linspace(0, 1, heights + 1)
    z = lower[:, None] + share * (upper - lower)[:, None]
    return np.stack([np.broadcast_to(x[:, None], z.shape), np.broadcast_to(y[:, None], z.shape), z],
                    axis=-1)  # fmt: skip


def build_main_gear(
    mesh: Mesh, divisions: Divisions, fuselage: Fuselage, wing: Wing
) -> list[PinNode]:
    """Add one side's gear bay; returns its pins: forward trunnion, aft trunnion, side brace."""
    heights = 2 * divisions.subdivisions
    cells = divisions.elements(3)
    last = wing.span.index(dim.GEAR_BEAM_END)
    y = wing.span.positions[: last + 1]
    beam = gear_beam_points(y, heights)
    beam[..., 1] *= wing.side
    spar = mesh.points(wing.box[: last + 1, -1])
    share = np.linspace(0, 1, cells + 1)[:, None, None]
    points = spar[:, None] + share * (beam - spar)[:, None]
    ribs = {wing.span.index(rib) for rib in (*dim.GEAR_RIBS, dim.SIDE_OF_BODY)}
    bay = np.full(points.shape[:-1], -1, dtype=np.int64)
    for k in range(last + 1):
        if k in ribs:
            bay[k] = mesh.grid(points[k])
        else:
            bay[k][:, [0, -1]] = mesh.grid(points[k][:, [0, -1]])
            bay[k][[0, -1]] = mesh.grid(points[k][[0, -1]])
    _shells(mesh, wing, bay, ribs)
    _caps(mesh, wing, bay, ribs)
    _gear_bulkhead(mesh, fuselage, divisions, bay, wing.side)
    side = "port" if wing.side < 0 else "starboard"
    rib_in, rib_out = (wing.span.index(rib) for rib in dim.GEAR_RIBS)
    brace = wing.span.index(dim.BRACE_FITTING[1])
    height = dim.MAIN_PIVOT[2]
    y_pin = dim.MAIN_PIVOT[1] * wing.side
    stations = np.interp(dim.MAIN_PIVOT[1], y, beam[:, 0, 0])
    front = float(dim.wing_station(dim.MAIN_PIVOT[1], dim.REAR_SPAR))
    y_brace = sum(dim.BRACE_FITTING) / 2
    x_brace = float(dim.wing_station(y_brace, dim.REAR_SPAR))
    z_brace = float(mesh.points(wing.box[0 : brace + 1, -1])[..., 2].mean())
    sub = divisions.subdivisions
    ribs_of_box, ribs_of_bay = wing.box[[rib_in, rib_out]], bay[[rib_in, rib_out]]
    forward = np.hstack([ribs_of_box[:, -1 - sub :], ribs_of_bay[:, : sub + 1]])
    aft = ribs_of_bay[:, -1 - sub :]
    return [
        _pin(mesh, f"{side} trunnion forward", (front, y_pin, height), forward),
        _pin(mesh, f"{side} trunnion aft", (float(stations), y_pin, height), aft),
        _pin(
            mesh,
            f"{side} side brace",
            (x_brace, y_brace * wing.side, round(z_brace, 4)),
            wing.box[0 : brace + 1, -1],
        ),
    ]


def _pin(mesh: Mesh, name: str, point: tuple[float, float, float], lug: IntArray) -> PinNode:
    row = mesh.free_node(*point)
    mesh.interpolated.append((row, sorted({int(node) for node in lug.ravel()})))
    return PinNode(name, row)


def _shells(mesh: Mesh, wing: Wing, bay: IntArray, ribs: set[int]) -> None:
    rib_in, rib_out = (wing.span.index(rib) for rib in dim.GEAR_RIBS)
    for k in range(bay.shape[0] - 1):
        family = "main gear fitting" if rib_in <= k < rib_out else "main gear beam"
        mesh.shells(bay[k : k + 2, -1], family, lambda point: "beam " + wing_label(point)[:8])
        mesh.shells(bay[k : k + 2, :, -1], "main gear bay panels",
                    lambda point: "upper " + wing_label(point)[:8])  # fmt: skip
        # The well is open below, inboard of the leg; outboard a panel closes it.
        if k >= rib_out:
            mesh.shells(bay[k : k + 2, :, 0], "main gear bay panels",
                        lambda point: "lower " + wing_label(point)[:8])  # fmt: skip
    for k in ribs:
        if k == 0:
            mesh.shells(bay[0], "wing-body joint", "gear bay")
        else:
            mesh.shells(bay[k], "main gear ribs", f"bay {wing.span.positions[k]:.2f}")


def _caps(mesh: Mesh, wing: Wing, bay: IntArray, ribs: set[int]) -> None:
    for height, surface, inward in ((-1, "upper", [0.0, 0.0, -1.0]), (0, "lower", [0.0, 0.0, 1.0])):

        def label(point: Array, surface: str = surface) -> str:
            return f"beam {surface} {wing_label(point)[:8]}"

        mesh.stiffener(bay[:, -1, height], "main gear bay caps", label, inward, 0.017)
        for k in sorted(ribs):
            name = f"rib {surface} {wing.span.positions[k]:.2f}"
            mesh.stiffener(bay[k, :, height], "main gear bay caps", name, inward, 0.017)


def _gear_bulkhead(
    mesh: Mesh, fuselage: Fuselage, divisions: Divisions, bay: IntArray, side: int
) -> None:
    """Web under the floor that carries one side's half of the gear beam through the fuselage."""
    i = fuselage.stations.index(dim.GEAR_BEAM_STATION)
    edge = fuselage.floor_half
    heights = 2 * divisions.subdivisions
    columns = [edge + side * j for j in range(edge)]
    upper = mesh.points(fuselage.floor[i, columns])
    lower = mesh.points(fuselage.nodes[i, [fuselage.keel_column(c) for c in columns]])
    share = np.linspace(0, 1, heights + 1)[:, None]
    web = mesh.grid(lower[:, None] + share * (upper - lower)[:, None])
    web = np.vstack([web, bay[0, -1][None]])
    mesh.shells(
        web,
        "wing frames",
        lambda point: f"gear bulkhead {'outer' if abs(point[1]) > 0.5 else 'inner'}",
    )
    mesh.stiffener(web[:, 0], "main gear bay caps", "bulkhead lower", [0.0, 0.0, 1.0], 0.017)
