"""With all of the truth nothing is left to err; with a part of it, that part alone is changed."""

import pytest

from solver.assess import AssessmentModel
from verification.judging.flight import FlownLanding, fly
from verification.judging.methods import believed_installation
from verification.judging.population import draw_landing
from verification.judging.true_parts import Belief, Part, with_truth
from verification.judging.use_of_limits import UseOfLimits


@pytest.fixture(scope="module")
def use(example_jet: AssessmentModel) -> UseOfLimits:
    return UseOfLimits(example_jet)


@pytest.fixture(scope="module")
def flown(use: UseOfLimits) -> FlownLanding:
    return fly(use, draw_landing(2, 7), (), believed_installation(use.model))


@pytest.fixture(scope="module")
def belief(use: UseOfLimits, flown: FlownLanding) -> Belief:
    """True state of the contact, on the aircraft as defined in its usual loading."""
    airframe = use.model.airframe
    fills = airframe.loading_for().factors
    return Belief(airframe.landing_aircraft(fills), fills, (flown.drawn.contact,))


def test_the_true_state_of_the_true_aircraft_is_the_truth(
    use: UseOfLimits, flown: FlownLanding, belief: Belief
) -> None:
    """No error is left, to rounding: the same simulation of the same landing."""
    true = with_truth(belief, flown, tuple(Part))
    assert use(true.aircraft, true.fills, true.contacts) == pytest.approx(flown.utilisation, 1e-9)
    believed = use(belief.aircraft, belief.fills, belief.contacts)
    assert abs(believed / flown.utilisation - 1.0) > 1e-3


def test_a_floor_does_not_change_what_lies_above_it(
    use: UseOfLimits, flown: FlownLanding, belief: Belief
) -> None:
    true = with_truth(belief, flown, tuple(Part))
    answer = use(true.aircraft, true.fills, true.contacts, 0.5 * flown.utilisation)
    assert answer == pytest.approx(flown.utilisation, 1e-6)
    least = 1.5 * flown.utilisation
    assert use(true.aircraft, true.fills, true.contacts, least) == least


@pytest.mark.parametrize("part", [*Part])
def test_a_part_changes_itself_alone(part: Part, flown: FlownLanding, belief: Belief) -> None:
    """Parts in turn give the whole, in any order; none is what it was before."""
    only = with_truth(belief, flown, (part,))
    assert (only.aircraft, only.contacts) != (belief.aircraft, belief.contacts)
    others = with_truth(only, flown, [each for each in Part if each is not part])
    whole = with_truth(belief, flown, tuple(Part))
    assert others.aircraft.gears == whole.aircraft.gears
    assert others.aircraft.total_mass == whole.aircraft.total_mass
    assert others.contacts == whole.contacts


def test_a_later_contact_is_told_what_was_left_of_the_lift(
    flown: FlownLanding, belief: Belief
) -> None:
    """The spoilers came out once, so many seconds after the first contact."""
    start = flown.contact.lift.decay_start
    (first,) = belief.contacts
    for time, left in ((0.0, start), (0.25 * start, 0.75 * start), (2.0 * start, 0.0)):
        later = Belief(
            belief.aircraft, belief.fills, (type(first)(1.0, 60.0, lift=first.lift, time=time),)
        )
        (contact,) = with_truth(later, flown, (Part.LIFT,)).contacts
        assert contact.lift.decay_start == pytest.approx(left)
        assert contact.lift.fraction == first.lift.fraction
