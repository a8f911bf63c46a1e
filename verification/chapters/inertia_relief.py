"""Extended inertia relief by itself: closed forms, Kane's problem, balance, worth of each term."""

from verification.chapter import Chapter, Item, Text
from verification.inertia_relief.airframe_sections import (
    balance_section,
    example,
    omission_section,
    time_step_section,
)
from verification.inertia_relief.beam_sections import dynamic_section, static_section
from verification.inertia_relief.spin_up_section import spin_up_section
from verification.run import Run


def chapter(run: Run) -> Chapter:
    """Compute and describe."""
    run.progress("free bodies", 0.0)
    items: list[Item] = [
        Text(
            "Extended inertia relief lets a free structure vibrate in axes that turn with it. This"
            " chapter takes the method by itself, before any comparison with nonlinear dynamics:"
            " beams, bars and plates whose answers are known in closed form or by other means, then"
            " the balance of whole landings, and last what each term of the turning frame is worth."
        ),
        *static_section(),
        *dynamic_section(run.quick),
    ]
    run.progress("free bodies", 1.0)
    given = example(run)
    run.progress("spin-up", 0.0)
    items += spin_up_section(run, given.landing_rate())
    run.progress("time steps", 0.0)
    items += time_step_section(run.quick)
    run.progress("time steps", 1.0)
    run.progress("random landings", 0.0)
    items += balance_section(given, run)
    run.progress("terms left out", 0.0)
    items += omission_section(given, run)
    return Chapter("inertia_relief", "Extended inertia relief by itself", tuple(items))
