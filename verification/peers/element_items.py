"""Elements of both codes at the airframe's density: figures of the chapter."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.fe.model import FiniteElementModel
from solver.fe.sections import shell_sections
from solver.fe.shell_quad import quad_stiffness
from verification.chapter import Comparisons, Item, Table, Text
from verification.comparison import Comparison
from verification.peers.apart import PeerError, apart
from verification.peers.box_torsion import box, bredt_stiffness, measured_stiffness
from verification.peers.kratos_model import THICK_QUAD, THIN_QUAD
from verification.peers.kratos_runs import (
    PeerMatrices,
    free_modes,
    matrices,
    stiffness_of_quadrilaterals,
)
from verification.peers.panels import GAUGE, PANELS, Panel, flat_panel
from verification.peers.variants import (
    RIGID,
    Modes,
    elastic_modes,
    our_modes,
    triangulated,
    with_poisson_ratio,
)
from verification.run import Run

SOURCE = "Kratos, ShellThinElement3D3N (ANDES membrane, DKT plate), same mesh"
#: Modes compared of each panel.
COUNT = 6
#: Poisson ratio at which both codes' triangles have the same higher-order stiffness: the peer
#: holds beta_0 = 4/9, the optimum (1 - 4 nu^2) / 2 of this ratio (Felippa 2003).
COMMON_RATIO = 1.0 / 6.0
#: How often an element is formed to see whether it survives.
REPEATS = 50


@dataclass(frozen=True, slots=True)
class PanelFigures:
    """Frequencies [Hz] of one panel by several means."""

    panel: Panel
    common: tuple[Modes, Modes]  #: triangles at `COMMON_RATIO`: solver, peer
    triangles: tuple[Modes, Modes]  #: triangles: solver, peer
    quadrilaterals: Modes  #: of the solver


def peer_modes(model: FiniteElementModel, count: int, quad: str = THIN_QUAD) -> Modes:
    """Lowest elastic modes by Kratos's own eigensolver."""
    found = apart(free_modes, model, count + RIGID, quad)
    return elastic_modes(found["eigenvalues"], found["shapes"])


def panel_figures(run: Run) -> list[PanelFigures]:
    """Compute all panels."""
    figures = []
    for index, panel in enumerate(PANELS):
        run.progress("panels by both codes", index / len(PANELS))
        model = panel.build(1)
        cut = triangulated(model)
        common = with_poisson_ratio(cut, COMMON_RATIO)
        figures.append(
            PanelFigures(
                panel,
                (our_modes(common, COUNT), peer_modes(common, COUNT)),
                (our_modes(cut, COUNT), peer_modes(cut, COUNT)),
                our_modes(model, COUNT),
            )
        )
    run.progress("panels by both codes", 1.0)
    return figures


def quadrilateral_items() -> list[Item]:
    """Why the peer's quadrilaterals are not compared with."""
    model = flat_panel(1)
    corners = model.coordinates[model.quads.nodes]
    sections = shell_sections(model, model.quads)
    found = [("solver", f"{_bending_share(quad_stiffness(corners, sections)[0], model):.3f}")]
    for name in (THIN_QUAD, THICK_QUAD):
        try:
            stiffness = apart(stiffness_of_quadrilaterals, model, name, REPEATS)
        except PeerError as failure:
            found.append((f"peer, {name}", str(failure)))
        else:
            found.append((f"peer, {name}", f"{_bending_share(stiffness, model):.3f}"))
    return [
        Table(
            "Energy of a quadrilateral bent in its plane over that of the exact strains",
            ("element", "share"),
            tuple(found),
            note="A square with the displacements and rotations of pure bending; 1 is exact. "
            f"Each element is formed {REPEATS} times in a process of its own.",
        )
    ]


def _bending_share(stiffness: Array, model: FiniteElementModel) -> float:
    """Energy in pure bending about the normal over E t b^3 / 12 times the length."""
    places = model.coordinates[model.quads.nodes[0]]
    x, y = (places - places.mean(axis=0))[:, :2].T
    ratio = model.materials[1].poisson_ratio
    motion = np.zeros((4, 6))
    motion[:, 0] = -x * y
    motion[:, 1] = 0.5 * (x * x + ratio * y * y)
    motion[:, 5] = x
    flat = motion.ravel()
    exact = model.materials[1].young_modulus * GAUGE * np.ptp(y) ** 3 / 12.0 * np.ptp(x)
    return float(flat @ stiffness @ flat / exact)


