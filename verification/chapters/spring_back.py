"""Spring-back: with and without it in a landing, and against closed forms."""

from verification.chapter import Chapter, Comparisons, Text
from verification.run import Run
from verification.spring_back.closed_forms import ramp_response, spin_up
from verification.spring_back.landing import (
    appendix_d,
    comparisons,
    forces_plot,
    landings,
    spin_up_plot,
    summary,
)


def chapter(run: Run) -> Chapter:
    """Compute and describe."""
    airframe = run.airframe
    run.progress("landings with and without spring-back", 0.0)
    both = landings(airframe)
    run.progress("spin-up", 0.4)
    spin_up_figure, spin_up_rows = spin_up()
    run.progress("spring-back after a ramp", 0.6)
    ramp_figure, ramp_rows = ramp_response()
    run.progress("spring-back after a ramp", 1.0)
    return Chapter(
        "spring_back",
        "Spin-up and spring-back",
        (
            Text(
                "A wheel that touches the runway is dragged to speed; the drag bends the leg aft, "
                "and when the tyre rolls the leg springs forward. The leg is a rigid link on a "
                "rotational spring. The landing below is that of the example aircraft at 10 ft/s "
                "and its maximum landing mass, once as it is and once with rigid legs."
            ),
            forces_plot(both),
            summary(both),
            Comparisons("Landing with spring-back and without", comparisons(both)),
            spin_up_plot(both),
            Text(
                "Spin-up has a closed form, that of 14 CFR 23 appendix D, for constant friction "
                "and a vertical force that grows in proportion to time. The simulation is set "
                "alike: a linear tyre under a mass that nothing stops."
            ),
            spin_up_figure,
            Comparisons("Spin-up against its closed form", spin_up_rows),
            appendix_d(both),
            Text(
                "Spring-back has one too, for an undamped leg after a linear ramp of drag that "
                "ends at once. The same simulation with an elastic leg gives it."
            ),
            ramp_figure,
            Comparisons("Spring-back against its closed form", ramp_rows),
        ),
    )
