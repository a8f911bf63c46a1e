import numpy as np
import pytest

from solver.inertia_relief.damping import RayleighDamping


def test_the_stated_ratio_holds_at_both_frequencies_and_is_lower_between_them():
    damping = RayleighDamping(0.02, 3.0, 40.0)
    ends = damping.modal_ratio(2 * np.pi * np.array([3.0, 40.0]))
    np.testing.assert_allclose(ends, 0.02, rtol=1e-14)
    between = damping.modal_ratio(2 * np.pi * np.linspace(3.1, 39.0, 50))
    assert np.all(between < 0.02)
    # the smallest ratio, at the geometric mean: 2 sqrt(r) / (1 + r) of the stated one, r = f2 / f1
    ratio = 40.0 / 3.0
    lowest = damping.modal_ratio(2 * np.pi * np.sqrt(np.array([3.0 * 40.0])))[0]
    assert lowest == pytest.approx(0.02 * 2 * np.sqrt(ratio) / (1 + ratio), rel=1e-12)
