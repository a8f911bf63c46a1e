"""Shells and beams against published benchmarks, closed forms and patch tests."""

from collections.abc import Callable, Sequence

from verification.chapter import Chapter, Comparisons, Item, Plot, Table, Text
from verification.comparison import Comparison
from verification.elements import beams, cantilevers, curved_shells, plates
from verification.elements.exact_sections import MACNEAL, beam_section, compared, patch_section
from verification.elements.figures import Figure
from verification.elements.sweeps import CASES, Sweep, sweep
from verification.elements.thin_plate import square_plate_frequencies
from verification.plots import Line, Panel, line_plot
from verification.run import Run

STATIC = "2 % is usual for shells on the refined mesh of the benchmark"
MODAL = "1 %, usual for frequencies on the refined mesh"
#: Saint-Venant's torsion constant of a bar 0.2 x 0.1, J = 0.2287 b t^3 (Timoshenko and Goodier,
#: Theory of Elasticity, section 109), under torque 1 on length 6.
SAINT_VENANT_TWIST = 6.0 / (1e7 / 2.6 * 0.2287 * 0.2 * 0.1**3)


def chapter(run: Run) -> Chapter:
    """Measure every element benchmark."""
    run.progress("element benchmarks", 0.0)
    items: list[Item] = [
        Text(
            "Every stress of this program comes out of four-node and three-node shells and two-node"
            " beams. Patch tests show that states of constant strain come out exactly on distorted"
            " meshes, the published benchmarks that real geometry does not lock, and the curves"
            " that the error falls with the mesh. Lengths, forces and moduli are those of the"
            " publications, mostly without units."
        ),
        patch_section(),
        *_straight_beams(run.quick),
        *_curved_beams(run.quick),
    ]
    run.progress("element benchmarks", 0.1)
    items += _curved_shells()
    items += _frequencies(run.quick)
    items.append(beam_section())
    run.progress("element benchmarks", 0.3)
    meshes = 3 if run.quick else 5
    swept = []
    for index, case in enumerate(CASES):
        swept.append(sweep(case, meshes))
        run.progress("element benchmarks", 0.3 + 0.7 * (index + 1) / len(CASES))
    items += [_convergence(swept), _ratios(swept), _limits(swept)]
    return Chapter("elements", "Elements", tuple(items))


def _straight_beams(quick: bool) -> list[Item]:
    names = ("extension", "in-plane", "out-of-plane", "twist")
    published = []
    for triangular in (False, True):
        for shape in ("regular", "trapezoidal", "parallelogram"):
            figures = cantilevers.straight_cantilever(shape, triangular)
            ratios = [figure.ratio for figure in figures[:3]]
            ratios.append(figures[3].computed / SAINT_VENANT_TWIST)
            cells = [f"{ratio:.3f}" for ratio in ratios]
            published.append((_shape(triangular), shape, *cells))
    rows = []
    meshes = [
        (False, "regular", 2),
        (False, "trapezoidal", 8),
        (False, "parallelogram", 8),
        (True, "regular", 2),
        (True, "trapezoidal", 8),
        (True, "parallelogram", 48),
    ]
    for triangular, shape, refine in meshes[:-1] if quick else meshes:
        for name, figure in zip(
            names, cantilevers.straight_cantilever(shape, triangular, refine)[:3], strict=False
        ):
            title = f"straight beam, {shape} {_shape(triangular)} {6 * refine} × {refine}, {name}"
            rows.append(compared(figure, f"{MACNEAL}, table 3", 0.02, STATIC, title))
    for triangular, refine in ((False, 8), (True, 16))[: 1 if quick else 2]:
        twist = cantilevers.straight_cantilever("regular", triangular, refine, slenderness=1)[3]
        rows.append(
            Comparison(
                f"straight beam, square {_shape(triangular)} {30 * refine} × {refine}, twist",
                twist.computed,
                SAINT_VENANT_TWIST,
                0.02,
                "",
                "Saint-Venant, J = 0.2287 b t³ (Timoshenko and Goodier, section 109)",
                "2 %: the plate must resolve the shear that turns round at the edge; elements "
                "longer than they are thick have J = b t³/3, without it",
            )
        )
    coarse = Table(
        "Straight cantilever on the published mesh of 6 × 1, share of the target",
        ("elements", "mesh", *names),
        tuple(published),
        "Twist as share of Saint-Venant's 0.03411. In-plane bending of one row of trapezoids or"
        " parallelograms locks: no four-node membrane with displacements at its corners that passes"
        " the patch test can avoid it (R. H. MacNeal, Int. J. Num. Meth. Eng. 24, 1987, 1793), and"
        " passing the patch test was chosen. Refined meshes recover, as the next table shows.",
    )
    note = Text(
        "The published twist of the straight cantilever, 0.03208, lies"
        f" {100 * (1 - 0.03208 / SAINT_VENANT_TWIST):.0f} % below Saint-Venant's"
        f" {SAINT_VENANT_TWIST:.5f} for its rectangle of 0.2 × 0.1. The comparison is with"
        " Saint-Venant. A bar twice as wide as it is thick is no plate: it takes some eight"
        " elements across, and as many to the same length along it, to show its torsion by shells."
    )
    return [coarse, Comparisons("Straight cantilever, refined", tuple(rows)), note]


