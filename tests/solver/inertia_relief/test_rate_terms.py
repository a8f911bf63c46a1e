import numpy as np
import pytest

from solver.fe.inertia import RATE_PRODUCTS
from solver.inertia_relief.rate_terms import RateTerms
from verification.inertia_relief.free_beam import beam_structure
from verification.inertia_relief.winged_body import (
    winged_body,
)


@pytest.mark.parametrize("kind", ["beam", "winged body"])
def test_force_at_the_mass_points_equals_the_assembled_operators(kind):
    if kind == "beam":
        inertia = beam_structure(count=10).inertia
    else:
        inertia = winged_body(6, 8).inertia(np.array([0.4, 0.9]))
    rng = np.random.default_rng(2)
    rate, derivative = rng.standard_normal(3), rng.standard_normal(3)
    u, v = rng.standard_normal((2, inertia.n_free))
    expected = sum(rate[k] * (inertia.gyroscopic(k) @ v) for k in range(3))
    expected = expected + sum(derivative[k] * (inertia.euler(k) @ u) for k in range(3))
    for i, j in RATE_PRODUCTS:
        expected = expected + rate[i] * rate[j] * (inertia.centrifugal(i, j) @ u)
    found = RateTerms(inertia).force(rate, derivative, u, v)
    np.testing.assert_allclose(found, expected, atol=1e-12 * np.abs(expected).max())


def test_several_motions_at_once_are_each_by_itself():
    inertia = winged_body(6, 8).inertia(np.array([0.4, 0.9]))
    rng = np.random.default_rng(3)
    rate, derivative = rng.standard_normal((2, 3, 3))
    u, v = rng.standard_normal((2, inertia.n_free, 3))
    terms = RateTerms(inertia)
    together = terms.force(rate, derivative, u, v)
    for k in range(3):
        alone = terms.force(rate[k], derivative[k], u[:, k], v[:, k])
        np.testing.assert_allclose(together[:, k], alone, atol=1e-13 * np.abs(alone).max())
