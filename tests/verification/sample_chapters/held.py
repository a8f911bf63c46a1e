"""A chapter that holds, with one item of every kind."""

import numpy as np

from verification.chapter import Chapter, Comparisons, Table, Text
from verification.comparison import Comparison
from verification.plots import Line, Panel, line_plot
from verification.run import Run


def chapter(run: Run) -> Chapter:
    run.progress("counting", 1.0)
    rows = (
        Comparison("four <thirds>", 1.3333, 4 / 3, 1e-3, "N", "arithmetic", "four decimals & more"),
        Comparison("a residual", 2.5e-9, 0.0, 1e-8, "", "equilibrium", "rounding", scale=1.0),
    )
    x = np.linspace(0.0, 1.0, 5)
    return Chapter(
        "held",
        "What holds",
        (
            Text("Words with <angle brackets>."),
            Comparisons("Two figures", rows),
            Table("Weights", ("part", "mass [kg]"), (("wing", "12.5"), ("fin", "3.25")), "A note."),
            line_plot("held-square", "A square.", [Panel("x [m]", "y [m]", [Line(x, x**2, "x")])]),
        ),
    )
