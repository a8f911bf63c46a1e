"""Standard normal samples."""

import numpy as np
import pytest
from scipy.special import ndtr

from solver.probability.normals import seed_of, sobol_normals


def test_the_same_seed_gives_the_same_samples_and_another_one_others() -> None:
    first, again = (sobol_normals(5, 2, 32, seed_of("record")) for _ in range(2))
    np.testing.assert_array_equal(first, again)
    assert np.any(first != sobol_normals(5, 2, 32, seed_of("another record")))
    assert np.any(first[0] != first[1])


def test_moments_are_those_of_standard_normals() -> None:
    normals = sobol_normals(12, 8, 32, 1).reshape(-1, 12)
    assert np.abs(normals.mean(axis=0)).max() < 0.02
    assert np.abs(np.cov(normals.T) - np.eye(12)).max() < 0.2  # 1 / sqrt(256) is 0.06
    assert np.all(np.isfinite(normals))


@pytest.mark.parametrize("variables", [1, 20])
def test_a_linear_limit_is_met_and_better_with_more_samples(variables: int) -> None:
    """P(a.z > b) = Phi(-b / |a|): the error of 512 samples is below that of 32, by far."""
    slopes = 0.7 ** np.arange(variables)
    truth = float(ndtr(-1.0))
    errors = []
    for size in (4, 64):
        estimates = [
            np.mean(sobol_normals(variables, 8, size, seed) @ slopes > np.linalg.norm(slopes))
            for seed in range(40)
        ]
        errors.append(float(np.sqrt(np.mean((np.array(estimates) - truth) ** 2))))
    # Independent samples: a quarter.  Sobol points are at least as good.
    assert errors[1] < 0.25 * errors[0] * 1.3
    assert errors[1] < np.sqrt(truth * (1.0 - truth) / 512)
