"""Figures and tables of the three airframes and of the strut forces."""

import numpy as np

from solver.arrays import Array
from solver.flexible_landing.stick import Stick
from solver.landing.history import LandingHistory
from verification.chapter import Plot, Table
from verification.flexible_airframe.study import (
    FULL,
    RIGID,
    STICK,
    Landed,
    Models,
    fitting_flexibility,
    on_ground,
    peak,
)
from verification.plots import Line, Panel, Stroke, line_plot

#: Swings of the legs are faster than this [Hz].
_SLOWEST_SWING = 10.0
#: Rigid first and thin, so that the others are seen on it.
STROKES: dict[str, tuple[Stroke, int, float]] = {
    RIGID: ("solid", 5, 1.0),
    STICK: ("dashed", 1, 1.2),
    FULL: ("solid", 0, 1.4),
}


def stick_plot(stick: Stick) -> Plot:
    """Side view and plan of the beams."""
    points = {station.name: station.point for station in stick.stations}
    lumped = stick.structure.model.point_masses
    masses = np.array([station.point for station in stick.stations]) + lumped.offsets

    def panel(title: str, across: int, label: str) -> Panel:
        lines = [
            Line(masses[:, 0], masses[:, across], stroke="points", colour=3),
        ]
        for inner, outer in stick.bays:
            ends = np.array([points[inner], points[outer]])
            gear = any(station.is_fitting for station in stick.stations if station.name == outer)
            lines.append(Line(ends[:, 0], ends[:, across], colour=1 if gear else 0))
        return Panel("station x [m]", label, lines, title, is_square=True)

    return line_plot(
        "flexible-stick",
        "Stick model of the example aircraft: beams, those that hold the gears' fittings in the "
        "second colour, and the lumped masses at their centres.",
        [panel("from the side", 2, "height z [m]"), panel("from above", 1, "span y [m]")],
        height=2.6,
    )


def frequency_table(models: Models, count: int) -> Table:
    """Lowest frequencies of the stick beside those of the full model."""
    full = models.all_full.circular_frequency[:count] / (2 * np.pi)
    stick = models.all_stick.circular_frequency[:count] / (2 * np.pi)
    return Table(
        "Lowest free frequencies",
        ("mode", "full model [Hz]", "stick [Hz]", "difference [%]"),
        tuple(
            (str(k + 1), f"{a:.3f}", f"{b:.3f}", f"{100 * (b / a - 1):+.1f}")
            for k, (a, b) in enumerate(zip(full, stick, strict=True))
        ),
        "In ascending order each; modes of neighbouring frequency may have changed places.",
    )


def flexibility_table(models: Models) -> Table:
    """Own static flexibility of the fittings."""
    full, stick = fitting_flexibility(models.all_full), fitting_flexibility(models.all_stick)
    names = ("x", "y", "z")
    rows = []
    for index, gear in enumerate(models.aircraft.gears):
        for k, (kind, unit) in enumerate((*[("force", "m/N")] * 3, *[("moment", "rad/(N m)")] * 3)):
            a, b = full[index, k], stick[index, k]
            rows.append(
                (gear.name, f"{kind} {names[k % 3]}", f"{a:.3g} {unit}", f"{b:.3g} {unit}",
                 f"{100 * (b / a - 1):+.0f}")
            )  # fmt: skip
    return Table(
        "Static flexibility of the gears' fittings, free aircraft",
        ("gear", "unit load, body axes", "full model", "stick", "difference [%]"),
        tuple(rows),
    )


def force_plot(landed: Landed, number: int) -> Plot:
    """Strut forces over time, rigid and flexible, in the form of the paper's Figs 20 and 21."""
    panels = []
    for index, gear in enumerate(landed.rigid.gears):
        lines = [
            Line(
                history.time,
                history.gears[index].strut_force / 1e3,
                name,
                stroke=STROKES[name][0],
                colour=STROKES[name][1],
                width=STROKES[name][2],
            )
            for name, history in landed.histories.items()
        ]
        panels.append(Panel("time [s]", "strut force [kN]", lines, gear.name.replace("_", " ")))
    return line_plot(
        f"flexible-struts-{landed.approach.name}",
        f"Strut forces with the rigid and the flexible airframe, {landed.approach.title} "
        f"(form of the paper's Fig. {number}).",
        panels,
        columns=1,
        height=1.75,
    )


