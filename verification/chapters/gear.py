"""Gear: the drop test of NACA Report 1154 by three ways, convergence, energy, force laws."""

from dataclasses import dataclass

import numpy as np

from solver.gear.drop_test import DropTestResult, drop_test
from solver.landing.history import LandingHistory
from verification.chapter import Chapter, Comparisons, Item, Plot, Table, Text
from verification.comparison import Comparison
from verification.gear.convergence import DURATION, SETTLED, convergence
from verification.gear.digitised import DigitisedCurve, digitised_curves
from verification.gear.naca1154 import CERTAINTY, DropTestSet
from verification.gear.one_gear_landing import ground_force, one_gear_landing
from verification.gear.strut_laws import oleo_comparisons, oleo_plot
from verification.gear.two_phase import TwoPhaseSolution, two_phase_solution
from verification.gear.tyre_laws import tyre_comparisons, tyre_plot
from verification.plots import Line, Panel, line_plot
from verification.run import Run

TWO_PHASE = (
    "independent solution of the equations of NACA Report 1154 in two phases, Radau at 1e-12"
)


@dataclass(frozen=True, slots=True)
class _DropTests:
    """The same drop by three ways."""

    given: DropTestSet
    reference: TwoPhaseSolution
    found: DropTestResult
    landing: LandingHistory


def chapter(run: Run) -> Chapter:
    """Compute and describe."""
    run.progress("drop test", 0.0)
    given = DropTestSet()
    parameters = given.in_si()
    tests = _DropTests(
        given,
        two_phase_solution(given, DURATION),
        drop_test(parameters),
        one_gear_landing(parameters, DURATION),
    )
    curves = digitised_curves()
    run.progress("drop test", 0.3)
    budget, spread = _budget(given, tests.found)
    run.progress("convergence", 0.5)
    plot, orders = convergence(given, tests.reference)
    run.progress("force laws", 0.9)
    gears = run.airframe.definition.gears
    tyres = {gear.name.partition("_")[0]: gear.tyre for gear in gears}
    items: list[Item] = [
        Text(
            "A gear falls with its load on a level ground while a lift acts on it: the test of "
            "NACA Report 1154 (Milwitzky and Cook, 1953), which the paper repeats in its Figs 13 "
            "and 14. It is computed by three ways: by the drop test of the solver, by the landing "
            "simulation with one gear under one mass, and by an integration of the report's "
            "equations that shares nothing with either."
        ),
        Text(
            "Values measured or plotted in the report were not at hand. What is shown is "
            "agreement with the converged solution of its equations for the parameters of "
            "the table below, not agreement with its experiment. Digitised curves can be laid "
            "into verification/digitised; "
            + ("they are drawn and compared." if curves else "none is there in this run.")
        ),
        _histories_plot(tests, curves),
        Comparisons("Drop test against the two-phase solution", _drop_comparisons(tests)),
        Comparisons("Landing simulation of the same gear", _landing_comparisons(tests)),
    ]
    if curves:
        items.append(Comparisons("Against digitised curves", _digitised(tests, curves, spread)))
    items += [
        budget,
        plot,
        Comparisons("Orders of convergence", orders),
        _energy_plot(tests.landing),
        Comparisons("Energy", _energy_comparisons(tests)),
        Text(
            "The force laws follow. The strut is that of the drop test; the tyres are those of "
            "the example aircraft."
        ),
        oleo_plot(parameters),
        Comparisons("Laws of the strut", oleo_comparisons(parameters)),
        tyre_plot(tyres["main"], "main gear"),
        Comparisons("Laws of the tyres", tyre_comparisons(tyres)),
    ]
    run.progress("force laws", 1.0)
    return Chapter("gear", "Gear and tyre", tuple(items))


