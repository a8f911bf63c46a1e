"""The example aircraft's rule against its own simulated landings, as a recorder would show them."""

import math

import numpy as np
import pytest

from solver.assess import AssessmentModel, assess_landing
from solver.assessment import Assessment, RuleDifference, TouchdownRecord, Verdict
from solver.landing.contact import Contact
from solver.landing.simulate import simulate_landing
from solver.recorded import RecordedContact, RecordedPeak

FOOT = 0.3048
NORMAL, FIRM, INSPECT, HARD, _ = Verdict
AGREE, STRESS_STRICTER, RULE_STRICTER, *_ = RuleDifference


def landed(model: AssessmentModel, sink_ft_s: float, roll: float, rate: float) -> Assessment:
    """A landing at the maximum landing mass; the mean peak over the phases of the sampling."""
    mass = model.airframe.definition.masses.maximum_landing
    state = Contact(
        sink_rate=sink_ft_s * FOOT,
        ground_speed=55.0,
        pitch=math.radians(3.0),
        roll=math.radians(roll),
    )
    loading = model.airframe.loading_for(mass, None, {}, {})
    history = simulate_landing(model.airframe.landing_aircraft(loading.factors), state)
    peaks = [
        np.interp(
            np.arange(phase, history.time[-1], 1 / rate), history.time, history.normal_load_factor
        ).max()
        for phase in np.linspace(0.0, 1.0 / rate, 16, endpoint=False)
    ]
    recorded = RecordedContact(
        normal_load_factor=RecordedPeak(float(np.mean(peaks)), rate),
        lateral_load_factor=RecordedPeak(0.1, 4.0),
        sink_rate=state.sink_rate,
        roll=state.roll,
        roll_rate=0.0,
        simulated=0,
    )
    record = TouchdownRecord(model.name, (state,), mass=mass, recorded=(recorded,))
    return assess_landing(model, record)


@pytest.mark.parametrize(
    ("sink_ft_s", "roll", "rate", "action", "difference"),
    [
        (2.1, 0.0, 16.0, NORMAL, AGREE),
        (6.0, 0.0, 16.0, FIRM, AGREE),
        (8.0, 0.0, 16.0, FIRM, AGREE),
        (8.0, 0.0, 8.0, INSPECT, RULE_STRICTER),
        (10.0, 0.0, 16.0, INSPECT, AGREE),
        (8.0, 3.0, 16.0, HARD, STRESS_STRICTER),
        (12.0, 0.0, 16.0, HARD, AGREE),
    ],
)
def test_ladder(
    example_jet: AssessmentModel,
    sink_ft_s: float,
    roll: float,
    rate: float,
    action: Verdict,
    difference: RuleDifference,
) -> None:
    assessment = landed(example_jet, sink_ft_s, roll, rate)
    assert assessment.makers_rule is not None
    assert assessment.makers_rule.rule == "ebj-19"
    assert (assessment.action, assessment.rule_difference) == (action, difference)
