"""A probability and the error of its own sampling."""

import numpy as np
import pytest
from scipy.special import ndtr
from scipy.stats import beta, chi2

from solver.probability.estimate import estimate
from solver.probability.normals import sobol_normals

REPLICATES, SIZE = 8, 32
TOTAL = REPLICATES * SIZE


def happened(count: int) -> np.ndarray:
    flat = np.arange(TOTAL) < count
    return flat.reshape(SIZE, REPLICATES).T  # spread over the replicates


def test_interval_is_jeffreys() -> None:
    """Beta quantiles by another code; Brown, Cai and DasGupta (2001), section 3.1.1."""
    found = estimate(happened(12))
    assert found.probability == 12 / TOTAL
    assert found.lower == pytest.approx(beta.ppf(0.025, 12.5, TOTAL - 11.5))
    assert found.upper == pytest.approx(beta.ppf(0.975, 12.5, TOTAL - 11.5))


@pytest.mark.parametrize(("count", "end"), [(0, "lower"), (TOTAL, "upper")])
def test_honest_at_zero_and_one(count: int, end: str) -> None:
    """No spread is seen there; for small shares the beta quantile is chi-squared's over 2 n."""
    found = estimate(happened(count))
    assert getattr(found, end) == count / TOTAL
    assert found.standard_error == 1 / TOTAL
    far = found.upper if count == 0 else 1.0 - found.lower
    assert far == pytest.approx(chi2.ppf(0.975, 1) / (2 * TOTAL), rel=0.02)


def test_replicates_that_disagree_show_it() -> None:
    apart = np.zeros((REPLICATES, SIZE), dtype=bool)
    apart[: REPLICATES // 2] = True
    # Standard deviation of four zeros and four ones, over the root of eight.
    assert estimate(apart).standard_error == pytest.approx(np.sqrt(8 / 28) / np.sqrt(8))
    assert estimate(apart.T.reshape(REPLICATES, SIZE)).standard_error < 0.2


@pytest.mark.parametrize("shape", [(1, 32), (8, 0)])
def test_error_needs_replicates(shape: tuple[int, int]) -> None:
    with pytest.raises(ValueError, match="replicates"):
        estimate(np.zeros(shape, dtype=bool))


@pytest.mark.parametrize("limit", [0.3, 1.2, 2.0])
def test_the_interval_holds_the_truth_as_often_as_it_says(limit: float) -> None:
    """A linear limit has the closed form Phi(-beta); 200 seeds, 95 % asked."""
    slopes = np.array([1.0, 0.8, -0.6, 0.4, 0.3, -0.2])
    truth = float(ndtr(-limit / np.linalg.norm(slopes)))
    held = 0
    for seed in range(200):
        normals = sobol_normals(len(slopes), REPLICATES, SIZE, seed)
        found = estimate(normals @ slopes > limit)
        held += found.lower <= truth <= found.upper
    assert held >= 186  # fewer than one in a thousand binomial draws of 200 at 95 %


def test_standard_error_is_the_spread_of_estimates() -> None:
    """Root mean square of the stated errors against the scatter of 200 estimates."""
    slopes = np.array([1.0, 0.8, -0.6, 0.4, 0.3, -0.2])
    found = [
        estimate(sobol_normals(len(slopes), REPLICATES, SIZE, seed) @ slopes > 0.8)
        for seed in range(200)
    ]
    scatter = np.std([one.probability for one in found])
    stated = np.sqrt(np.mean([one.standard_error**2 for one in found]))
    assert 0.8 < stated / scatter < 1.3