def _histories_plot(tests: _DropTests, curves: tuple[DigitisedCurve, ...]) -> Plot:
    """Force and stroke against time, and beneath them the distance from the reference."""
    ours, landing, reference = tests.found.history, tests.landing, tests.reference
    shown = ours.time <= DURATION
    later = landing.time > SETTLED
    time = landing.time[later]
    forces = [
        Line(reference.time, reference.ground_force / 1e3, "two-phase solution", colour=1, width=3),
        Line(ours.time[shown], ours.ground_force[shown] / 1e3, "drop test", colour=0),
    ]
    strokes = [
        Line(reference.time, reference.stroke * 1e3, "two-phase solution", colour=1, width=3),
        Line(ours.time[shown], ours.stroke[shown] * 1e3, "drop test", colour=0),
    ]
    for curve in curves:
        lines, factor = (forces, 1e-3) if curve.quantity == "force" else (strokes, 1e3)
        lines.append(Line(curve.time, curve.value * factor, "digitised", "points", colour=2))
    force_error = ground_force(landing)[later] - reference.force_at(time)
    stroke_error = landing.gears[0].stroke[later] - reference.stroke_at(time)
    return line_plot(
        "gear-drop-test",
        "Drop test of NACA Report 1154 at 8.86 ft/s: force of the ground and stroke against time, "
        "in the form of the paper's Figs 13 and 14, with the two-phase solution beneath the "
        "solver's; below, how far the landing simulation with its elastic stop is from it.",
        [
            Panel("time [s]", "force [kN]", forces, "Force of the ground"),
            Panel("time [s]", "stroke [mm]", strokes, "Stroke"),
            Panel(
                "time [s]",
                "difference [N]",
                [Line(time, force_error, "landing", colour=0)],
                "Landing simulation less two-phase solution: force",
            ),
            Panel(
                "time [s]",
                "difference [mm]",
                [Line(time, stroke_error * 1e3, "landing", colour=0)],
                "… and stroke",
            ),
        ],
    )


def _drop_comparisons(tests: _DropTests) -> tuple[Comparison, ...]:
    value = "both are integrated to 1e-10 or finer in each step"
    flat = "a peak is flat, so that its instant is known to the root of what its value is"
    figures = (
        ("break-out of the strut", "breakout_time", "s", 1e-9, value),
        ("peak force of the ground", "peak_ground_force", "N", 1e-8, value),
        ("time of the peak force", "peak_ground_force_time", "s", 1e-7, flat),
        ("largest stroke", "maximum_stroke", "m", 1e-8, value),
        ("time of the largest stroke", "maximum_stroke_time", "s", 1e-7, flat),
        ("largest deflection of the tyre", "peak_tyre_deflection", "m", 1e-8, value),
        ("largest closure speed", "maximum_closure_speed", "m/s", 1e-8, value),
        ("peak acceleration of the upper mass", "peak_upper_acceleration", "m/s2", 1e-8, value),
    )
    return tuple(
        Comparison(
            words,
            getattr(tests.found, name),
            getattr(tests.reference, name),
            tolerance,
            unit,
            TWO_PHASE,
            reason,
        )
        for words, name, unit, tolerance, reason in figures
    )


def _landing_comparisons(tests: _DropTests) -> tuple[Comparison, ...]:
    landing, reference = tests.landing, tests.reference
    later = landing.time > SETTLED
    force = ground_force(landing)[later]
    stroke = landing.gears[0].stroke[later]
    time = landing.time[later]
    stop = (
        "the stop at full extension yields, 0.1 mm under the preload; the difference falls in "
        "proportion to its compliance, as the figure on convergence shows"
    )
    return (
        Comparison(
            "peak force of the ground, one gear landing",
            float(force.max()),
            reference.peak_ground_force,
            5e-4,
            "N",
            TWO_PHASE,
            stop,
        ),
        Comparison(
            "largest stroke, one gear landing",
            float(stroke.max()),
            reference.maximum_stroke,
            1e-3,
            "m",
            TWO_PHASE,
            stop,
        ),
        Comparison(
            "largest distance of the force curves over the peak",
            float(np.max(np.abs(force - reference.force_at(time)))) / reference.peak_ground_force,
            0.0,
            5e-3,
            "",
            TWO_PHASE,
            "as above; after the break-out the delayed start of the strut shows as a phase",
            scale=1.0,
        ),
        Comparison(
            "largest distance of the stroke curves over the largest",
            float(np.max(np.abs(stroke - reference.stroke_at(time)))) / reference.maximum_stroke,
            0.0,
            3e-3,
            "",
            TWO_PHASE,
            stop,
            scale=1.0,
        ),
    )


