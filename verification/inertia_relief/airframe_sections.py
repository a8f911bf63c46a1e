"""Sections of the chapter on inertia relief about the example airframe and a small winged body."""

from dataclasses import dataclass
from math import radians

import numpy as np

from solver.aircraft.airframe import Airframe, load_airframe
from solver.aircraft.bizjet import build_bizjet
from solver.arrays import Array
from solver.inertia_relief.basis import BasisSettings
from solver.inertia_relief.build import reduced_model
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import LandingLoads
from solver.inertia_relief.reduced import ReducedModel
from solver.landing.contact import Contact
from verification.chapter import Comparisons, Item, Table, Text
from verification.comparison import Comparison
from verification.inertia_relief.airframe_supports import support_study
from verification.inertia_relief.landings import (
    mass_differences,
    random_residuals,
    simulated_loads,
)
from verification.inertia_relief.omitted_terms import OMISSIONS, Worth, peaks_of, worth
from verification.inertia_relief.spin_up_section import LandingRate
from verification.inertia_relief.time_steps import (
    DAMPING,
    frame_choice,
    linear_load_change,
    newmark_error,
    recursion_error,
)
from verification.inertia_relief.winged_body import reduced, winged_body
from verification.plots import Line, Panel, bar_plot, line_plot
from verification.run import Run

ROUNDING = "rounding"
#: Roll rate of the fast-rolling landing, and of the others whose terms are left out [deg/s].
ROLL_RATE, OTHER_ROLL_RATES = 30.0, (10.0, 60.0)


@dataclass(frozen=True, slots=True)
class Example:
    """The airframe that the chapter works on."""

    airframe: Airframe
    model: ReducedModel

    @property
    def factors(self) -> Array:
        """Fuel on one side, bays half full."""
        factors = np.full(len(self.airframe.groups), 0.5)
        factors[0] = 0.8
        return factors

    def rolling_landing(self, roll_rate: float = ROLL_RATE) -> LandingLoads:
        """One gear first, wing going down at ``roll_rate`` [deg/s]."""
        contact = Contact(
            sink_rate=2.4,
            ground_speed=60.0,
            pitch=radians(4.0),
            roll=radians(6.0),
            drift=radians(3.0),
            roll_rate=radians(roll_rate),
            pitch_rate=radians(3.0),
        )
        return simulated_loads(self.airframe, self.factors, contact, 1.0)

    def landing_rate(self) -> LandingRate:
        """Fastest rotation of the plotted landing beside the lowest frequency."""
        rate = np.linalg.norm(self.rolling_landing().motion.rate, axis=1).max()
        lowest = assemble(self.model, self.factors).circular_frequency.min()
        return LandingRate(float(rate), float(lowest))


def example(run: Run) -> Example:
    """Full-size aircraft, or in the short form one of a coarse mesh."""
    if not run.quick:
        return Example(run.airframe, run.reduced)
    folder = run.folder / "coarse-aircraft"
    build_bizjet(folder, refinement=0.25)
    airframe = load_airframe(folder)
    return Example(airframe, reduced_model(airframe, settings=BasisSettings(modes=40)))


def time_step_section(quick: bool) -> list[Item]:
    """Second order in time, and independence of the axes, on a small winged body."""
    newmark = newmark_error(3 if quick else 6, 0.1 if quick else 0.3)
    winged = winged_body(6, 8)
    model = reduced(winged, BasisSettings(modes=30), DAMPING)
    recursion = recursion_error(winged, model)
    linear = linear_load_change(winged, model)
    choices = frame_choice((3,) if quick else (3, 8, 21))
    rows = (
        Comparison(
            "full order (Newmark): power of the time step",
            newmark.order,
            2.0,
            0.1,
            "1",
            "theory, average acceleration",
            "fitted over all steps shown",
        ),
        Comparison(
            "reduced recursion: power of the sampling interval",
            recursion.order,
            2.0,
            0.15,
            "1",
            "theory, loads linear between samples",
            "fitted over all intervals shown, the coarsest of which no longer resolves the pulses",
        ),
        Comparison(
            "reduced recursion, loads truly linear between samples: change by 8 times finer steps",
            linear,
            0.0,
            1e-6,
            "1",
            "closed form of every mode",
            "rounding of single precision in which the coordinates are handed on",
            scale=1.0,
        ),
        Comparison(
            "another origin and turned axes, full order: change of any element's peak",
            max(choice.full_order for choice in choices),
            0.0,
            1e-6,
            "1",
            "frame independence",
            "rounding, for elements of any stress",
            scale=1.0,
        ),
        Comparison(
            "another origin and turned axes, reduced: change of elements above 20 %",
            max(choice.reduced for choice in choices),
            0.0,
            1e-3,
            "1",
            "frame independence",
            "0.1 %: the basis weighs loads by axis, so it cuts off elsewhere in turned axes",
            scale=1.0,
        ),
    )
    plot = line_plot(
        "time-steps",
        "Largest error of the displacement over a landing of a small winged body, with all W terms,"
        " relative to the largest displacement. Both fall with the square of the step.",
        [
            Panel(
                "time step, sampling interval (s)",
                "error (1)",
                [
                    Line(newmark.steps, newmark.errors, f"Newmark, {newmark.order:.2f}", "marked"),
                    Line(
                        recursion.steps,
                        recursion.errors,
                        f"recursion, {recursion.order:.2f}",
                        "marked",
                    ),
                ],
                log="xy",
            )
        ],
        columns=1,
    )
    return [Comparisons("Time steps and choice of axes", rows), plot]


