"""Wing: one box from the side of body to the tip on each side, and the centre box between them.

The box lies between 15 % and 60 % chord.  The upper skin of the unswept centre box is the cabin
floor there, its lower skin closes the fuselage.
"""

from dataclasses import dataclass

import numpy as np

from solver.aircraft.bizjet import dimensions as dim
from solver.aircraft.bizjet.divisions import Divisions, Lines
from solver.aircraft.bizjet.fuselage import Fuselage
from solver.aircraft.bizjet.mesh import Mesh
from solver.arrays import Array, IntArray

#: Span position that parts inner and outer wing [m].
INNER_END = 4.6


@dataclass(frozen=True, slots=True)
class Wing:
    """One side's box: node rows over (span line, chord line, height line), lower skin first."""

    side: int  #: -1 port, +1 starboard
    span: Lines  #: |y|
    box: IntArray  #: (n_span, n_chord, n_height); interior nodes only on ribs, else -1

    @property
    def lower(self) -> IntArray:
        """Nodes of the lower skin (n_span, n_chord)."""
        return self.box[:, :, 0]

    @property
    def upper(self) -> IntArray:
        """Nodes of the upper skin (n_span, n_chord)."""
        return self.box[:, :, -1]


def span_lines(divisions: Divisions) -> Lines:
    """Span positions: close together around the gear's fittings."""
    rib_in, rib_out = dim.GEAR_RIBS
    keys = [dim.SIDE_OF_BODY, dim.BRACE_FITTING[1], rib_in, rib_out, dim.GEAR_BEAM_END]
    return divisions.lines([*keys, 8.6, dim.HALF_SPAN], [2, 2, 2, 4, 22, 4])


def box_points(y: Array, fractions: Array, heights: int) -> Array:
    """Points of a starboard box, (n_span, n_chord, heights + 1, 3)."""
    chord = dim.wing_chord(y)[:, None]
    depth = dim.half_thickness(fractions)[None] * dim.WING_THICKNESS * chord
    middle = dim.wing_height(y)[:, None]
    x = dim.wing_station(y[:, None], fractions[None])
    lower, upper = middle - depth, middle + depth
    # The upper skin flattens towards the floor it becomes inside the fuselage.
    flat = np.clip((dim.GEAR_RIBS[0] - y) / (dim.GEAR_RIBS[0] - dim.SIDE_OF_BODY), 0, 1)[:, None]
    upper = (1 - flat) * upper + flat * dim.FLOOR_HEIGHT
    share = np.linspace(0, 1, heights + 1)
    z = lower[..., None] + share * (upper - lower)[..., None]
    shape = z.shape
    return np.stack(
        [
            np.broadcast_to(x[..., None], shape),
            np.broadcast_to(y[:, None, None], shape),
            z,
        ],
        axis=-1,
    )


def wing_label(point: Array) -> str:
    """Bay of the wing at a point: span strip and chord half."""
    y = abs(point[1])
    strip = int(y / 0.45) if y < dim.GEAR_BEAM_END else 6 + int((y - dim.GEAR_BEAM_END) / 0.63)
    chord = (point[0] - dim.wing_leading_edge(y)) / dim.wing_chord(y)
    half = "front" if chord < (dim.FRONT_SPAR + dim.REAR_SPAR) / 2 else "rear"
    return f"strip {strip:02d} {half}"


def _strip(point: Array) -> str:
    return wing_label(point)[:8]


def build_wing(mesh: Mesh, divisions: Divisions, side: int) -> Wing:
    """Add one side's wing box."""
    span = span_lines(divisions)
    chords = divisions.elements(6)
    heights = 2 * divisions.subdivisions
    points = box_points(span.positions, dim.box_fraction(chords), heights)
    points[..., 1] *= side
    box = np.full(points.shape[:-1], -1, dtype=np.int64)
    ribs = _rib_lines(span)
    for k in range(len(span.positions)):
        rows = points[k].reshape(-1, 3) if k in ribs else None
        if rows is not None:
            box[k] = mesh.grid(points[k])
        else:
            box[k][:, [0, -1]] = mesh.grid(points[k][:, [0, -1]])
            box[k][[0, -1]] = mesh.grid(points[k][[0, -1]])
    wing = Wing(side, span, box)
    _skins(mesh, wing)
    _spars(mesh, wing)
    for k in sorted(ribs):
        # Gear ribs and the side-of-body rib belong to others.
        y = span.positions[k]
        family = "wing ribs"
        if k == 0:
            family = "wing-body joint"
        elif min(abs(y - rib) for rib in dim.GEAR_RIBS) < 1e-9:
            family = "main gear ribs"
        mesh.shells(box[k], family, wing_label)
    _stringers(mesh, wing, divisions)
    return wing


