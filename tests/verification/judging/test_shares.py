"""Shares, curves and calibration against closed forms."""

import numpy as np
import pytest
from scipy.stats import norm

from verification.judging.shares import (
    area_interval,
    calibration,
    calibration_error,
    operating_curve,
    weighted_share,
)


class TestShare:
    def test_equal_weights_give_jeffreys_interval(self) -> None:
        """Brown, Cai and DasGupta (2001): 1 of 10, quantiles of a beta distribution (1.5, 9.5)."""
        happened = np.array([True] + 9 * [False])
        share = weighted_share(happened, np.full(10, 0.3))
        assert share.value == pytest.approx(0.1)
        assert (share.lower, share.upper) == pytest.approx((0.011011, 0.381315), abs=1e-5)

    def test_nothing_seen_still_has_an_upper_end(self) -> None:
        share = weighted_share(np.zeros(100, dtype=bool), np.ones(100))
        assert share.value == share.lower == 0.0
        assert 0.01 < share.upper < 0.04

    def test_one_heavy_landing_widens_the_interval(self) -> None:
        happened = np.array([True, False, False, False])
        even = weighted_share(happened, np.ones(4))
        uneven = weighted_share(happened, np.array([3.0, 3.0, 3.0, 0.001]))
        assert uneven.upper - uneven.lower > even.upper - even.lower

    def test_a_share_of_nothing_is_not_a_number(self) -> None:
        share = weighted_share(np.zeros(0, dtype=bool), np.zeros(0))
        assert np.isnan(share.value)
        assert (share.lower, share.upper, share.count) == (0.0, 1.0, 0)

    def test_importance_weights_give_back_the_share_of_the_target(self) -> None:
        """Half of the draws above the 99.9 % quantile of a normal, weighted back to 0.1 %."""
        rng = np.random.default_rng(3)
        shifted = rng.normal(3.0, 1.0, 4000)
        weights = norm.pdf(shifted) / norm.pdf(shifted, 3.0)
        threshold = norm.ppf(0.999)
        value = float(weights[shifted > threshold].sum()) / 4000
        assert value == pytest.approx(0.001, rel=0.1)


class TestCurve:
    def test_area_is_the_probability_to_score_higher(self) -> None:
        """Two normals one deviation apart: Phi(1 / sqrt 2) (Green and Swets, 1966)."""
        rng = np.random.default_rng(5)
        hard = np.arange(4000) % 2 == 0
        scores = rng.standard_normal(4000) + hard
        area = operating_curve(scores, hard, np.ones(4000)).area
        assert area == pytest.approx(norm.cdf(np.sqrt(0.5)), abs=0.02)

    def test_ties_count_half(self) -> None:
        hard = np.array([True, True, False, False])
        assert operating_curve(np.ones(4), hard, np.ones(4)).area == pytest.approx(0.5)

    def test_weights_count_as_copies(self) -> None:
        hard = np.array([True, False, True, False])
        scores = np.array([3.0, 2.0, 1.0, 0.0])
        heavy = operating_curve(scores, hard, np.array([1.0, 2.0, 1.0, 1.0]))
        copied = operating_curve(np.append(scores, 2.0), np.append(hard, False), np.ones(5))
        assert heavy.area == pytest.approx(copied.area)
        assert heavy.wrong_calls == pytest.approx(copied.wrong_calls)

    def test_one_kind_of_landing_alone_has_no_curve(self) -> None:
        with pytest.raises(ValueError, match="hard landings and sound ones"):
            operating_curve(np.ones(2), np.array([True, True]), np.ones(2))

    def test_the_interval_of_a_perfect_score_is_a_point(self) -> None:
        hard = np.array([True] * 5 + [False] * 5)
        interval = area_interval(hard.astype(float), hard, np.ones(10), seed=1, repetitions=20)
        assert interval == (1.0, 1.0)


class TestCalibration:
    def test_honest_probabilities_lie_on_the_diagonal(self) -> None:
        rng = np.random.default_rng(7)
        stated = rng.uniform(size=20_000)
        hard = rng.uniform(size=20_000) < stated
        bins = calibration(stated, hard, np.ones(20_000), np.linspace(0.0, 1.0, 6))
        assert sum(each.share for each in bins) == pytest.approx(1.0)
        assert calibration_error(bins) < 0.02

    def test_boasting_is_seen(self) -> None:
        """Stated 0.9, true in half of the cases: 40 points off."""
        hard = np.array([True, False] * 10)
        bins = calibration(np.full(20, 0.9), hard, np.ones(20), np.array([0.0, 0.5, 1.0]))
        assert len(bins) == 1
        assert calibration_error(bins) == pytest.approx(0.4)

    def test_certainty_belongs_to_the_last_bin(self) -> None:
        (only,) = calibration(
            np.ones(3), np.ones(3, dtype=bool), np.ones(3), np.array([0.0, 0.5, 1.0])
        )
        assert only.observed.value == 1.0
