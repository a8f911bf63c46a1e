"""How the landing simulation of the drop test converges, over its steps and over its stop."""

import numpy as np

from solver.arrays import Array
from solver.landing.history import LandingHistory
from verification.chapter import Plot
from verification.comparison import Comparison
from verification.gear.naca1154 import DropTestSet
from verification.gear.one_gear_landing import ground_force, one_gear_landing
from verification.gear.two_phase import TwoPhaseSolution
from verification.plots import Line, Panel, line_plot

#: Followed time; the tyre is still on the ground at its end [s].
DURATION = 0.3
#: Curves are compared from here on, after the transient of the break-out [s].
SETTLED = 0.02


def convergence(
    given: DropTestSet, reference: TwoPhaseSolution
) -> tuple[Plot, tuple[Comparison, ...]]:
    """Distance from the limit over the step's tolerance and over the stop's stiffness."""
    parameters = given.in_si()
    tolerances = 10.0 ** -np.arange(3.0, 12.0)
    finest = one_gear_landing(parameters, DURATION, tolerance=1e-12, interval=0.01)
    by_step = [
        _distance(
            one_gear_landing(parameters, DURATION, tolerance=tolerance, interval=0.01),
            ground_force(finest),
            finest.gears[0].stroke,
        )
        for tolerance in tolerances
    ]
    stops = np.logspace(6.5, 10, 8)
    by_stop = []
    for stiffness in stops:
        history = one_gear_landing(
            parameters, DURATION, float(stiffness), tolerance=1e-10, interval=2e-3
        )
        by_stop.append(
            _distance(history, reference.force_at(history.time), reference.stroke_at(history.time))
        )
    step, stop = np.array(by_step), np.array(by_stop)
    stiff = stops >= 1e8
    steps = 10.0 ** np.array([-10.5, -2.5])
    plot = line_plot(
        "gear-convergence",
        "Largest distance of force and stroke over the landing simulation of the drop test, each "
        "over its peak: from its own limit against the tolerance of a step (the solver's own is "
        "1e-6), and from the two-phase solution against the stiffness of the extension stop (the "
        "solver's own is 2e7 N/m). Dotted: in proportion.",
        [
            Panel(
                "tolerance of a step",
                "relative distance",
                [
                    Line(steps, steps, "proportional", "dotted", colour=2),
                    Line(tolerances, step[:, 0], "force", "marked", colour=0),
                    Line(tolerances, step[:, 1], "stroke", "marked", colour=1),
                ],
                "Step control",
                log="xy",
            ),
            Panel(
                "stiffness of the stop [N/m]",
                "relative distance",
                [
                    Line(
                        stops, stop[-1, 0] * stops[-1] / stops, "proportional", "dotted", colour=2
                    ),
                    Line(stops, stop[:, 0], "force", "marked", colour=0),
                    Line(stops, stop[:, 1], "stroke", "marked", colour=1),
                ],
                "Stop at full extension",
                log="xy",
            ),
        ],
    )
    own = np.argmin(np.abs(tolerances - 1e-6))
    rows = (
        Comparison(
            "distance of the force at the solver's own tolerance",
            float(step[own, 0]),
            0.0,
            1e-5,
            "",
            "the same simulation at a tolerance of 1e-12",
            "ten times the tolerance of one step, for what steps add up to",
            scale=1.0,
        ),
        Comparison(
            "order in the tolerance of a step",
            _slope(tolerances, step[:, 0]),
            1.0,
            0.25,
            "",
            "error per step in proportion to the tolerance (Hairer, Norsett and Wanner, II.4)",
            "steps that the contact and the stop cut short scatter the points",
        ),
        Comparison(
            "order in the compliance of the stop, force",
            -_slope(stops[stiff], stop[stiff, 0]),
            1.0,
            0.25,
            "",
            "the stop's deflection under the preload is in proportion to its compliance",
            "the phase in which the strut leaves a softer stop scatters the points",
        ),
        Comparison(
            "order in the compliance of the stop, stroke",
            -_slope(stops[stiff], stop[stiff, 1]),
            1.0,
            0.25,
            "",
            "the stop's deflection under the preload is in proportion to its compliance",
            "the phase in which the strut leaves a softer stop scatters the points",
        ),
    )
    return plot, rows


def _distance(history: LandingHistory, force: Array, stroke: Array) -> tuple[float, float]:
    later = history.time > SETTLED
    forces = np.abs(ground_force(history) - force)[later].max() / force.max()
    strokes = np.abs(history.gears[0].stroke - stroke)[later].max() / stroke.max()
    return float(forces), float(strokes)


def _slope(x: Array, y: Array) -> float:
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])
