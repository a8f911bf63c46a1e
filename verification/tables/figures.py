"""Figures of the landings: attitudes, stress against time, fields side by side, peaks."""

import numpy as np

from solver.aircraft.airframe import Airframe
from solver.arrays import Array
from solver.frames import body_structural, euler_from_quaternion, rotation_matrix
from solver.gear.parameters import Gear
from solver.landing.history import GearHistory, LandingHistory
from verification.chapter import Plot
from verification.plots import Line, Panel, airframe_plot, line_plot
from verification.tables.agreement import Followed
from verification.tables.landings import Landed


def wheel_height(history: LandingHistory, gear: Gear, found: GearHistory) -> Array:
    """Height (nt,) of a free tyre's lowest point above the ground, negative when pressed [m].

    The swing of the leg, which lifts the wheel by its square only, is left out.
    """
    length = (gear.strut.extended_length - found.stroke)[:, None]
    arm = body_structural(gear.pivot + length * gear.axis - history.origin)
    below = rotation_matrix(history.attitude)[:, 2]
    axle = -(history.position[:, 2] + np.einsum("ti,ti->t", below, arm))
    crown = gear.tyre.tread_radius
    upright = np.sqrt(1.0 - below[:, 1] ** 2)
    return np.asarray(axle - crown - (gear.tyre.free_radius - crown) * upright)


def sequence_plot(airframe: Airframe, landed: Landed) -> Plot:
    """Draw attitudes, heights of the wheels and their loads."""
    history, count = landed.history, len(landed.loads.time)
    time = landed.loads.time
    gears = airframe.landing_aircraft(landed.factors).gears
    roll, pitch, _ = (
        np.degrees(angle[:count]) for angle in euler_from_quaternion(history.attitude)
    )
    names = [found.name.replace("_", " ") for found in history.gears]
    heights = [
        Line(time, 100 * wheel_height(history, gear, found)[:count], name)
        for gear, found, name in zip(gears, history.gears, names, strict=True)
    ]
    forces = [
        Line(time, -1e-3 * found.ground_force[:count, 2], name)
        for found, name in zip(history.gears, names, strict=True)
    ]
    angles = [Line(time, pitch, "pitch", colour=3), Line(time, roll, "roll", colour=4)]
    return line_plot(
        f"tables-sequence-{landed.case.name}",
        f"{landed.case.title}: attitude, height of each free tyre's lowest point above the ground "
        "(negative: how far it is pressed) and vertical load of each gear.",
        [
            Panel("time [s]", "pitch, roll [deg]", angles),
            Panel("time [s]", "height [cm]", heights, levels=[(0.0, "ground")]),
            Panel("time [s]", "vertical load [kN]", forces),
        ],
        columns=3,
    )


def history_plot(followed: list[Followed]) -> Plot:
    """Draw the largest stress of all elements against time."""
    panels = [
        Panel(
            "time [s]",
            "largest stress [MPa]",
            [
                Line(
                    one.landed.loads.time,
                    1e-6 * analysis.largest,
                    name,
                    "dashed" if index else "solid",
                    width=(2.4, 1.4, 0.9)[index],
                )
                for index, (name, analysis) in enumerate(one.analyses)
            ],
            one.title,
        )
        for one in followed
    ]
    return line_plot(
        "tables-largest",
        "Largest von Mises stress of all elements at every sample.",
        panels,
        columns=1,
        height=1.9,
    )


def field_plot(airframe: Airframe, followed: Followed) -> Plot:
    """Draw nonlinear and full-order stresses side by side at the peak of each gear's load."""
    pairs = []
    for peak in followed.landed.peaks:
        row = followed.landed.field(peak)
        time = followed.landed.loads.time[peak.sample]
        for name, analysis in followed.analyses[:2]:
            words = f"{peak.gear.replace('_', ' ')}, {time:.3f} s: {name}"
            pairs.append((words, 1e-6 * analysis.fields[row]))
    return airframe_plot(
        f"tables-fields-{followed.landed.case.name}",
        f"{followed.title}: stress at the peak of each gear's vertical load, nonlinear analysis "
        "(left) and extended inertia relief at full order (right), one scale for all.",
        airframe.structure.model,
        pairs,
        "von Mises stress [MPa]",
    )


def peaks_plot(followed: list[Followed]) -> Plot:
    """Draw every element's peak, full order over nonlinear."""
    panels = []
    for one in followed:
        nonlinear, full = one.nonlinear.stress.peak / 1e6, one.full.stress.peak / 1e6
        ends = np.array([0.0, nonlinear.max()])
        panels.append(
            Panel(
                "nonlinear [MPa]",
                "EIR, full order [MPa]",
                [
                    Line(ends, ends, width=0.6, colour=4),
                    Line(nonlinear, full, stroke="points", colour=0),
                ],
                one.title.split(":")[0],
            )
        )
    return line_plot(
        "tables-peaks",
        "Largest von Mises stress of every element over each landing; the line is equality.",
        panels,
        columns=3,
        height=2.2,
    )