def _shape(triangular: bool) -> str:
    return "triangles" if triangular else "quadrilaterals"


def _curved_beams(quick: bool) -> list[Item]:
    exact = beams.curved_cantilever(96), beams.twisted_cantilever(96)
    rows = []
    for triangular in (False, True):
        if triangular and quick:  # these converge on fine meshes only
            break
        shape = _shape(triangular)
        # out of plane it twists as the bar above does, and asks for short quadrilaterals
        mesh = (32, 192) if triangular else (8, 264)
        for figure in cantilevers.curved_cantilever(*mesh, triangular):
            name = f"{shape}, {figure.case}"
            rows.append(compared(figure, f"{MACNEAL}, table 4", 0.02, STATIC, name))
        for thin in (False, True):
            along = 24 if not thin else 96 if triangular else 12
            along = along * (2 if triangular and thin else 1)
            source = (
                "Belytschko, Wong and Stolarski, Int. J. Num. Meth. Eng. 28, 1989"
                if thin
                else f"{MACNEAL}, table 5"
            )
            rows += [
                compared(figure, source, 0.02, STATIC, f"{shape}, {figure.case}")
                for figure in cantilevers.twisted_beam(along // 6, along, triangular, thin)
            ]
    for shells, chain in (
        (cantilevers.curved_cantilever(16, 96), exact[0]),
        (cantilevers.twisted_beam(8, 48), exact[1]),
    ):
        for found, form in zip(shells, chain, strict=True):
            rows.append(
                Comparison(
                    f"quadrilaterals, {found.case}",
                    found.computed,
                    form.target,
                    0.02,
                    "",
                    "Castigliano's theorem for the curved (twisted) beam, see beams below",
                    STATIC,
                )
            )
    coarse = (*beams.curved_cantilever(6), *beams.twisted_cantilever(12))
    published = (*cantilevers.curved_cantilever(), *cantilevers.twisted_beam())
    closed = [figure.target for pair in exact for figure in pair]
    labels = (
        "curved, in-plane",
        "curved, out-of-plane",
        "twisted, in-plane",
        "twisted, out-of-plane",
    )
    table = Table(
        "Where the published targets of the curved and the twisted beam come from",
        ("case", "published", "6 (12) straight beams", "difference", "closed form", "difference"),
        tuple(
            (
                label,
                f"{target.target:.4g}",
                f"{chain.computed:.4g}",
                f"{100 * (target.target / chain.computed - 1):+.2f} %",
                f"{form:.4g}",
                f"{100 * (target.target / form - 1):+.2f} %",
            )
            for label, target, chain, form in zip(labels, published, coarse, closed, strict=True)
        ),
        "Differences of the published figure. Three of the four are much closer to the benchmark's"
        " own number of straight beam elements than to the beam itself. The curved beam is softer"
        " in its plane than published, and refined shells go there: their distance from the"
        " published figure does not vanish.",
    )
    return [Comparisons("Curved and twisted beams of shells", tuple(rows)), table]


def _curved_shells() -> list[Item]:
    knight = "Knight, AIAA Journal 35, 1997"
    point = f"{STATIC}; under a point load a shear-flexible shell keeps growing as log(1/h)"
    rows = []
    for triangular in (False, True):
        shape = _shape(triangular)
        rows += [
            compared(figure, source, 0.02, reason, f"{shape}, {figure.case}")
            for figure, source, reason in (
                (curved_shells.scordelis_lo(16, triangular), f"{MACNEAL}, table 7", STATIC),
                (curved_shells.pinched_cylinder(32, triangular), f"{MACNEAL}, page 11", point),
                (curved_shells.hemisphere(32, triangular), f"{MACNEAL}, table 8", STATIC),
                (curved_shells.raasch_hook(10, 72, triangular), knight, STATIC),
            )
        ]
    return [Comparisons("Curved shells", tuple(rows))]


def _frequencies(quick: bool) -> list[Item]:
    tables: list[Item] = []
    cases: tuple[
        tuple[str, str, Callable[..., list[Figure]], tuple[int, ...], bool | None], ...
    ] = (
        ("Free square plate, FV12", "FV12", plates.free_plate, (32,), False),
        ("Cantilevered square plate, FV16", "FV16", plates.cantilevered_plate, (32,), True),
        ("Tapered membrane, FV32", "FV32", plates.tapered_membrane, (20, 40), None),
    )
    for title, report, benchmark, mesh, clamped in cases:
        rows = []
        for triangular in (False, True):
            for figure in benchmark(*mesh, triangular=triangular):
                name = f"{_shape(triangular)}, {figure.case}"
                rows.append(compared(figure, f"NAFEMS {report}", 0.01, MODAL, name, "Hz"))
        if clamped is not None:
            exact = square_plate_frequencies(10.0, 0.05, 200e9, 0.3, 8000.0, clamped)
            side = 32 if quick else 64
            for figure, target in zip(benchmark(side), exact, strict=False):
                rows.append(
                    Comparison(
                        f"quadrilaterals {side} × {side}, {figure.case}",
                        figure.computed,
                        float(target),
                        0.003 * (64 / side) ** 2,
                        "Hz",
                        "thin plate, Ritz series of Legendre polynomials (verification/elements)",
                        "0.3 %: second-order error of 64 elements a side, and shear left out of"
                        " the series at t/L = 1/200",
                    )
                )
        tables.append(Comparisons(title, tuple(rows)))
    series = square_plate_frequencies(10.0, 0.05, 200e9, 0.3, 8000.0)
    tables.append(
        Text(
            f"Modes 7 and 8 of FV12 converge to {series[3]:.3f} Hz, not to the published 4.233 Hz:"
            f" that is what the thin-plate series gives (Leissa's shorter series has 4.217 Hz, an"
            f" upper bound). The published figure is {100 * (4.233 / series[3] - 1):.1f} % higher,"
            " so the mesh of 32 elements meets it within 1 % from below and a finer one would not."
        )
    )
    return tables


def _convergence(swept: Sequence[Sweep]) -> Plot:
    panels = [
        Panel(
            f"elements along {result.case.side}",
            "error (1)",
            [
                Line(result.densities, result.errors(False), "quadrilaterals", "marked"),
                Line(result.densities, result.errors(True), "triangles", "marked"),
            ],
            title=result.case.title,
            log="xy",
            x_limits=(3.0, 300.0),
            y_limits=(1e-4, 2.0),
            levels=((0.02, "2 %"),),
        )
        for result in swept
    ]
    return line_plot(
        "element-convergence",
        "Error against the published figure over the mesh. The curves flatten, or cross zero and"
        " return, where the exact solution differs from the published figure.",
        panels,
        columns=2,
    )


def _ratios(swept: Sequence[Sweep]) -> Table:
    rows = []
    for result in swept:
        for triangular, figures in ((False, result.quads), (True, result.triangles)):
            cells = [
                f"{int(d)}: {f.ratio:.4f}" for d, f in zip(result.densities, figures, strict=True)
            ]
            cells += [""] * (6 - len(cells))
            rows.append((result.case.title, _shape(triangular), *cells))
    return Table(
        "Share of the published figure over the mesh (elements along the side: share)",
        ("case", "elements", *["mesh"] * 6),
        tuple(rows),
        "Triangles converge slowly on thin curved surfaces, the hemisphere and the twisted beam of"
        " t/L = 1/3750: flat triangles meet at angles in every direction, and their drilling"
        " freedom, which makes them bend well in their plane, then holds the shell back until the"
        " mesh is fine. Aircraft skins here are quadrilaterals; triangles only close odd corners.",
    )


def _limits(swept: Sequence[Sweep]) -> Text:
    """Where the hook stands on its finest mesh, which is not its limit."""
    hook = next(result for result in swept if result.case.title == "Raasch hook")
    last, before = hook.quads[-1].ratio, hook.quads[-2].ratio
    return Text(
        f"Raasch's hook meets the published 4.935 within 2 % on the usual mesh, but has not settled"
        f" there: on {hook.densities[-1]:.0f} quadrilaterals along the second arc it stands"
        f" {100 * (last - 1):+.1f} % from it and {100 * (last - before):.1f} % above the mesh of"
        " half that density. A strip with its warping free, Saint-Venant's torsion along the hook's"
        f" line, gives {curved_shells.raasch_strip():.2f}; the clamped end takes some of that back."
    )
