"""Rows in sixteen bits are what they were to half a step of each row."""

import numpy as np
import pytest

from solver.inertia_relief.rounded_rows import STEPS, rounded


@pytest.fixture
def rows() -> np.ndarray:
    """Rows of very unlike sizes, one of them empty."""
    rng = np.random.default_rng(3)
    rows = rng.standard_normal((20, 6, 50)) * 10.0 ** rng.uniform(-3, 9, (20, 6, 1))
    rows[4, 2] = 0.0
    return rows.astype(np.float32)


def test_every_entry_is_off_by_half_a_step_at_most(rows):
    stored = rounded(rows)
    largest = np.abs(rows).max(axis=2)
    assert np.all(np.abs(stored.numbers.astype(int)).max(axis=2) == STEPS * (largest > 0.0))
    off = np.abs(stored.exact() - rows.astype(float))
    # single precision adds its own rounding, far below a step
    assert np.all(off <= (0.5 + 1e-2) * largest[..., None] / STEPS)
    assert not stored.exact()[4, 2].any()


def test_stress_is_off_by_half_a_step_for_each_coordinate_at_most(rows):
    stored = rounded(rows)
    coordinates = np.random.default_rng(1).standard_normal(50)
    off = np.abs(stored.exact() @ coordinates - rows.astype(float) @ coordinates)
    bound = stored.step / 2 * np.abs(coordinates).sum()
    assert np.all(off <= 1.01 * bound)
    # errors are of either sign, and cancel for the most part
    assert np.median(off[bound > 0] / bound[bound > 0]) < 0.25


def test_a_part_is_the_rows_of_some_elements(rows):
    stored = rounded(rows)
    assert len(stored) == 20
    assert np.array_equal(stored[3:9].exact(), stored.exact()[3:9])
    some = np.array([7, 2])
    assert np.array_equal(stored[some].exact(), stored.exact()[some])
