"""Probability that a limit was exceeded against the sink rate, for two recorders."""

import math
from pathlib import Path

import matplotlib.pyplot as plt

from solver.assess import AssessmentModel, assess_landing
from solver.assessment import LimitProbability, TouchdownRecord
from solver.landing.contact import Contact
from solver.landing.contact_uncertainty import ContactUncertainty
from solver.progress import Progress, silent

#: Of the figure [m/s].
SINK_RATES = (0.6, 1.2, 1.8, 2.4, 2.8, 3.2, 3.6)

DEGREE = math.pi / 180.0

#: Deviations where a record says nothing, and those of a smoothed window.
RECORDERS = {
    "sink rate within 0.30 m/s": {
        "sink_rate": 0.30,
        "pitch": 0.5 * DEGREE,
        "roll": 0.5 * DEGREE,
        "drift": 1.0 * DEGREE,
        "yaw_rate": 0.8 * DEGREE,
        "lift_fraction": 0.1,
    },
    "sink rate within 0.08 m/s": {
        "sink_rate": 0.08,
        "pitch": 0.2 * DEGREE,
        "roll": 0.2 * DEGREE,
        "drift": 0.3 * DEGREE,
        "yaw_rate": 0.2 * DEGREE,
        "lift_fraction": 0.03,
    },
}


def probability(
    model: AssessmentModel, sink_rate: float, deviations: dict[str, float]
) -> LimitProbability:
    """Of a landing with 1 degree of roll at the maximum landing mass."""
    contact = Contact(sink_rate=sink_rate, ground_speed=55.0, pitch=3.0 * DEGREE, roll=1.0 * DEGREE)
    record = TouchdownRecord(
        model.name,
        (contact,),
        mass=model.airframe.definition.masses.maximum_landing,
        uncertainties=(ContactUncertainty.independent(**deviations),),
    )
    found = assess_landing(model, record).limit_probability
    assert found is not None
    return found


def draw_probability(model: AssessmentModel, path: Path, progress: Progress = silent) -> None:
    """Write the figure: probabilities with their sampling intervals, and the thresholds."""
    figure, axes = plt.subplots(figsize=(8, 4.5), layout="constrained")
    for place, (name, deviations) in enumerate(RECORDERS.items()):
        found = []
        for number, sink_rate in enumerate(SINK_RATES):
            done = (place + number / len(SINK_RATES)) / len(RECORDERS)
            progress("probability against sink rate", done)
            found.append(probability(model, sink_rate, deviations))
        values = [100 * one.probability for one in found]
        below = [100 * (one.probability - one.lower) for one in found]
        above = [100 * (one.upper - one.probability) for one in found]
        axes.errorbar(SINK_RATES, values, yerr=(below, above), marker="o", capsize=3, label=name)
    thresholds = model.airframe.definition.verdict
    for threshold, name in (
        (thresholds.inspect_probability, "INSPECT"),
        (thresholds.hard_probability, "HARD"),
    ):
        axes.axhline(100 * threshold, lw=0.8, ls="--", color="grey")
        axes.annotate(name, (SINK_RATES[0], 100 * threshold), va="bottom", fontsize="small")
    axes.set_xlabel("recorded sink rate [m/s]")
    axes.set_ylabel("probability of a limit exceeded [%]")
    axes.legend(fontsize="small")
    axes.grid(alpha=0.3)
    figure.savefig(path, dpi=120)
    plt.close(figure)
    progress("probability against sink rate", 1.0)