def _digitised(
    tests: _DropTests, curves: tuple[DigitisedCurve, ...], spread: float
) -> tuple[Comparison, ...]:
    ours = tests.found.history
    values = {"force": ours.ground_force, "stroke": ours.stroke}
    return tuple(
        Comparison(
            f"{curve.quantity}, root mean square of the distance over the largest",
            curve.difference(ours.time, values[curve.quantity]),
            0.0,
            max(spread, 0.02),
            "",
            "curve digitised from NACA Report 1154",
            "what the uncertain parameters of the table leave open, 2 % at least for the reading",
            scale=1.0,
        )
        for curve in curves
    )


def _budget(given: DropTestSet, found: DropTestResult) -> tuple[Table, float]:
    """Parameters with what speaks for them, and the uncertainty of the peak force from them."""
    rows, total = [], 0.0
    for value in CERTAINTY:
        effect = ""
        if value.spread:
            changed = drop_test(given.changed(value.name, 1 + value.spread).in_si())
            force = changed.peak_ground_force / found.peak_ground_force - 1
            total += force**2
            effect = f"{100 * force:+.2f}".replace("-", "−")
        spread = f"{100 * value.spread:.1f}" if value.spread else "–"
        number = f"{getattr(given, value.name):,.7g}".replace(",", "")
        rows.append((value.symbol, number, value.unit, value.evidence, spread, effect or "–"))
    total = float(np.sqrt(total))
    table = Table(
        "Parameters of the drop test, what speaks for each, and what its uncertainty does",
        ("symbol", "value", "unit", "evidence", "allowed for [%]", "peak force [%]"),
        tuple(rows),
        f"Together, as the root of the sum of squares: {100 * total:.1f} % of the peak force.",
    )
    return table, total


def _energy_plot(landing: LandingHistory) -> Plot:
    account, time = landing.energy, landing.time
    stored = account.kinetic + account.potential
    lost = account.dissipated_hydraulic + account.dissipated_tyre + account.dissipated_other
    parts = (
        ("motion and height", stored - stored[0] + account.impact_energy - account.lift_work),
        ("tyre", account.tyre),
        ("gas", account.gas - account.gas[0]),
        ("oil", lost),
    )
    total = np.sum([values for _, values in parts], axis=0) + account.stops - account.stops[0]
    return line_plot(
        "gear-energy",
        "Where the energy of the falling gear is: motion and height (the work of the lift taken "
        "off), tyre, gas, and what the oil has turned into heat, from contact on; their sum.",
        [
            Panel(
                "time [s]",
                "energy [kJ]",
                [
                    *[Line(time, values / 1e3, words) for words, values in parts],
                    Line(time, total / 1e3, "sum", "dashed"),
                ],
            )
        ],
    )


def _energy_comparisons(tests: _DropTests) -> tuple[Comparison, ...]:
    return (
        Comparison(
            "imbalance of the drop test over the impact energy",
            tests.found.energy_error,
            0.0,
            1e-8,
            "",
            "conservation of energy",
            "steps are taken to 1e-10, a hundred times finer",
            scale=1.0,
        ),
        Comparison(
            "imbalance of the landing over the impact energy",
            tests.landing.energy.closure_error,
            0.0,
            1e-6,
            "",
            "conservation of energy",
            "tolerance of a step",
            scale=1.0,
        ),
    )
