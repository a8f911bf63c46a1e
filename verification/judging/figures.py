"""Figures of a judged fleet: operating curves, wrong calls against misses, reliability."""

from collections.abc import Sequence

import numpy as np

from solver.arrays import Array
from verification.chapter import Plot
from verification.judging.score import Calibration, FleetScore
from verification.plots import Line, Panel, line_plot

#: Methods that are drawn, by name, and how they are labelled.  Others differ only in a threshold.
_DRAWN = {
    "crew's report (model)": "crew",
    "recorded load factor, maker's rule": "load factor",
    "differenced radio altitude, 600 ft/min": "radio altitude",
    "estimate": "estimate",
    "estimate after assimilation": "assimilated",
    "probability, HARD": "probability",
    "the same, friction measured, HARD": "friction measured",
}

#: What is hoped for: wrong calls among the alarms, missed ones among the hard.
HOPED = (0.05, 0.01)

#: Least share that a logarithmic axis shows.
_LEAST = 1e-5


def figures_of(score: FleetScore) -> tuple[Plot, ...]:
    """All figures."""
    drawn = [each for each in score.methods if each.name in _DRAWN]
    curves = line_plot(
        "judging-operating-curves",
        "Share of hard landings with an alarm against that of sound ones, weighted to service",
        [
            Panel(
                "sound landings with an alarm",
                "hard landings with an alarm",
                [
                    _line(
                        each.name,
                        np.maximum(each.curve.alarms_of_sound, _LEAST),
                        each.curve.alarms_of_hard,
                    )
                    for each in drawn
                ],
                log="x",
                x_limits=(_LEAST, 1.0),
                y_limits=(0.0, 1.02),
            )
        ],
        columns=1,
        height=3.2,
    )
    calls = line_plot(
        "judging-wrong-calls",
        "Wrong calls among the alarms against missed hard landings, over every threshold",
        [
            Panel(
                "hard landings missed",
                "wrong calls among the alarms",
                [
                    _line(each.name, 1.0 - each.curve.alarms_of_hard, each.curve.wrong_calls)
                    for each in drawn
                ],
                x_limits=(0.0, 1.0),
                y_limits=(0.0, 1.02),
                levels=((HOPED[0], "hoped for"),),
            )
        ],
        columns=1,
        height=3.2,
    )
    panels = [
        _reliability_panel(calibration, title)
        for calibration, title in (
            (score.calibration_flown, "as flown"),
            (score.calibration_service, "weighted to service"),
        )
        if calibration is not None
    ]
    if not panels:
        return curves, calls
    reliability = line_plot(
        "judging-reliability",
        "Stated probability that a limit was exceeded, against how often it was, with intervals",
        panels,
        height=3.0,
    )
    return curves, calls, reliability


def _line(name: str, along: Array, up: Array) -> Line:
    """Curve of a method; what is known besides its recording is dashed."""
    place = list(_DRAWN).index(name)
    if place < len(_DRAWN) - 1:
        return Line(along, up, _DRAWN[name], colour=place)
    return Line(along, up, _DRAWN[name], "dashed", colour=place - 1)


def _reliability_panel(calibration: Calibration, title: str) -> Panel:
    stated = np.array([each.stated for each in calibration.bins])
    observed = np.array([each.observed.value for each in calibration.bins])
    ends = np.array([0.0, 1.0])
    bars: Sequence[Line] = [
        Line(
            np.full(2, each.stated),
            np.array([each.observed.lower, each.observed.upper]),
            colour=0,
            width=0.8,
        )
        for each in calibration.bins
    ]
    return Panel(
        "stated",
        "hard landings",
        [
            Line(ends, ends, "", "dashed", colour=2, width=0.8),
            Line(stated, observed, "", "marked", colour=0),
            *bars,
        ],
        title=title,
        is_square=True,
    )
