"""Large-rotation statics and linear buckling, as the report shows them."""

import numpy as np

from verification.chapter import Comparisons, Item, Text
from verification.comparison import Comparison
from verification.nonlinear.buckling import column_factor, plate_factor
from verification.nonlinear.large_rotation import (
    BEND,
    SHEARED_STRIP,
    SLIT_PLATE,
    bend,
    rolled_strip,
    sheared_strip,
    slit_plate,
)
from verification.plots import Line, Panel, line_plot
from verification.run import Run

_SZE = "Sze, Liu, Lo 2004"
_ONE_PERCENT = "published figures are of other elements; one per cent is usual among codes"


def static_items(run: Run) -> tuple[Item, ...]:
    """Load strips, a bend and a slit plate."""
    run.progress("large-rotation statics", 0.0)
    strips = {
        kind: sheared_strip(16, kind == "triangles") for kind in ("quadrilaterals", "triangles")
    }
    rows = [
        Comparison(
            f"strip under end shear, {kind}, tip {way}",
            found,
            target,
            0.01,
            "m",
            _SZE,
            _ONE_PERCENT,
        )
        for kind, strip in strips.items()
        for way, found, target in zip(
            ("back", "up"), (strip.back[-1], strip.up[-1]), SHEARED_STRIP, strict=True
        )
    ]
    run.progress("large-rotation statics", 0.3)
    circle = rolled_strip(16)
    rows += [
        Comparison(
            f"strip bent to a circle, tip {way}",
            found,
            target,
            1e-6,
            "m",
            "closed form",
            "equal elements bend to a regular polygon, which closes exactly",
            12.0,
        )
        for way, found, target in (("back", circle.back[-1], 12.0), ("up", circle.up[-1], 0.0))
    ]
    tip = bend(8 if run.quick else 16)
    rows += [
        Comparison(
            f"45-degree bend, tip {axis}",
            found,
            target,
            0.01,
            "m",
            "Bathe, Bolourchi 1979, as quoted by Simo, Vu-Quoc 1986",
            _ONE_PERCENT,
        )
        for axis, found, target in zip("xyz", tip, BEND, strict=True)
    ]
    if not run.quick:
        run.progress("large-rotation statics", 0.5)
        rows += [
            Comparison(
                f"slit annular plate, 10 x 80, {corner} corner",
                found,
                target,
                0.01,
                "m",
                _SZE,
                _ONE_PERCENT,
            )
            for corner, found, target in zip(
                ("inner", "outer"), _slit_plate(run), SLIT_PLATE, strict=True
            )
        ]
    run.progress("large-rotation statics", 1.0)
    shear = strips["quadrilaterals"]
    circle_levels = np.concatenate([[0.0], circle.levels])
    figure = line_plot(
        "nonlinear-strips",
        "Cantilever strips of 16 quadrilaterals: way of the tip back to the support and up, under "
        "an end shear, and under an end moment that closes the strip to a circle. Points: "
        "published tip, and the closed form of a circular arc.",
        [
            Panel(
                "end shear [-]",
                "tip [m]",
                [
                    Line(4 * shear.levels, shear.back, "back"),
                    Line(4 * shear.levels, shear.up, "up"),
                    Line(np.array([4.0]), np.array(SHEARED_STRIP[:1]), "", "points", 0),
                    Line(np.array([4.0]), np.array(SHEARED_STRIP[1:]), "", "points", 1),
                ],
                "end shear",
            ),
            Panel(
                "moment / full circle [-]",
                "tip [m]",
                [
                    Line(circle_levels, np.append(0.0, circle.back), "back", colour=0),
                    Line(circle_levels, np.append(0.0, circle.up), "up", colour=1),
                    Line(circle.levels, 12 - 12 * np.sinc(2 * circle.levels), "", "points", 0),
                    Line(circle.levels, _arc_height(circle.levels), "", "points", 1),
                ],
                "end moment",
            ),
        ],
    )
    return (
        Text(
            "Statics first: strips of shells and a curved beam that leave their first shape far "
            "behind, by full Newton iteration with the true tangent of the same forces."
        ),
        figure,
        Comparisons("Large-rotation statics", tuple(rows)),
    )


def _slit_plate(run: Run) -> np.ndarray:
    sources = ("solver/nonlinear", "solver/fe", "verification/nonlinear/large_rotation.py")
    found = run.stored(
        "nonlinear-slit-plate", (10, 80), sources, lambda: {"rise": np.array(slit_plate(10, 80))}
    )
    return found["rise"]


def _arc_height(levels: np.ndarray) -> np.ndarray:
    """Rise of the end of an arc of length 12 that turns by 2 pi times the level."""
    angle = 2 * np.pi * levels
    rise: np.ndarray = 12.0 * (1.0 - np.cos(angle)) / angle
    return rise


def buckling_items(run: Run) -> tuple[Item, ...]:
    """Column and plates."""
    run.progress("buckling", 0.0)
    fine = 16 if run.quick else 32
    rows = (
        Comparison(
            "Euler column of 16 beams",
            column_factor(16),
            1.0,
            0.005,
            "",
            "Euler, closed form",
            "second order in the length of a beam: a chord carries the axial force",
        ),
        Comparison(
            f"compressed square plate, {fine} x {fine} quadrilaterals",
            plate_factor(fine),
            1.0,
            0.01,
            "",
            "Timoshenko, Gere 1961, article 9.2",
            "second order in the size of an element",
        ),
        Comparison(
            f"compressed square plate, {fine} x {fine} x 2 triangles",
            plate_factor(fine, True),
            1.0,
            0.01,
            "",
            "Timoshenko, Gere 1961, article 9.2",
            "second order in the size of an element",
        ),
    )
    run.progress("buckling", 1.0)
    return (
        Text(
            "What a linear analysis misses first is that compression softens thin parts. The "
            "change of the tangent with the loads, the geometric stiffness, gives the critical "
            "loads of a column and of plates."
        ),
        Comparisons("Critical load relative to the closed form", rows),
    )
