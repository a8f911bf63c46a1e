"""Whole airframes by themselves: free flight, the linear limit, and what a step costs."""

from dataclasses import asdict

import numpy as np

from verification.chapter import Comparisons, Item, Table, Text
from verification.comparison import Comparison
from verification.nonlinear.free_airframe import (
    FreeFlight,
    coarse_airframe,
    free_flight,
    rigid_turn_forces,
    step_cost,
)
from verification.nonlinear.small_loads import small_loads
from verification.plots import Line, Panel, line_plot
from verification.run import Run

#: What a stored flight rests on.
SOURCES = (
    "solver/nonlinear",
    "solver/fe",
    "solver/aircraft",
    "verification/nonlinear/free_airframe.py",
)
#: Share of all tanks and bays that is filled.
FILL = 0.4


def airframe_flight(run: Run) -> tuple[Item, ...]:
    """Let the coarse airframe turn freely and the full one turn rigidly."""
    airframe = coarse_airframe(run.folder / "coarse")
    factors = np.full(len(airframe.groups), FILL)
    end = 0.2 if run.quick else 2.6

    def flown(step: float) -> FreeFlight:
        every = round(4e-3 / step)
        arrays = run.stored(
            f"nonlinear-free-flight-{step:g}",
            (airframe.content_hash, factors, step, end, every),
            SOURCES,
            lambda: asdict(free_flight(airframe, factors, step, end, every, run.progress)),
        )
        return FreeFlight(**arrays)

    flights = {step: flown(step) for step in (2e-3, 1e-3)}
    fine, coarse = flights[1e-3], flights[2e-3]
    ringing = fine.strain.max()
    drift = {
        step: float(
            np.abs(flight.kinetic + flight.strain - flight.kinetic[0] - flight.strain[0]).max()
        )
        / ringing
        for step, flight in flights.items()
    }
    run.progress("rigid turn", 0.0)
    full = run.airframe
    turned, displaced = rigid_turn_forces(full, np.full(len(full.groups), FILL))
    run.progress("rigid turn", 1.0)
    rows = (
        Comparison(
            "largest force after a rigid turn of the full airframe, relative to that of 1 um at "
            "one node", turned / displaced, 0.0, 1e-3, "", "closed form", "rounding of positions",
            1.0,
        ),
        Comparison(
            "change of angular momentum in free flight", fine.momentum_error, 0.0, 1e-8, "",
            "conservation", "kept to the tolerance of the iteration", 1.0,
        ),
        Comparison(
            "change of momentum in free flight, relative to mass times tip speed",
            float(np.abs(fine.momenta[:, :3]).max() * np.ptp(airframe.centroids)
                  / np.linalg.norm(fine.momenta[0, 3:])), 0.0, 1e-8, "", "conservation",
            "kept to the tolerance of the iteration", 1.0,
        ),
        Comparison(
            "change of energy in free flight, relative to the largest strain energy", drift[1e-3],
            0.0, 1e-4, "", "conservation", "second order in the step, without a trend", 1.0,
        ),
    )  # fmt: skip
    figure = line_plot(
        "nonlinear-free-flight",
        "Coarse airframe turning freely at 2.5 rad/s, undamped: strain energy of the ringing, and "
        "change of the whole energy relative to its largest value, for two steps.",
        [
            Panel("time [s]", "strain energy [J]", [Line(fine.time, fine.strain)], "ringing"),
            Panel(
                "time [s]",
                "change of energy / ringing [-]",
                [
                    Line(
                        flight.time,
                        (flight.kinetic + flight.strain - flight.kinetic[0]) / ringing,
                        f"{1e3 * step:g} ms",
                        width=0.6,
                    )
                    for step, flight in flights.items()
                ],
                "account",
            ),
        ],
    )
    return (
        Text(
            f"A whole airframe, coarse, flies without loads, gravity and damping for {end:g} s and "
            f"turns by {np.degrees(fine.turned[-1]):.0f} degrees about no principal axis, ringing "
            "under the centrifugal load that meets it at the start. Nothing holds or leads it. "
            f"Halving the step divides the change of energy by {drift[2e-3] / drift[1e-3]:.1f} "
            f"(turns of both steps differ by {abs(coarse.turned[-1] - fine.turned[-1]):.1e} rad)."
        ),
        figure,
        Comparisons("Free flight of an airframe", rows),
    )


def linear_limit(run: Run) -> tuple[Item, ...]:
    """Scale loads down until the linear answer must come out."""
    airframe = coarse_airframe(run.folder / "coarse")
    factors = np.full(len(airframe.groups), FILL)
    rows = []
    for index, factor in enumerate((1e-1, 1e-2, 1e-3)):
        run.progress("small loads", index / 3)
        found = small_loads(airframe, factors, factor)
        rows.append((factor, found.difference, float(found.linear.max())))
    run.progress("small loads", 1.0)
    smallest = rows[-1]
    compared = Comparison(
        "largest difference of stress at a thousandth of the loads", smallest[1], 0.0, 1e-3, "",
        "full-order extended inertia relief, same steps", "second order in the loads", 1.0,
    )  # fmt: skip
    order = np.log10(rows[-2][1] / rows[-1][1])
    proportion = Comparison(
        "power of the loads with which the difference shrinks", float(order), 1.0, 0.05, "",
        "theory: the first term left out is quadratic", "higher terms are small by then",
    )  # fmt: skip
    return (
        Text(
            "Under small loads the nonlinear analysis must be the linear one: stiffness, mass, "
            "damping, constraints, stress recovery and time integration alike. Pins and air push "
            "the coarse airframe from its steady shape through 40 ms, and every element's stress "
            "is compared at every sample with full-order extended inertia relief."
        ),
        Table(
            "Largest difference of any element's stress",
            ("share of the loads", "difference / largest stress"),
            tuple((f"{factor:g}", f"{difference:.2e}") for factor, difference, _ in rows),
            note=f"Largest stress at full loads: {smallest[2] / 1e6:.0f} MPa.",
        ),
        Comparisons("Linear limit", (compared, proportion)),
    )


def step_costs(run: Run) -> tuple[Item, ...]:
    """Measure the parts of a step on the full airframe."""
    run.progress("cost of a step", 0.0)
    airframe = run.airframe
    repeats = 2 if run.quick else 5
    cost = step_cost(airframe, np.full(len(airframe.groups), FILL), repeats=repeats)
    run.progress("cost of a step", 1.0)
    return (
        Table(
            f"Processor time of a nonlinear step, {cost.freedoms} freedoms",
            ("part", "time [ms]"),
            (
                (
                    "one evaluation of forces, inertia, constraints and damping",
                    _ms(cost.evaluation),
                ),
                ("one correction with the factorised matrix", _ms(cost.correction)),
                ("tangent and factorisation, once for some tens of steps", _ms(cost.factorisation)),
            ),
            note="In a landing with steps of 0.5 ms a step takes about three evaluations and "
            "corrections.",
        ),
    )


def _ms(seconds: float) -> str:
    return f"{1e3 * seconds:.1f}"
