import math

import numpy as np
import pytest

from verification.comparison import Comparison


def comparison(found: float, target: float = 2.0, scale: float | None = None) -> Comparison:
    return Comparison("x", found, target, 0.1, "N", "arithmetic", "a tenth", scale)


def test_difference_is_relative_to_the_target_unless_a_scale_is_given() -> None:
    assert comparison(2.1).difference == pytest.approx(0.05)
    assert comparison(2.1, scale=1.0).difference == pytest.approx(0.1)
    assert comparison(2.1, scale=4.0).difference == pytest.approx(0.025)
    assert comparison(-1.9, -2.0).difference == pytest.approx(0.05)


def test_holds_up_to_its_tolerance() -> None:
    assert comparison(2.19).holds
    assert not comparison(2.21).holds
    assert comparison(2.1).used == pytest.approx(0.5)


@pytest.mark.parametrize("found", [math.nan, math.inf])
def test_what_is_no_number_does_not_hold(found: float) -> None:
    assert not comparison(found).holds
    assert comparison(found).used == math.inf


def test_target_of_zero_needs_a_scale() -> None:
    with pytest.raises(ValueError, match="scale"):
        comparison(0.1, target=0.0)
    assert comparison(0.05, target=0.0, scale=1.0).holds


def test_exact_equality_can_be_asked_for() -> None:
    exact = Comparison("n", 3, 3, 0.0, "", "count", "whole numbers", 1.0)
    assert exact.holds
    assert exact.used == 0.0
    assert not Comparison("n", 4, 3, 0.0, "", "count", "whole numbers", 1.0).holds


def test_scalars_of_arrays_become_plain_numbers() -> None:
    row = comparison(np.float64(2.1), np.float64(2.0), np.float64(4.0))
    assert type(row.found) is float
    assert row.holds is True
    assert type(row.used) is float
