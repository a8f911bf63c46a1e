"""Compression of basis and stress rows: what it leaves out is bounded, what it keeps is exact."""

import numpy as np
import pytest

from solver.inertia_relief.basis import BasisSettings
from solver.inertia_relief.compression import UNMOVED, compressed, principal_axes
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.reduced_stress import PATTERN_GROUP, group_edges
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


def group_amplitudes(history: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Norms (groups, nt) of groups of a history (k, nt)."""
    return np.sqrt(np.add.reduceat(history**2, edges[:-1], axis=0))


def von_mises(field: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Largest von Mises stress (n, nt) of a history (6 n, nt) of stress rows."""
    field = field.reshape(-1, 6, field.shape[1])
    return np.stack(
        [
            np.sqrt(measure_squares(field[:, :, t : t + 1], points).max(axis=1))
            for t in range(field.shape[2])
        ],
        axis=1,
    )


def test_what_compression_leaves_out_is_bounded_for_every_element(rows):
    spread = 10.0 ** np.linspace(-2, 0, SIZE)
    stress = compressed(rows, spread)
    assert stress.pattern_shapes[:, 0].sum() < 0.6 * SIZE * len(stress.pattern_shapes)
    rng = np.random.default_rng(1)
    coordinates = rng.standard_normal((SIZE, 30)) * spread[:, None] / stress.scale[:, None]
    groups = group_amplitudes(coordinates[::-1], group_edges(SIZE))
    shares, share_of_bound = 0, []
    for block in stress.blocks():
        known = coordinates[-block.patterns.shape[1] :]
        patterns = block.patterns.astype(float) @ known
        exact = block.rows.exact().reshape(-1, SIZE) @ coordinates
        left = von_mises(exact - block.shares.astype(float) @ patterns, block.points)
        bound = block.rest_norms[:, : len(groups)] @ groups
        assert np.all(left <= bound * 1.001 + 1e-5)
        share_of_bound.append((left / bound).max())
        shares += block.shares.size
    assert shares == stress.shares.size
    assert max(share_of_bound) > 0.1


def test_stress_from_groups_of_patterns_and_of_coordinates_is_bounded(rows):
    stress = compressed(rows, np.ones(SIZE))
    rng = np.random.default_rng(2)
    for block in stress.blocks():
        shares = block.shares.astype(float)
        edges = group_edges(shares.shape[1], PATTERN_GROUP)
        assert block.leading in edges
        patterns = rng.standard_normal((shares.shape[1], 20))
        bound = block.pattern_norms[:, : len(edges) - 1] @ group_amplitudes(patterns, edges)
        assert np.all(von_mises(shares @ patterns, block.points) <= bound * 1.001)
        known = rng.standard_normal((block.patterns.shape[1], 20))
        coordinates = np.concatenate([np.zeros((SIZE - len(known), 20)), known])
        groups = group_amplitudes(coordinates[::-1], group_edges(SIZE))
        bound = block.rest_norms[:, len(groups) :] @ groups
        factored = shares @ (block.patterns.astype(float) @ known)
        assert np.all(von_mises(factored, block.points) <= bound * 1.001)


@pytest.mark.parametrize("count", [1, 2, 7, 16, 100])
def test_groups_cover_every_amplitude_once(count):
    edges = group_edges(count, 16)
    assert (edges[0], edges[-1]) == (0, count)
    widths = np.diff(edges)
    assert np.all((widths > 0) & (widths <= 16))


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