def peak_table(all_landed: list[Landed]) -> Table:
    """Peaks of all gears, and what the histories differ by."""
    rows = []
    for landed in all_landed:
        touching = on_ground(landed.rigid, landed.full.history)
        for index in landed.loaded_gears():
            rigid = landed.rigid.gears[index]
            full, stick = (
                history.gears[index] for history in (landed.full.history, landed.stick.history)
            )
            top = peak(rigid)
            apart = np.abs(full.strut_force - rigid.strut_force)
            carried = np.where(touching[index], apart, 0.0)
            rows.append(
                (
                    landed.approach.title,
                    rigid.name.replace("_", " "),
                    f"{top / 1e3:.2f}",
                    f"{peak(stick) / 1e3:.2f}",
                    f"{peak(full) / 1e3:.2f}",
                    f"{100 * (peak(full) / top - 1):+.1f}",
                    f"{100 * float(np.sqrt(np.mean(apart[touching[index]] ** 2))) / top:.1f}",
                    f"{100 * float(carried.max()) / top:.0f} at {instant(landed, carried):.3f} s",
                    f"{100 * float(apart.max()) / top:.0f} at {instant(landed, apart):.3f} s",
                    f"{100 * impulse_change(landed, index):+.1f}",
                )
            )
    return Table(
        "Strut forces with rigid and flexible airframe",
        (
            "approach",
            "gear",
            "peak, rigid [kN]",
            "stick [kN]",
            "full model [kN]",
            "full model against rigid [%]",
            "root mean square of the difference, tyre on the ground [% of the peak]",
            "largest difference at one instant, tyre on the ground",
            "and at any time",
            "impulse, full model against rigid [%]",
        ),
        tuple(rows),
        "Gears that stay below a fifth of the landing's largest strut force are left out. Off the "
        "ground the only force is that with which a strut runs out against its extension stop.",
    )


def instant(landed: Landed, values: Array) -> float:
    """Time of the largest value [s]."""
    return float(landed.rigid.time[int(np.argmax(values))])


def impulse_change(landed: Landed, index: int) -> float:
    """Relative change of the strut force's integral over time by the flexible airframe."""
    rigid = landed.rigid.gears[index].strut_force.sum()
    return float(landed.full.history.gears[index].strut_force.sum() / rigid - 1)


def spring_back_table(all_landed: list[Landed]) -> Table:
    """How fast the legs swing, and the longitudinal forces at their pivots."""
    rows = []
    for landed in all_landed:
        for index in landed.loaded_gears():
            for name, history in landed.histories.items():
                gear = history.gears[index]
                force = gear.wrench[:, 0] / 1e3
                rows.append(
                    (
                        landed.approach.title,
                        gear.name.replace("_", " "),
                        name,
                        f"{swing_frequency(history, index):.1f}",
                        f"{-force.min():.1f}",
                        f"{force.max():.1f}",
                    )
                )
    return Table(
        "Spring-back on the rigid and on the flexible airframe",
        (
            "approach",
            "gear",
            "airframe",
            "frequency of the swing [Hz]",
            "largest force aft [kN]",
            "largest force forward [kN]",
        ),
        tuple(rows),
        "Frequency of the strongest line of the swing's spectrum while the tyre is on the ground.",
    )


def swing_frequency(history: LandingHistory, index: int) -> float:
    """Strongest frequency of a leg's fore-aft swing in its first stay on the ground [Hz]."""
    gear = history.gears[index]
    carries = np.flatnonzero(gear.ground_force[:, 2] < 0.0)
    gaps = np.flatnonzero(np.diff(carries) > 1)
    last = carries[gaps[0]] if len(gaps) else carries[-1]
    swing = gear.bending_angle[carries[0] : last + 1]
    step = float(history.time[1])
    count = 1 << 14
    lines = np.abs(np.fft.rfft((swing - swing.mean()) * np.hanning(len(swing)), count))
    frequencies = np.fft.rfftfreq(count, step)
    # The slow bending under rolling drag is not the swing.
    lines[frequencies < _SLOWEST_SWING] = 0.0
    return float(frequencies[int(np.argmax(lines))])
