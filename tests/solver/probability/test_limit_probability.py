"""The probability of a landing, from corners, from few samples and from all."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import ndtr

from solver.assess import AssessmentModel, assess_landing
from solver.assessment import ProbabilityBasis, Verdict
from solver.probability.limit_probability import (
    FIRST,
    REPLICATES,
    chosen_elements,
    limit_probability,
    unimodal_bound,
)
from tests.solver.probability.conftest import assessed, landing
from tests.solver.probability.test_exceedance import exact

ONLY_SINK = {"sink_rate": 0.15}


def utilisation(model: AssessmentModel, sink_rate: float) -> float:
    """The largest of airframe and gears, by the full assessment."""
    found = assess_landing(model, replace(landing(model, sink_rate), uncertainties=()))
    return max(found.worst_utilisation, *(load.utilisation for load in found.gear_loads))


def test_one_uncertain_sink_rate_gives_a_gaussian_tail(
    mini: AssessmentModel, monkeypatch: pytest.MonkeyPatch
) -> None:
    """P = Phi((s - limit) / deviation), the limit sink rate found by bisection of the full path."""
    monkeypatch.setattr("solver.probability.limit_probability.REPLICATES", 4)
    model = exact(mini)
    low, high = 2.0, 4.5
    for _ in range(7):
        middle = (low + high) / 2
        low, high = (middle, high) if utilisation(model, middle) < 1.0 else (low, middle)
    limit = (low + high) / 2
    record = replace(
        landing(model, limit - 0.1, deviations=ONLY_SINK),
        mass_deviation=0.0,
        centre_of_gravity_deviation=0.0,
    )
    found = limit_probability(model.airframe, model.reduced, assessed(model, record)).landing
    truth = float(ndtr(-0.1 / ONLY_SINK["sink_rate"]))
    # The bisection ends within 0.01 m/s, 0.07 deviations.
    assert found.probability == pytest.approx(truth, abs=0.03 + 2 * found.standard_error)
    assert found.lower - 0.03 < truth < found.upper + 0.03
    assert found.basis is ProbabilityBasis.SAMPLES
    assert found.failed == 0


def test_soft_landings_are_settled_by_their_corners(mini: AssessmentModel) -> None:
    assessment = assess_landing(mini, landing(mini, 0.6))
    found = assessment.limit_probability
    assert found is not None
    assert found.basis is ProbabilityBasis.CORNERS
    assert (found.probability, found.lower, found.samples) == (0.0, 0.0, 2)
    assert 0.0 < found.upper < mini.airframe.definition.verdict.inspect_probability
    assert assessment.verdict is Verdict.NORMAL
    assert all(spot.probability_limit_exceeded == 0.0 for spot in assessment.hot_spots)
    (reason,) = (each for each in assessment.reasons if each.code == "limit_probability")
    assert "probability that a limit was exceeded" in reason.text


def test_a_record_without_uncertainty_has_no_probability(mini: AssessmentModel) -> None:
    assessment = assess_landing(mini, replace(landing(mini, 0.6), uncertainties=()))
    assert assessment.limit_probability is None
    assert assessment.probability_limit_exceeded is None
    assert all(spot.probability_limit_exceeded is None for spot in assessment.hot_spots)


def test_a_landing_near_its_limit_is_sampled_and_the_same_record_alike(
    mini: AssessmentModel, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("solver.probability.limit_probability.REPLICATES", 2)
    record = landing(mini, 3.0)
    first, again = (assess_landing(mini, record) for _ in range(2))
    found = first.limit_probability
    assert found is not None
    assert found == again.limit_probability
    assert found.samples == 2 * FIRST
    assert 0.02 < found.probability < 0.98
    assert found.lower < found.probability < found.upper
    assert first.verdict in (Verdict.INSPECT, Verdict.HARD)
    for spot in first.hot_spots:
        assert spot.probability_limit_exceeded is not None
        assert spot.probability_limit_exceeded <= found.probability


def test_a_slow_machine_answers_with_fewer_samples(mini: AssessmentModel) -> None:
    nominal = assessed(mini, landing(mini, 3.2))
    answer = limit_probability(mini.airframe, mini.reduced, nominal, time_budget=0.0)
    found = answer.landing
    assert found.samples == 2 * FIRST
    assert found.upper - found.lower > 0.1


class TestUnimodalBound:
    @pytest.mark.parametrize("deviations", [3.0, 5.0])
    def test_of_no_unimodal_distribution_lies_more_beyond(self, deviations: float) -> None:
        """Exponential and normal distributions in closed form."""
        two = np.array([-0.1, 0.1]) / np.sqrt(2.0)  # deviation 0.1
        bound = unimodal_bound(1.0 - 0.1 * deviations + two)
        assert bound == pytest.approx(4.0 / (9.0 * (1.0 + deviations**2)))
        assert bound > np.exp(-1.0 - deviations)
        assert bound > ndtr(-deviations)

    def test_a_sample_at_the_limit_proves_nothing(self) -> None:
        assert unimodal_bound(np.array([0.1, 0.1, 1.0])) == 1.0
        assert unimodal_bound(np.array([0.1, np.inf])) == 1.0


class TestChosenElements:
    def test_those_near_the_most_used_one_in_any_design(self) -> None:
        first, second = np.array([0.5, 0.3, 0.4, 0.1]), np.array([0.1, 0.9, 0.1, 0.2])
        np.testing.assert_array_equal(chosen_elements([first, second]), [0, 1, 2])

    def test_all_that_exceed_in_a_hard_landing(self) -> None:
        np.testing.assert_array_equal(chosen_elements([np.array([3.0, 1.0, 0.8, 0.7])]), [0, 1, 2])

    def test_a_design_that_cannot_be_simulated_chooses_nothing(self) -> None:
        designs = [np.array([0.5, 0.1]), np.full(2, np.inf)]
        np.testing.assert_array_equal(chosen_elements(designs), [0])


def test_at_least_256_samples() -> None:
    assert FIRST * REPLICATES >= 256
