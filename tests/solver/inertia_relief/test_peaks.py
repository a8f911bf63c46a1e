"""The peak search against the evaluation of every element at every sample."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.arrays import Array
from solver.inertia_relief.compression import compress
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.response import ReducedResponse


def stress_model(shells: int, beams: int, size: int, seed: int) -> ReducedModel:
    """Return a model of random stress rows, small for fast coordinates as in a real one."""
    rng = np.random.default_rng(seed)
    decay = np.linspace(1.0, 0.1, size)
    empty = np.zeros((1, 6 + size, 6 + size))
    return ReducedModel(
        key="",
        damping=RayleighDamping(),
        origin=np.zeros(3),
        mass=empty,
        rate_operators=np.zeros((1, 12, 6 + size, 6 + size), dtype=np.float32),
        applied=np.zeros((6 + size, 6)),
        inertia=np.zeros((1, 6 + size, 12)),
        shell_stress=(rng.standard_normal((shells, 6, size)) * decay).astype(np.float32),
        beam_stress=(rng.standard_normal((beams, 6, size)) * decay).astype(np.float32),
        beam_points=rng.standard_normal((beams, 8, 5)).astype(np.float32),
    )


def response_of(coordinates: Array) -> ReducedResponse:
    time = np.arange(coordinates.shape[1]) * 1e-3
    return ReducedResponse(time, coordinates, 0, 0.0, 0.0)


def every_sample(model: ReducedModel, coordinates: Array) -> Array:
    """Von Mises stress (ne, nt) of all elements at all samples, in double precision."""
    shells = (model.shell_stress.astype(float) @ coordinates) ** 2
    rows = model.beam_stress.astype(float) @ coordinates
    normal = model.beam_points.astype(float) @ rows[:, :5]
    faces = np.maximum(shells[:, :3].sum(axis=1), shells[:, 3:].sum(axis=1))
    points = (normal**2).max(axis=1) + rows[:, 5] ** 2
    return np.sqrt(np.concatenate([faces, points]))


def vibration(size: int, count: int, seed: int, highest: float) -> Array:
    """Decaying and growing oscillations up to ``highest`` cycles each sample, with an offset."""
    rng = np.random.default_rng(seed)
    time = np.arange(count)
    frequency = rng.uniform(0.0, highest, size)[:, None]
    centre, width = rng.uniform(0, count, (size, 1)), rng.uniform(2, count + 3, (size, 1))
    envelope = np.exp(-(((time - centre) / width) ** 2))
    phase = rng.uniform(0, 6.3, (size, 1))
    return rng.standard_normal((size, 1)) + 3 * envelope * np.cos(
        2 * np.pi * frequency * time + phase
    )


@settings(max_examples=40, deadline=None)
@given(
    size=st.integers(1, 40),
    count=st.integers(2, 400),
    highest=st.sampled_from([0.002, 0.02, 0.1, 0.5]),
    seed=st.integers(0, 10_000),
)
def test_every_peak_equals_that_of_evaluating_every_sample(size, count, highest, seed):
    model = stress_model(7, 5, size, seed)
    coordinates = vibration(size, count, seed, highest)
    peaks = find_peaks(model, response_of(coordinates), tolerance=1e-9)
    expected = every_sample(model, coordinates)
    np.testing.assert_allclose(peaks.stress, expected.max(axis=1), rtol=2e-5)
    at_sample = np.take_along_axis(expected, peaks.sample[:, None], axis=1)[:, 0]
    np.testing.assert_allclose(at_sample, expected.max(axis=1), rtol=2e-5)


@pytest.mark.parametrize("sample", [0, 1, 15, 16, 17, 31, 98, 99])
def test_a_single_spike_between_coarse_samples_is_found(sample):
    model = stress_model(3, 3, 4, 1)
    coordinates = np.ones((4, 100))
    coordinates[:, sample] = 50.0
    peaks = find_peaks(model, response_of(coordinates))
    assert np.all(peaks.sample == sample)
    np.testing.assert_allclose(peaks.stress, every_sample(model, coordinates)[:, sample], rtol=2e-5)


def test_smooth_histories_need_few_evaluations():
    model = stress_model(40, 40, 12, 3)
    peaks = find_peaks(model, response_of(vibration(12, 1000, 3, 0.003)))
    assert peaks.evaluated < 0.35


def test_history_at_rest_has_no_peaks():
    model = stress_model(2, 2, 3, 0)
    peaks = find_peaks(model, response_of(np.zeros((3, 20))))
    assert np.all(peaks.stress == 0.0)
    assert peaks.dropped == 0.0


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-7])
def test_compression_drops_no_more_than_stated_at_any_sample(tolerance):
    rng = np.random.default_rng(6)
    scale = 10.0 ** -np.linspace(0, 9, 50)
    turn = np.linalg.qr(rng.standard_normal((50, 50)))[0]
    coordinates = turn @ (scale[:, None] * vibration(50, 300, 2, 0.05))
    history = compress(coordinates, tolerance)
    left_out = np.linalg.norm(coordinates - history.directions @ history.amplitudes, axis=0)
    largest = np.linalg.norm(coordinates, axis=0).max()
    assert left_out.max() <= tolerance * largest
    assert history.dropped == pytest.approx(left_out.max(), rel=1e-5, abs=1e-13 * largest)
    assert len(history.amplitudes) < 50


def test_stress_error_of_compression_is_bounded_by_what_it_drops():
    model = stress_model(20, 20, 30, 5)
    coordinates = (10.0 ** -np.linspace(0, 6, 30))[:, None] * vibration(30, 200, 9, 0.05)
    peaks = find_peaks(model, response_of(coordinates), tolerance=1e-3)
    exact = every_sample(model, coordinates).max(axis=1)
    beams = np.concatenate(
        [model.beam_points @ model.beam_stress[:, :5], model.beam_stress[:, 5:]], axis=1
    )
    rows = [*model.shell_stress, *beams]
    norm = np.array([np.linalg.norm(part.astype(float), 2) for part in rows])
    largest = np.linalg.norm(coordinates, axis=0).max()
    assert np.all(np.abs(peaks.stress - exact) <= norm * peaks.dropped * largest + 2e-5 * exact)
    assert peaks.rank < 30
