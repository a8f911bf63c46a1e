"""The flying beams of Simo and Vu-Quoc and the spin-up beam, as the report shows them."""

import numpy as np

from solver.arrays import Array
from verification.chapter import Comparisons, Item, Text
from verification.comparison import Comparison
from verification.nonlinear.exudyn_beam import plane_flight
from verification.nonlinear.flying_beam import PLANE, SPACE, Flight, flying_beam
from verification.nonlinear.spin_up import EXTENSION, spin_up
from verification.peers.apart import apart
from verification.peers.exudyn_landing import is_installed
from verification.plots import Line, Panel, line_plot
from verification.run import Run

#: Times at which places are compared [s].
TIMES = (2.5, 5.0, 7.5, 10.0)
#: Longest way between two compared places, what differences are measured by [m].
WAY = 10.0


def plane_flight_items(run: Run) -> tuple[Item, ...]:
    """Compare the plane flight with exudyn and with the laws of conservation."""
    count, step = (20, 0.05) if run.quick else (40, 0.0125)
    run.progress("flying beam", 0.0)
    flight = flying_beam(count, step, TIMES[-1], PLANE)
    run.progress("flying beam", 0.6)
    rows = list(_conservation(flight, 2.51, 20.0))
    if is_installed():
        peer = apart(plane_flight, 2 * count, step / 2, TIMES[-1])
        reason = (
            "both converge with the second order of mesh and step; differences of their own "
            "halved steps and meshes are of this size"
        )
        for time in TIMES:
            own, other = _at(flight.time, flight.lower, time), _at(peer[:, 0], peer[:, 1:], time)
            rows += [
                Comparison(
                    f"lower end at {time:g} s, {axis}",
                    own[k],
                    other[k],
                    0.01 if run.quick else 0.002,
                    "m",
                    "exudyn, geometrically exact beam",
                    reason,
                    WAY,
                )
                for k, axis in enumerate("xy")
            ]
    run.progress("flying beam", 1.0)
    figure = line_plot(
        "nonlinear-flying-beam",
        "Simo and Vu-Quoc's flying beam in the plane: ends of the beam at every half second, and "
        "its energy after the loads are gone, relative to what it then is.",
        [
            Panel("x [m]", "y [m]", _shapes(flight), "flight", is_square=True),
            Panel("time [s]", "energy / energy at 10 s - 1 [-]", [_energy(flight, 2.51)], "energy"),
        ],
    )
    note = (
        "exudyn, an independent multibody code, flies the same beam with geometrically exact "
        "elements of half the length and half the step."
        if is_installed()
        else "exudyn, which flies the same beam, is not installed here."
    )
    return (
        Text(
            "Dynamics next: a free beam of 10 m is thrown by a force and a couple at one end, "
            "bends by metres and flies on. There is no closed form but for what is kept: "
            "momentum, angular momentum and energy once the loads are gone. " + note
        ),
        figure,
        Comparisons("Flying beam in the plane", tuple(rows)),
    )


def space_flight_items(run: Run) -> tuple[Item, ...]:
    """Compare the flight in space with itself on other meshes and steps."""
    count, step = (20, 0.05) if run.quick else (40, 0.0125)
    run.progress("beam in space", 0.0)
    flight = flying_beam(count, step, 7.0, SPACE)
    run.progress("beam in space", 0.5)
    coarse = flying_beam(count // 2, 2 * step, 7.0, SPACE)
    run.progress("beam in space", 1.0)
    end, other = flight.lower[-1], coarse.lower[-1]
    rows = [
        *_conservation(flight, 5.01, 50.0),
        *(
            Comparison(
                f"lower end at 7 s, {axis}, against half the elements and twice the step",
                other[k],
                end[k],
                0.03 if run.quick else 0.01,
                "m",
                "own finer solution",
                "shows that mesh and step are fine enough for the laws above to mean anything",
                WAY,
            )
            for k, axis in enumerate("xyz")
        ),
    ]
    return (
        Text(
            "The same beam in space, with couples about two axes: rotations without a common "
            "axis, where an integrator that adds rotation vectors would lose its way."
        ),
        Comparisons("Flying beam in space", tuple(rows)),
    )


def spin_up_items(run: Run) -> tuple[Item, ...]:
    """Compare the steady extension with its closed form."""
    run.progress("spin-up beam", 0.0)
    course = spin_up(step=0.02 if run.quick else 0.01)
    run.progress("spin-up beam", 1.0)
    row = Comparison(
        "steady extension of the spin-up beam",
        course.steady_extension(),
        EXTENSION,
        0.01 if run.quick else 0.002,
        "m",
        "m w^2 L^3 / (3 EA)",
        "stretching under the centrifugal load itself and the step are left",
    )
    figure = line_plot(
        "nonlinear-spin-up",
        "Beam spun up by a couple at its middle within 15 s: the tip lags behind and catches up; "
        "the centrifugal load leaves it longer.",
        [
            Panel("time [s]", "lag of the tip [m]", [Line(course.time, course.lag)]),
            Panel(
                "time [s]",
                "extension [mm]",
                [Line(course.time, 1e3 * course.extension)],
                levels=[(1e3 * EXTENSION, "closed form")],
                y_limits=(-1.0, 1.0),
            ),
        ],
    )
    return figure, Comparisons("Centrifugal stretching", (row,))


def _conservation(flight: Flight, coasting: float, impulse: float) -> tuple[Comparison, ...]:
    """Rows on momentum and energy from the time at which the loads are gone."""
    free = flight.time > coasting
    angular = flight.momenta[free, 3:]
    drift = np.linalg.norm(angular - angular[0], axis=1).max() / np.linalg.norm(angular[0])
    energy = flight.energy[free]
    spread = np.abs(energy / energy[-1] - 1).max()
    return (
        Comparison(
            "momentum after the loads",
            flight.momenta[-1, 0],
            impulse,
            1e-6,
            "N s",
            "impulse of the force, closed form",
            "kept to the tolerance of the iteration",
        ),
        Comparison(
            "largest change of angular momentum",
            drift,
            0.0,
            1e-6,
            "",
            "conservation",
            "kept to the tolerance of the iteration",
            1.0,
        ),
        Comparison(
            "largest change of energy",
            spread,
            0.0,
            1e-3,
            "",
            "conservation",
            "second order in the step, without a trend",
            1.0,
        ),
    )


def _at(times: Array, places: Array, time: float) -> Array:
    found: Array = places[np.abs(times - time).argmin()]
    return found


def _shapes(flight: Flight) -> list[Line]:
    lines = []
    for time in np.arange(0.0, TIMES[-1] + 0.1, 0.5):
        one, other = _at(flight.time, flight.lower, time), _at(flight.time, flight.upper, time)
        lines.append(Line(np.array([one[0], other[0]]), np.array([one[1], other[1]]), colour=0))
    return lines


def _energy(flight: Flight, coasting: float) -> Line:
    free = flight.time > coasting
    return Line(flight.time[free], flight.energy[free] / flight.energy[-1] - 1)
