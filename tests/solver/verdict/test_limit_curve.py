"""Straight lines between points, steps, and where the points end."""

import pytest

from solver.verdict.limit_curve import LimitCurve

CURVE = LimitCurve((0.0, 2.0, 6.0, 6.0), (2.2, 2.2, 1.6, 1.0))


@pytest.mark.parametrize(
    ("argument", "value"),
    [(0.0, 2.2), (1.0, 2.2), (2.0, 2.2), (3.0, 2.05), (5.0, 1.75), (6.0, 1.6), (6.1, 1.0)],
)
def test_values(argument: float, value: float) -> None:
    assert CURVE.value(argument) == pytest.approx(value)


def test_before_a_step_its_first_value_holds_whatever_the_rounding() -> None:
    assert CURVE.value(6.0 * (1 + 1e-12)) == pytest.approx(1.6)


def test_the_nearest_point_holds_outside() -> None:
    rising = LimitCurve((1.0, 2.0), (10.0, 20.0))
    assert (rising.value(0.5), rising.value(3.0)) == (10.0, 20.0)
    assert [rising.covers(x) for x in (0.9, 1.0, 2.0, 2.1)] == [False, True, True, False]


def test_a_constant_is_a_curve_of_one_point() -> None:
    constant = LimitCurve((0.0,), (2.6,))
    assert constant.value(0.0) == constant.value(1e6) == 2.6
