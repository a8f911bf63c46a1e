"""Compression of basis and stress rows: what it leaves out is bounded, what it keeps is exact."""

import numpy as np
import pytest

from solver.inertia_relief.basis import BasisSettings
from solver.inertia_relief.compression import UNMOVED, compressed, principal_axes
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.response import landing_response
from solver.inertia_relief.stress_rows import StressRows, measure_squares
from verification.inertia_relief.winged_body import balanced_landing, reduced, winged_body

SIZE = 40
FACTORS = np.array([0.85, 0.3])


@pytest.fixture
def rows() -> StressRows:
    """Rows of 300 shells and 140 beams that follow a dozen patterns and little else."""
    rng = np.random.default_rng(4)
    patterns = rng.standard_normal((12, SIZE))

    def kind(count: int) -> np.ndarray:
        shares = rng.standard_normal((count, 6, 12))
        return (shares @ patterns + 1e-3 * rng.standard_normal((count, 6, SIZE))).astype(np.float32)

    return StressRows(kind(300), kind(140), rng.standard_normal((140, 8, 5)).astype(np.float32))


def test_what_compression_leaves_out_is_bounded_for_every_element(rows):
    spread = 10.0 ** np.linspace(-2, 0, SIZE)
    stress = compressed(rows, spread)
    assert stress.pattern_counts.sum() < 0.6 * SIZE * len(stress.pattern_counts)
    shares, left = 0, []
    coordinates = np.random.default_rng(1).standard_normal((SIZE, 30)) * stress.spread[:, None]
    for block in stress.blocks():
        patterns = stress.patterns[block.patterns].astype(float)
        exact = block.rows.reshape(-1, SIZE) @ coordinates
        difference = exact - block.shares.astype(float) @ (patterns @ coordinates)
        beside = (coordinates / stress.spread[:, None]).astype(float)
        beside -= (patterns * stress.spread).T @ (patterns @ coordinates)
        squares = measure_squares(difference.reshape(len(block.rows), 6, -1)[..., :1], block.points)
        bound = block.dropped * np.linalg.norm(beside[:, 0])
        assert np.all(np.sqrt(squares.max(axis=1)) <= bound * 1.01 + 1e-4)
        left.append(np.sqrt(squares.max(axis=1)).max())
        shares += block.shares.size
    assert shares == stress.shares.size
    assert max(left) > 0.0


def test_squares_of_compressed_rows_bound_the_stress_of_unit_coordinates(rows):
    stress = compressed(rows, np.ones(SIZE))
    block = next(stress.blocks())
    factored = (block.shares @ stress.patterns[block.patterns]).reshape(block.rows.shape)
    np.testing.assert_allclose(block.squares, measure_squares(factored, block.points), rtol=1e-4)


def test_axes_in_which_landings_do_not_move_are_left_out():
    rng = np.random.default_rng(2)
    directions = np.linalg.qr(rng.standard_normal((SIZE, SIZE)))[0]
    amplitudes = np.full(SIZE, 1e-9)
    amplitudes[:15] = 10.0 ** -np.linspace(0, 3, 15)
    histories = [
        (directions * amplitudes @ rng.standard_normal((SIZE, 200))).astype(np.float32)
        for _ in range(3)
    ]
    axes, spread = principal_axes(histories, SIZE)
    assert axes.shape == (SIZE, 15)
    np.testing.assert_allclose(axes.T @ axes, np.eye(15), atol=1e-12)
    assert np.all(np.diff(spread) >= 0)
    for history in histories:
        lost = history - axes @ (axes.T @ history)
        assert np.linalg.norm(lost) <= 2 * UNMOVED * np.linalg.norm(history)


def test_without_landings_the_coordinates_stay_as_they_are():
    axes, spread = principal_axes([], 5)
    np.testing.assert_array_equal(axes, np.eye(5))
    np.testing.assert_array_equal(spread, np.ones(5))


def test_motion_does_not_depend_on_the_axes_it_is_described_in():
    winged = winged_body()
    model = reduced(winged, BasisSettings(modes=15), RayleighDamping(0.02, 3.0, 40.0))
    loads = balanced_landing(winged, FACTORS, 3, duration=0.1)
    axes = np.linalg.qr(np.random.default_rng(0).standard_normal((model.size, model.size)))[0]
    here = landing_response(assemble(model, FACTORS), loads).coordinates
    there = landing_response(assemble(model.turned(axes), FACTORS), loads).coordinates
    np.testing.assert_allclose(axes @ there, here, atol=2e-3 * np.abs(here).max())  # W terms
