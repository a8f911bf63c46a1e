"""The nonlinear analysis by itself: known solutions and laws of conservation."""

from verification.chapter import Chapter, Text
from verification.nonlinear.conservation import (
    airframe_flight,
    linear_limit,
    step_costs,
)
from verification.nonlinear.flights import plane_flight_items, space_flight_items, spin_up_items
from verification.nonlinear.statics import buckling_items, static_items
from verification.run import Run


def chapter(run: Run) -> Chapter:
    """Compute and describe."""
    return Chapter(
        "nonlinear_benchmarks",
        "The nonlinear analysis by itself",
        (
            Text(
                "The reference for extended inertia relief is a geometrically nonlinear analysis "
                "of the whole free airframe. It uses the very elements of the linear model, each "
                "in a frame that turns with it, rigid and averaging connections at finite "
                "rotation, and a midpoint rule that keeps momentum. Before it judges anything "
                "else, it is judged here."
            ),
            *static_items(run),
            *buckling_items(run),
            *plane_flight_items(run),
            *space_flight_items(run),
            *spin_up_items(run),
            *airframe_flight(run),
            *linear_limit(run),
            *step_costs(run),
        ),
    )
