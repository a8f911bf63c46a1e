"""Landings whose verdict is known beforehand, on the example aircraft at full size.

The steps and their expected verdicts come from certification (14 CFR 25.473, 25.723), the makers'
published practice (crews report from about 4 ft/s, a hard landing rarely exceeds 6 ft/s; a nose
gear that touches first and 6 degrees of roll are inspected whatever the load factor), fleet data
(the mean of 1,218 landings of a large airliner is 126 ft/min) and the landing that the extended
inertia relief paper shows (0.5 m/s, 3 degrees of pitch and roll).
"""

import math
from dataclasses import dataclass
from itertools import pairwise

import pytest

from solver.assess import AssessmentModel, assess_landing
from solver.assessment import Assessment, TouchdownRecord, Verdict
from solver.landing.contact import Contact, Lift, LiftModel
from solver.verdict.judge import SEVERITY

FOOT = 0.3048
SPEED = 55.0
NORMAL, FIRM, INSPECT, HARD = Verdict.NORMAL, Verdict.FIRM, Verdict.INSPECT, Verdict.HARD


@dataclass(frozen=True)
class Step:
    name: str
    sink_ft_s: float
    expected: tuple[Verdict, ...]
    pitch: float = 3.0
    roll: float = 0.0
    mass: str = "landing"


SYMMETRICAL = (
    Step("greaser", 0.5, (NORMAL,)),
    Step("fleet mean", 2.1, (NORMAL,)),
    Step("upper end of typical", 3.0, (NORMAL,)),
    Step("crews start reporting", 4.0, (FIRM,)),
    Step("typical hard landing", 6.0, (FIRM,)),
    Step("limit sink rate", 10.0, (INSPECT,)),
    Step("reserve energy", 12.0, (HARD,)),
    Step("beyond certification", 13.0, (HARD,)),
)
OTHERS = (
    Step("paper's landing", 0.5 / FOOT, (NORMAL,), roll=3.0),
    Step("paper's landing at take-off mass", 0.5 / FOOT, (NORMAL,), roll=3.0, mass="take-off"),
    Step("limit sink rate at take-off mass", 6.0, (FIRM, INSPECT), mass="take-off"),
    Step("one gear at the limit sink rate", 10.0, (INSPECT, HARD), roll=2.0),
    Step("roll of 6 degrees", 5.0, (INSPECT,), roll=6.0),
    Step("nose first", 4.0, (INSPECT,), pitch=-1.0),
    Step("overweight", 4.0, (FIRM,), mass="overweight"),
    Step("overweight, limit sink rate", 10.0, (INSPECT, HARD), mass="overweight"),
)


def land(model: AssessmentModel, step: Step, lift: Lift | None = None) -> Assessment:
    masses = model.airframe.definition.masses
    mass = {
        "landing": masses.maximum_landing,
        "take-off": masses.maximum_takeoff,
        "overweight": 1.05 * masses.maximum_landing,
    }[step.mass]
    contact = Contact(
        sink_rate=step.sink_ft_s * FOOT,
        ground_speed=SPEED,
        pitch=math.radians(step.pitch),
        roll=math.radians(step.roll),
        lift=lift or Lift(),
    )
    return assess_landing(model, TouchdownRecord(model.name, (contact,), mass=mass))


@pytest.fixture(scope="module")
def ladder(example_jet: AssessmentModel) -> dict[str, Assessment]:
    return {step.name: land(example_jet, step) for step in SYMMETRICAL + OTHERS}


@pytest.mark.parametrize("step", SYMMETRICAL + OTHERS, ids=lambda step: step.name)
def test_every_step_has_its_verdict(ladder: dict[str, Assessment], step: Step) -> None:
    assessment = ladder[step.name]
    assert assessment.verdict in step.expected, assessment.reasons


def test_verdict_and_utilisation_rise_with_sink_rate(ladder: dict[str, Assessment]) -> None:
    steps = [ladder[step.name] for step in SYMMETRICAL]
    for softer, harder in pairwise(steps):
        assert SEVERITY[softer.verdict] <= SEVERITY[harder.verdict]
        assert softer.worst_utilisation < harder.worst_utilisation
        assert softer.peak_normal_load_factor < harder.peak_normal_load_factor


@pytest.mark.parametrize("name", ["limit sink rate", "limit sink rate at take-off mass"])
def test_design_landings_stay_within_the_limit_allowables(
    ladder: dict[str, Assessment], name: str
) -> None:
    """14 CFR 25.305(a): limit load without detrimental permanent deformation."""
    assessment = ladder[name]
    assert assessment.worst_margin >= 0.0
    assert all(load.utilisation <= 1.0 for load in assessment.gear_loads)


def test_the_margin_at_the_limit_sink_rate_is_small(ladder: dict[str, Assessment]) -> None:
    """The structure is sized for this landing: a large margin would blunt every verdict."""
    assert ladder["limit sink rate"].worst_margin < 0.12


def test_design_landing_with_lift_held_stays_within_the_limit_allowables(
    example_jet: AssessmentModel,
) -> None:
    step = Step("limit sink rate, lift held", 10.0, (INSPECT,), pitch=1.0)
    assessment = land(example_jet, step, Lift(LiftModel.HELD))
    assert assessment.worst_margin >= 0.0


def test_one_gear_landing_is_worst_on_its_own_side(ladder: dict[str, Assessment]) -> None:
    """Starboard wing low: the starboard gear takes the first and the larger load."""
    loads = {load.gear: load for load in ladder["one gear at the limit sink rate"].gear_loads}
    assert loads["main_right"].drag_force > loads["main_left"].drag_force


def test_nose_first_names_the_nose_gear(ladder: dict[str, Assessment]) -> None:
    reasons = {reason.code: reason for reason in ladder["nose first"].reasons}
    assert "nose gear" in reasons["nose_first"].text


def test_every_landing_balances(ladder: dict[str, Assessment]) -> None:
    for assessment in ladder.values():
        assert assessment.energy_error < 1e-3
        assert assessment.equilibrium_residual < 1e-8