def panel_items(figures: list[PanelFigures]) -> list[Item]:
    """Comparisons and the table of the panels."""
    rows: list[Comparison] = []
    for one in figures:
        ours, peer = one.common
        worst = int(np.argmax(np.abs(ours.frequencies / peer.frequencies - 1.0)))
        rows.append(
            Comparison(
                f"{one.panel.name}, mode {worst + 1} (furthest of {COUNT}), ratio 1/6",
                float(ours.frequencies[worst]),
                float(peer.frequencies[worst]),
                2e-3,
                "Hz",
                SOURCE,
                "at this Poisson ratio the triangles are the same but for transverse shear, "
                "(t/h)^2, and the rotary inertia of sections, lumped here and consistent there",
            )
        )
    for one in figures:
        ours, peer = one.triangles
        worst = int(np.argmax(np.abs(ours.frequencies / peer.frequencies - 1.0)))
        rows.append(
            Comparison(
                f"{one.panel.name}, mode {worst + 1} (furthest of {COUNT}), ratio 0.33",
                float(ours.frequencies[worst]),
                float(peer.frequencies[worst]),
                0.05,
                "Hz",
                SOURCE,
                "the peer's triangle is 1.6 times stiffer in bending in its plane (beta_0 4/9 "
                "for 0.28), which moves modes with much of it by percents",
            )
        )
    return [
        Comparisons("Triangles of both codes on the same panels", tuple(rows)),
        _panel_table(figures),
    ]


def _panel_table(figures: list[PanelFigures]) -> Table:
    rows = []
    for one in figures:
        peer = one.triangles[1].frequencies
        rows += [
            (
                f"{one.panel.name}, mode {mode + 1}",
                f"{peer[mode]:.3f} Hz",
                *(
                    f"{modes.frequencies[mode] / peer[mode] - 1:+.2%}"
                    for modes in (one.triangles[0], one.quadrilaterals)
                ),
            )
            for mode in range(3)
        ]
    return Table(
        "Spread of formulations on coarse panels, one element to a bay",
        ("panel", "triangles, peer", "triangles, solver", "quadrilaterals, solver"),
        tuple(rows),
    )


def torsion_items(run: Run) -> list[Item]:
    """Twist closed boxes by both codes, against Bredt."""
    rows: list[Comparison] = []
    table = []
    target = bredt_stiffness()
    cases = [(fineness, has_ribs) for has_ribs in (False, True) for fineness in (1, 2, 3)]
    for index, (fineness, has_ribs) in enumerate(cases):
        run.progress("boxes in torsion", index / len(cases))
        model = box(fineness, has_ribs)
        cut = triangulated(model)
        matrix: PeerMatrices = apart(matrices, cut, THIN_QUAD)
        words = f"{'ribbed' if has_ribs else 'plain'} box, {fineness} a wall"
        found = measured_stiffness(model, fineness)
        triangles = measured_stiffness(cut, fineness)
        peer = measured_stiffness(cut, fineness, matrix.stiffness)
        rows.append(
            Comparison(
                f"{words}, quadrilaterals",
                found,
                target,
                0.02,
                "N m2",
                "closed form, R. Bredt 1896",
                "thin walls and a load that follows the exact shear flow: what is left is the "
                "clamped end; a hundredth for each of both",
            )
        )
        rows.append(
            Comparison(
                f"{words}, triangles",
                triangles,
                peer,
                1e-3,
                "N m2",
                SOURCE,
                "no bending of triangles in their plane in this case",
            )
        )
        table.append((words, *(f"{value / target - 1:+.2%}" for value in (found, triangles, peer))))
    run.progress("boxes in torsion", 1.0)
    return [
        Text(
            "Closed boxes in torsion are where the rotations of nodes at folds decide: walls in "
            "shear turn in their plane by half of what their neighbours' edges turn by. With one "
            "element to a wall, rotation about the normal, tied to the wall's spin, and bending "
            "rotation, tied to the neighbour's slope, are the same freedom. A plate that ties the "
            "slope by its shear stiffness (MITC4) locks there, 5 % too stiff, 10 % with ribs; "
            "discrete Kirchhoff-Mindlin plates bend along their sides instead."
        ),
        Comparisons("Closed boxes in torsion", tuple(rows)),
        Table(
            "Torsional stiffness over Bredt's",
            ("box", "quadrilaterals, solver", "triangles, solver", "triangles, peer"),
            tuple(table),
        ),
    ]
