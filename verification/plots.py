"""The house style of the report's figures: few inks, small multiples, labels at the curves.

`line_plot` draws panels of curves or points as SVG, `bar_plot` horizontal bars as SVG, and
`airframe_plot` coloured airframes as PNG.  The same input gives the same bytes: no date, ids from
the figure's name.  The inks `INK`, `FAINT` and `GRID` belong to no curve, so that the report can
exchange them for those of a dark page.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from itertools import pairwise
from typing import Any, Literal

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from solver.arrays import Array
from solver.fe.model import FiniteElementModel
from verification.airframe_drawing import add_airframe
from verification.chapter import Plot

INK = "#1d2126"  #: of text and axes
FAINT = "#7b828b"  #: of remarks and reference levels
GRID = "#e3e6ea"

#: Distinct for colour-blind eyes, on white and on black (Paul Tol, "bright", SRON/EPS/TN/09-002).
COLOURS = ("#4477aa", "#ee6677", "#228833", "#b8a11f", "#aa3377", "#3ba7c4")

#: Width of a figure, that of the report's text [in].
WIDTH = 6.7

STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 7.5,
    "text.color": INK,
    "axes.edgecolor": FAINT,
    "axes.labelcolor": INK,
    "axes.titlecolor": INK,
    "axes.titlelocation": "left",
    "axes.titlesize": 8,
    "axes.titlepad": 6.0,
    "axes.labelsize": 7.5,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.formatter.useoffset": False,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "xtick.color": FAINT,
    "ytick.color": FAINT,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "xtick.major.size": 3,
    "ytick.major.size": 0,
    "xtick.minor.size": 0,
    "ytick.minor.size": 0,
    "lines.linewidth": 1.4,
    "lines.markersize": 3.2,
    "figure.constrained_layout.h_pad": 0.07,
    "figure.constrained_layout.w_pad": 0.05,
    "figure.facecolor": "none",
    "axes.facecolor": "none",
    "savefig.facecolor": "none",
    "svg.fonttype": "path",
}

#: Points of a line beyond which they are drawn small.
MANY_POINTS = 1000

Stroke = Literal["solid", "dashed", "dotted", "points", "marked"]
_DASHES: dict[str, Any] = {"dashed": (0, (4, 2)), "dotted": (0, (1, 1.4))}


@dataclass(frozen=True, slots=True)
class Line:
    """One curve, or points where ``stroke`` says so."""

    x: Array
    y: Array
    label: str = ""  #: written at the curve's end, or at ``label_at``
    stroke: Stroke = "solid"  #: "marked" joins its points by a thin line
    colour: int | None = None  #: index into `COLOURS`; None: next in order, by label
    label_at: float | None = None  #: x at which the label stands instead of the curve's end
    width: float = 1.4  #: [pt]


@dataclass(frozen=True, slots=True)
class Panel:
    """One pair of axes; labels carry the unit in brackets."""

    x_label: str
    y_label: str
    lines: Sequence[Line]
    title: str = ""
    log: Literal["", "x", "y", "xy"] = ""
    x_limits: tuple[float, float] | None = None
    y_limits: tuple[float, float] | None = None
    levels: Sequence[tuple[float, str]] = ()  #: horizontal reference lines: value, words
    is_square: bool = False  #: equal scales on both axes


def line_plot(
    name: str,
    caption: str,
    panels: Sequence[Panel],
    columns: int = 2,
    height: float = 2.1,
    share_x: bool = False,
) -> Plot:
    """Draw panels in rows of ``columns``, each ``height`` inches high.

    Lines of the same label have the same colour in all panels.
    """
    columns = min(columns, len(panels))
    rows = -(-len(panels) // columns)
    with mpl.rc_context(STYLE | {"svg.hashsalt": name}):
        figure = Figure(figsize=(WIDTH, height * rows), layout="constrained")
        grid = figure.subplots(rows, columns, squeeze=False, sharex="col" if share_x else False)
        colours: dict[str, int] = {}
        for axes, panel in zip(grid.flat, panels, strict=False):
            _draw_panel(axes, panel, colours)
        for axes in grid.flat[len(panels) :]:
            axes.set_visible(False)
        figure.draw_without_rendering()
        for axes, panel in zip(grid.flat, panels, strict=False):
            _label_ends(axes, panel, colours)
        return Plot(name, caption, _svg(figure), "svg")


def bar_plot(
    name: str, caption: str, labels: Sequence[str], values: Sequence[float], axis_label: str
) -> Plot:
    """Draw one horizontal bar for each label, its value written at its end."""
    with mpl.rc_context(STYLE | {"svg.hashsalt": name, "axes.grid": False}):
        figure = Figure(figsize=(WIDTH, 0.5 + 0.22 * len(labels)), layout="constrained")
        axes = figure.subplots()
        rows = np.arange(len(labels))
        axes.barh(rows, values, height=0.62, color=COLOURS[0])
        axes.set_yticks(rows, labels)
        axes.invert_yaxis()
        for row, value in zip(rows, values, strict=True):
            axes.annotate(
                f"{value:.3g}", (value, float(row)), (3, 0), textcoords="offset points", va="center"
            )
        axes.set_xlabel(axis_label)
        axes.margins(x=0.1)
        return Plot(name, caption, _svg(figure), "svg")


def airframe_plot(
    name: str,
    caption: str,
    model: FiniteElementModel,
    values: Array | Sequence[tuple[str, Array]],
    label: str,
    limit: float | None = None,
) -> Plot:
    """Draw the airframe coloured by a value for each element.

    Parameters
    ----------
    values : (n_elements,) array, or pairs of title and such an array
        Several fields stand side by side on one scale of colours.
    label : str
        Of the scale, with its unit.
    limit : float, optional
        Upper end of the scale; the largest value of a shell if left out.
    """
    fields = [("", values)] if isinstance(values, np.ndarray) else list(values)
    shells = len(model.quads.nodes) + len(model.triangles.nodes)
    if limit is None:
        limit = max(float(np.max(field[:shells])) for _, field in fields)
    columns = min(2, len(fields))
    rows = -(-len(fields) // columns)
    width, high = WIDTH / columns, WIDTH / columns * 0.56
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, rows * high + 0.5))
        total = rows * high + 0.5
        for index, (title, field) in enumerate(fields):
            row, column = divmod(index, columns)
            place = (
                column * width / WIDTH,
                1 - (row + 1) * high / total,
                width / WIDTH,
                high / total,
            )
            skin = add_airframe(figure, place, model, field, limit, colours="viridis")
            figure.text(
                place[0] + 0.01, place[1] + place[3] - 0.02, title, va="top", fontsize=8, color=INK
            )
        bar = figure.colorbar(
            skin,
            cax=figure.add_axes((0.3, 0.42 / total, 0.4, 0.08 / total)),
            orientation="horizontal",
        )
        bar.set_label(label)
        bar.outline.set_visible(False)
        stream = BytesIO()
        figure.savefig(
            stream, format="png", dpi=200, facecolor="white", metadata={"Software": None}
        )
    return Plot(name, caption, stream.getvalue(), "png")


def _draw_panel(axes: Axes, panel: Panel, colours: dict[str, int]) -> None:
    axes.set_xlabel(panel.x_label)
    axes.set_ylabel(panel.y_label)
    if panel.title:
        axes.set_title(panel.title)
    if "x" in panel.log:
        axes.set_xscale("log")
    if "y" in panel.log:
        axes.set_yscale("log")
    for value, words in panel.levels:
        axes.axhline(value, color=FAINT, linewidth=0.8, linestyle=(0, (2, 2)))
        axes.annotate(
            words,
            (0.0, value),
            (3, 2),
            xycoords=("axes fraction", "data"),
            textcoords="offset points",
            color=FAINT,
            fontsize=6.5,
        )
    for index, line in enumerate(panel.lines):
        colour = COLOURS[_colour(line, index, colours)]
        points = line.stroke in ("points", "marked")
        axes.plot(
            line.x,
            line.y,
            color=colour,
            linewidth={"points": 0.0, "marked": 0.8}.get(line.stroke, line.width),
            linestyle=_DASHES.get(line.stroke, "solid"),
            marker="o" if points else "",
            markeredgewidth=0.0,
            markersize=1.6 if len(line.x) > MANY_POINTS else 3.2,
            # Thousands of marks as a picture inside the drawing, not as thousands of shapes.
            rasterized=points and len(line.x) > MANY_POINTS,
        )
    if panel.x_limits is not None:
        axes.set_xlim(*panel.x_limits)
    if panel.y_limits is not None:
        axes.set_ylim(*panel.y_limits)
    if panel.is_square:
        axes.set_aspect("equal", adjustable="datalim")


def _colour(line: Line, index: int, colours: dict[str, int]) -> int:
    if line.colour is not None:
        return line.colour % len(COLOURS)
    if not line.label:
        return index % len(COLOURS)
    return colours.setdefault(line.label, len(colours) % len(COLOURS))


def _label_ends(axes: Axes, panel: Panel, colours: dict[str, int]) -> None:
    """Write labels at the curves; those at the right end move apart where they would overlap."""
    ends: list[tuple[float, str, str]] = []
    written: set[str] = set()
    for index, line in enumerate(panel.lines):
        if not line.label or line.label in written or len(line.x) == 0:
            continue
        written.add(line.label)
        colour = COLOURS[_colour(line, index, colours)]
        if line.label_at is not None:
            _label_at(axes, line, line.label_at, colour)
            continue
        inside = np.flatnonzero(np.asarray(line.x) <= axes.get_xlim()[1] * (1 + 1e-9))
        end = inside[np.argmax(np.asarray(line.x)[inside])]
        last = (line.x[end], line.y[end])
        corner = axes.transAxes.inverted().transform(axes.transData.transform(last))
        ends.append((float(np.clip(corner[1], 0.0, 1.0)), line.label, colour))
    height = axes.bbox.height / axes.figure.dpi * 72.0
    gap = 9.0 / height
    places = _spread([end[0] for end in ends], gap)
    for place, (_, words, colour) in zip(places, ends, strict=True):
        axes.annotate(
            words,
            (1.0, place),
            (4, 0),
            xycoords="axes fraction",
            textcoords="offset points",
            color=colour,
            va="center",
        )


def _label_at(axes: Axes, line: Line, x: float, colour: str) -> None:
    """Write a label above the curve, on the side where the curve is lower."""
    y, before = np.interp([x, x - 0.02 * np.ptp(line.x)], line.x, line.y)
    is_rising = before < y
    axes.annotate(
        line.label,
        (x, float(y)),
        (-3 if is_rising else 3, 4),
        textcoords="offset points",
        ha="right" if is_rising else "left",
        color=colour,
    )


def _spread(places: list[float], gap: float) -> list[float]:
    """Move places in 0 to 1 apart to ``gap``, in their order and as little as it takes."""
    order = sorted(range(len(places)), key=lambda i: (places[i], -i))
    spread = list(places)
    for _ in range(50):
        moved = False
        for below, above in pairwise(order):
            lack = gap - (spread[above] - spread[below])
            if lack > 1e-6:
                spread[below] -= lack / 2
                spread[above] += lack / 2
                moved = True
        spread = [min(max(place, 0.0), 1.0) for place in spread]
        if not moved:
            break
    return spread


def _svg(figure: Figure) -> bytes:
    stream = BytesIO()
    nothing = {"Date": None, "Creator": None, "Format": None, "Type": None}
    figure.savefig(stream, format="svg", metadata=nothing, dpi=200)
    return stream.getvalue()