def _rib_lines(span: Lines) -> set[int]:
    """Span lines with a rib: all structural ones but those between the fittings' ribs."""
    fitting = {dim.BRACE_FITTING[1], *dim.GEAR_RIBS}
    inner = [
        k
        for k in np.flatnonzero(span.structural).tolist()
        if span.positions[k] > dim.GEAR_RIBS[1] or k == 0
    ]
    return set(inner) | {span.index(position) for position in fitting}


def _skins(mesh: Mesh, wing: Wing) -> None:
    for k in range(len(wing.span.positions) - 1):
        middle = wing.span.positions[k : k + 2].mean()
        part = "inner" if middle < INNER_END else "outer"
        mesh.shells(wing.upper[k : k + 2], f"wing upper skin {part}", wing_label)
        mesh.shells(wing.lower[k : k + 2], f"wing lower skin {part}", wing_label)


def _spars(mesh: Mesh, wing: Wing) -> None:
    rib_in, rib_out = (wing.span.index(rib) for rib in dim.GEAR_RIBS)
    brace = wing.span.index(dim.BRACE_FITTING[1])
    for k in range(len(wing.span.positions) - 1):
        mesh.shells(wing.box[k : k + 2, 0], "wing front spar", _strip)
        family = "wing rear spar"
        if rib_in <= k < rib_out:
            family = "main gear fitting"
        elif k < brace:
            family = "main gear brace fitting"
        mesh.shells(wing.box[k : k + 2, -1], family, _strip)


def _stringers(mesh: Mesh, wing: Wing, divisions: Divisions) -> None:
    last = wing.box.shape[1] - 1
    # Spar caps, and a stringer on every second line between them.
    for i in sorted({0, last, *range(0, last, 2 * divisions.subdivisions)}):
        spar = i in (0, last)
        family = "wing spar caps" if spar else "wing stringers"
        for path, inside in ((wing.upper[:, i], -1.0), (wing.lower[:, i], 1.0)):
            surface = "upper" if inside < 0 else "lower"
            mesh.stiffener(
                path,
                family,
                lambda point, surface=surface: f"{surface} {wing_label(point)}",  # type: ignore[misc]
                [0.0, 0.0, inside],
                0.018,
            )


def build_centre_box(
    mesh: Mesh, divisions: Divisions, fuselage: Fuselage, wings: list[Wing]
) -> None:
    """Add the centre box: skins, spar webs and ribs between the two sides of body."""
    heights = 2 * divisions.subdivisions
    boxed = fuselage.box
    edge, keel = fuselage.floor_half, fuselage.crown
    port, starboard = sorted(wings, key=lambda wing: wing.side)

    def label(point: Array) -> str:
        half = "front" if point[0] < dim.centre_box_stations(2)[1] else "rear"
        return f"{'outer' if abs(point[1]) > 0.5 else 'inner'} {half}"

    upper = fuselage.floor[boxed]
    inner = fuselage.nodes[boxed, keel - edge + 1 : keel + edge]
    lower = np.column_stack([port.lower[0], inner, starboard.lower[0]])
    mesh.shells(upper, "centre box upper skin", label)
    mesh.shells(lower, "centre box lower skin", label)

    share = np.linspace(0, 1, heights + 1)

    def web(i: int, columns: slice) -> IntArray:
        low, high = mesh.points(lower[i, columns]), mesh.points(upper[i, columns])
        return mesh.grid(low[:, None] + share[:, None] * (high - low)[:, None])

    for i in (0, upper.shape[0] - 1):
        mesh.shells(web(i, slice(None)), "centre box spars", label)
    # Ribs over the keel webs carry the fuselage's lower lobe past the box.
    track = fuselage.angles.index(dim.KEEL_WEB)
    for column in (edge - track, edge + track):
        rib = np.stack([web(i, slice(column, column + 1))[0] for i in range(upper.shape[0])])
        mesh.shells(rib, "centre box ribs", label)
        mesh.stiffener(lower[:, column], "centre box stringers", "keel", [0.0, 0.0, 1.0], 0.02)
        mesh.stiffener(upper[:, column], "centre box stringers", "keel", [0.0, 0.0, -1.0], 0.02)
    for i in range(0, upper.shape[0], divisions.subdivisions):
        spar = i in (0, upper.shape[0] - 1)
        family = "centre box caps" if spar else "centre box stringers"
        mesh.stiffener(upper[i], family, f"upper {i * 12 // upper.shape[0]:02d}",
                       [0.0, 0.0, -1.0], 0.02)  # fmt: skip
        mesh.stiffener(lower[i], family, f"lower {i * 12 // upper.shape[0]:02d}",
                       [0.0, 0.0, 1.0], 0.02)  # fmt: skip
