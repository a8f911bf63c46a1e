"""T-tail: fin box on the rear fuselage's crown, tailplane box on the fin's tip."""

import numpy as np

from solver.aircraft.bizjet import dimensions as dim
from solver.aircraft.bizjet.divisions import Divisions
from solver.aircraft.bizjet.fuselage import Fuselage
from solver.aircraft.bizjet.mesh import Mesh
from solver.arrays import Array, IntArray


def fin_tip(divisions: int) -> Array:
    """Points of the fin's tip on the starboard skin, front to rear spar, (n, 3)."""
    fraction = dim.box_fraction(divisions)
    x = dim.FIN_TIP_LEADING_EDGE + fraction * dim.FIN_TIP_CHORD
    y = dim.half_thickness(fraction) * dim.FIN_THICKNESS * dim.FIN_TIP_CHORD
    return np.stack([x, y, np.full_like(x, dim.FIN_TIP_HEIGHT)], axis=1)


def build_fin(mesh: Mesh, divisions: Divisions, fuselage: Fuselage) -> IntArray:
    """Add the fin; returns its nodes (2 skins: port, starboard; n_height; n_chord)."""
    front = fuselage.stations.index(dim.FIN_FRONT)
    rear = fuselage.stations.index(dim.FIN_REAR)
    rows = divisions.elements(9)
    share = np.linspace(0, 1, rows + 1)[:, None, None]
    mirror = np.array([1.0, -1.0, 1.0])
    skins = []
    for side in (-1, 1):
        root = mesh.points(fuselage.nodes[front : rear + 1, fuselage.column(dim.FIN_ROOT, side)])
        tip = fin_tip(rear - front) * (mirror if side < 0 else 1.0)
        skins.append(mesh.grid((1 - share) * root + share * tip))
    fin = np.stack(skins)

    def label(point: Array) -> str:
        return f"bay {int((point[2] - dim.FIN_ROOT_HEIGHT) / 0.65)}"

    sub = divisions.subdivisions
    for skin in fin:
        mesh.shells(skin, "fin skin", label)
        for i in range(0, skin.shape[1], sub):
            out = mesh.points(skin[0, i])[1]
            mesh.stiffener(skin[:, i], "fin stringers", label, [0.0, -np.sign(out), 0.0], 0.012)
    for i in (0, fin.shape[2] - 1):
        mesh.shells(fin[:, :, i], "fin spars", label)
    for k in range(sub, fin.shape[1] - 1, sub):
        mesh.shells(fin[:, k], "fin ribs", label)
    return fin


def tailplane_points(tip: Array, stations: int) -> Array:
    """Points of the starboard tailplane box, (n_span, n_chord, 2, 3), lower skin first.

    ``tip`` is the fin's starboard tip line; the lower skin of the centre part closes the fin.
    """
    fraction = dim.box_fraction(len(tip) - 1)
    share = np.linspace(0, 1, stations + 1)[:, None]
    chord = dim.FIN_TIP_CHORD + share * (dim.TAIL_TIP_CHORD - dim.FIN_TIP_CHORD)
    lead = dim.FIN_TIP_LEADING_EDGE + share * (dim.TAIL_TIP_LEADING_EDGE - dim.FIN_TIP_LEADING_EDGE)
    depth = 2 * dim.half_thickness(fraction) * dim.TAIL_THICKNESS * chord
    x = lead + fraction * chord
    y = tip[:, 1] + share * (dim.TAIL_HALF_SPAN - tip[:, 1])
    middle = dim.FIN_TIP_HEIGHT + 0.5 * 2 * 0.5 * dim.TAIL_THICKNESS * dim.FIN_TIP_CHORD
    # Flat below at the root, symmetric about the chord plane at the tip.
    lower = (1 - share) * dim.FIN_TIP_HEIGHT + share * (middle - depth / 2)
    return np.stack(
        [np.stack([x, y, lower], axis=-1), np.stack([x, y, lower + depth], axis=-1)], axis=2
    )


def build_tailplane(mesh: Mesh, divisions: Divisions, fin: IntArray) -> dict[int, IntArray]:
    """Add the tailplane; returns nodes (n_span, n_chord, 2) of each side (-1, +1)."""
    starboard_tip = mesh.points(fin[1, -1])
    points = tailplane_points(starboard_tip, divisions.elements(10))
    sub = divisions.subdivisions

    def label(point: Array) -> str:
        return f"bay {int(abs(point[1]) / 0.75)}"

    sides: dict[int, IntArray] = {}
    for side in (-1, 1):
        box = mesh.grid(points * np.array([1.0, side, 1.0]))
        sides[side] = box
        mesh.shells(box[:, :, 0], "tailplane skin", label)
        mesh.shells(box[:, :, 1], "tailplane skin", label)
        for i in (0, box.shape[1] - 1):
            mesh.shells(box[:, i], "tailplane spars", label)
        for k in range(0, box.shape[0], sub):
            mesh.shells(box[k], "tailplane ribs", label)
        last = box.shape[1] - 1
        for i in sorted({0, last, *range(0, last, 2 * sub)}):
            for surface, inside in ((0, 1.0), (1, -1.0)):
                mesh.stiffener(
                    box[:, i, surface], "tailplane stringers", label, [0.0, 0.0, inside], 0.010
                )
    for surface in (0, 1):
        centre = np.stack([sides[-1][0, :, surface], sides[1][0, :, surface]])
        mesh.shells(centre, "tailplane skin", "centre")
    for i in (0, fin.shape[2] - 1):
        web = np.stack([sides[-1][0, i], sides[1][0, i]])
        mesh.shells(web, "tailplane spars", "centre")
        for surface, inside in ((0, 1.0), (1, -1.0)):
            mesh.stiffener(
                web[:, surface], "tailplane stringers", "centre", [0.0, 0.0, inside], 0.010
            )
    return sides