def balance_section(given: Example, run: Run) -> list[Item]:
    """Equilibrium residual of random landings, mass of both models, choice of the support."""
    count = 6 if run.quick else 20
    residuals = random_residuals(given.airframe, given.model, count)
    run.progress("random landings", 0.5)
    rigid, small = mass_differences(given.airframe, given.model, count)
    run.progress("random landings", 1.0)
    rows = [
        Comparison(
            f"equilibrium residual of {count} random landings, largest",
            float(residuals.max()),
            0.0,
            1e-12,
            "1",
            "loads of the rigid-body model balance its motion",
            "rounding: sums of some hundred thousand products",
            scale=1.0,
        )
    ]
    for model, difference in (("rigid-body model", rigid), ("reduced model", small)):
        rows += [
            Comparison(
                f"{model} at {count} random loadings: {what}",
                value,
                0.0,
                1e-11,
                "1",
                "Φᵀ M Φ of the mass matrix",
                ROUNDING,
                scale=1.0,
            )
            for what, value in (
                ("mass", difference.mass),
                ("centre of gravity over radius of gyration", difference.centre_of_gravity),
                ("inertia tensor", difference.inertia),
            )
        ]
    study = support_study(given.airframe, given.factors, given.rolling_landing())
    rows += [
        Comparison(
            f"airframe held at the {held.name}: difference of stress",
            held.difference,
            0.0,
            1e-6,
            "1",
            "inertia relief on a support of its own choice",
            "rounding, amplified by the condition of a stiffness held at one node",
            scale=1.0,
        )
        for held in study.supports
    ]
    table = Table(
        "The same airframe held at the node nearest to its centre of gravity, one term left out",
        ("term left out", "largest change / largest stress", "largest stress / complete"),
        tuple((o.name, f"{o.difference:.3g}", f"{o.largest:.3g}") for o in study.omissions),
        f"At {study.time:.3f} s, the largest angular acceleration of the rolling landing. The"
        " support takes whatever the loads lack: a term that is missing comes back as a reaction,"
        " and the stress is that of the reaction. In mean axes nothing is held and no such stress"
        " arises, but the check of balance refuses the landing.",
    )
    plot = line_plot(
        "equilibrium-residuals",
        "Imbalance of the right-hand side of eq (15) over the loads in it, largest of each random"
        " landing. Above 1e-8 a landing is refused.",
        [
            Panel(
                "random landing",
                "residual (1)",
                [Line(np.arange(1.0, count + 1), residuals, "", "points")],
                log="y",
                y_limits=(1e-16, 1e-7),
                levels=((1e-8, "refused above"),),
            )
        ],
        columns=1,
        height=1.6,
    )
    return [Comparisons("Balance", tuple(rows)), plot, table]


def omission_section(given: Example, run: Run) -> list[Item]:
    """Each W term left out in turn."""
    loading = assemble(given.model, given.factors)
    roll_rates = (ROLL_RATE, *(() if run.quick else OTHER_ROLL_RATES))
    found: list[list[Worth]] = []
    for index, roll_rate in enumerate(roll_rates):
        loads = given.rolling_landing(roll_rate)
        found.append(worth(loading, loads, peaks_of(loading, loads)))
        run.progress("terms left out", (index + 1) / len(roll_rates))
    shown = found[0]
    rows = tuple(
        (
            omission.name,
            *(f"{100 * landing[index].largest:.2f}" for landing in found),
            *(f"{100 * landing[index].peak:+.2f}" for landing in found),
            f"{100 * shown[index].unbalanced:.1f}",
        )
        for index, omission in enumerate(OMISSIONS)
    )
    degrees = [f"{rate:.0f}°/s" for rate in roll_rates]
    table = Table(
        "Terms of the turning frame left out in turn, in landings on one gear first",
        (
            "term left out",
            *(f"stress, {name} (%)" for name in degrees),
            *(f"peak, {name} (%)" for name in degrees),
            "imbalance (% of weight)",
        ),
        rows,
        "Stress: largest change of the peak of any element above 20 % of the global peak. Peak:"
        " change of the global peak. Imbalance: resultant of the term left out, at the first roll"
        " rate. 2 M W u' stands for Coriolis and gyroscopic terms together.",
    )
    plot = bar_plot(
        "omitted-terms",
        f"Largest change of any element's peak stress above 20 % of the global peak if a term is"
        f" left out; landing on one gear, {ROLL_RATE:.0f} degrees of roll per second.",
        [entry.name for entry in shown],
        [100 * entry.largest for entry in shown],
        "change of peak stress (%)",
    )
    euler = next(entry for entry in shown if entry.name.startswith("r: Euler"))
    rows_compared = (
        Comparison(
            "leaving out M W' r in mean axes: change of any element's peak",
            euler.everywhere,
            0.0,
            1e-5,
            "1",
            "M W' r is M times a rigid motion, orthogonal to every elastic mode",
            "single precision of the reduced stress rows",
            scale=1.0,
        ),
    )
    note = Text(
        "The d'Alembert loads of linear and angular acceleration, M a and M W' r, deform nothing in"
        " mean axes: they are M times a rigid motion, and what they balance is balanced by the"
        f" frame itself. Their resultant is large, {100 * euler.unbalanced:.0f} % of the weight"
        " here, which is why the same omission ruins a structure that is held at a node."
    )
    return [table, plot, Comparisons("Angular acceleration in mean axes", rows_compared), note]
