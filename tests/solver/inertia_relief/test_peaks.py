"""The peak search against the evaluation of every element at every sample."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.arrays import Array
from solver.errors import ModelError
from solver.inertia_relief.compression import compressed
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.peaks import (
    LANDINGS_AT_ONCE,
    find_peaks,
    find_peaks_together,
)
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.response import ReducedResponse
from solver.inertia_relief.stress_rows import StressRows


def stress_model(shells: int, beams: int, size: int, seed: int) -> ReducedModel:
    """Return a model of random stress rows, small for fast coordinates as in a real one."""
    rng = np.random.default_rng(seed)
    decay = np.linspace(1.0, 0.1, size)
    empty = np.zeros((1, 6 + size, 6 + size))
    rows = StressRows(
        (rng.standard_normal((shells, 6, size)) * decay).astype(np.float32),
        (rng.standard_normal((beams, 6, size)) * decay).astype(np.float32),
        rng.standard_normal((beams, 8, 5)).astype(np.float32),
    )
    return ReducedModel(
        key="",
        damping=RayleighDamping(),
        origin=np.zeros(3),
        mass=empty,
        rate_operators=np.zeros((1, 12, 6 + size, 6 + size), dtype=np.float32),
        rate_norms=np.zeros((1, 12, 6 + size)),
        applied=np.zeros((6 + size, 6)),
        inertia=np.zeros((1, 6 + size, 12)),
        stress=compressed(rows, decay),
    )


def response_of(coordinates: Array) -> ReducedResponse:
    time = np.arange(coordinates.shape[1]) * 1e-3
    return ReducedResponse(time, coordinates.astype(np.float32), 0, 0.0, 0.0)


def every_sample(model: ReducedModel, coordinates: Array) -> Array:
    """Von Mises stress (ne, nt) of all elements at all samples, in double precision."""
    coordinates = coordinates / model.stress.scale[:, None]
    shells = (model.stress.shell_rows.exact().astype(float) @ coordinates) ** 2
    rows = model.stress.beam_rows.exact().astype(float) @ coordinates
    normal = model.stress.beam_points.astype(float) @ rows[:, :5]
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


HIGHEST = st.sampled_from([0.002, 0.02, 0.1, 0.5])


@settings(max_examples=40, deadline=None)
@given(
    size=st.integers(1, 60), count=st.integers(2, 400), highest=HIGHEST, seed=st.integers(0, 10_000)
)
def test_every_peak_equals_that_of_evaluating_every_sample(size, count, highest, seed):
    model = stress_model(7, 5, size, seed)
    coordinates = vibration(size, count, seed, highest)
    peaks = find_peaks(model, response_of(coordinates))
    expected = every_sample(model, coordinates)
    np.testing.assert_allclose(peaks.stress, expected.max(axis=1), rtol=2e-5)
    at_sample = np.take_along_axis(expected, peaks.sample[:, None], axis=1)[:, 0]
    np.testing.assert_allclose(at_sample, expected.max(axis=1), rtol=2e-5)


@settings(max_examples=40, deadline=None)
@given(
    size=st.integers(1, 60),
    count=st.integers(2, 400),
    highest=HIGHEST,
    seed=st.integers(0, 10_000),
    share=st.floats(0.0, 1.5),
)
def test_peaks_above_their_floors_are_those_of_every_sample(size, count, highest, seed, share):
    """Floors are drawn around each element's peak, some of them nil."""
    model = stress_model(7, 5, size, seed)
    coordinates = vibration(size, count, seed, highest)
    stress = every_sample(model, coordinates)
    expected = stress.max(axis=1)
    floor = share * expected * np.random.default_rng(seed).choice([0.0, 0.5, 1.0], 12)
    peaks = find_peaks(model, response_of(coordinates), floor)
    below = peaks.below_floor
    np.testing.assert_allclose(peaks.stress, np.maximum(expected, floor), rtol=2e-5)
    assert np.array_equal(peaks.stress[below], floor[below])
    clear = np.abs(expected - floor) > 2e-5 * expected
    assert np.array_equal(below[clear], (expected <= floor)[clear])
    at_sample = np.take_along_axis(stress, peaks.sample[:, None], axis=1)[:, 0]
    np.testing.assert_allclose(at_sample[~below], peaks.stress[~below], rtol=2e-5)
    assert np.all(peaks.sample[below] == -1)
    assert np.all(np.isnan(peaks.time) == below)


def test_floors_above_every_peak_leave_nothing_to_evaluate():
    model = stress_model(40, 40, 12, 3)
    coordinates = vibration(12, 300, 3, 0.01)
    floor = 1.01 * every_sample(model, coordinates).max(axis=1)
    peaks = find_peaks(model, response_of(coordinates), floor)
    assert np.all(peaks.below_floor)
    assert np.array_equal(peaks.stress, floor)
    assert find_peaks(model, response_of(coordinates), 10 * floor.max()).evaluated == 0.0


def test_elements_at_rest_without_a_floor_peak_at_nothing_beside_others_with_one():
    model = stress_model(4, 0, 3, 0)
    floor = np.array([0.0, 1.0, 0.0, 1.0])
    peaks = find_peaks(model, response_of(np.zeros((3, 20))), floor)
    assert np.array_equal(peaks.stress, floor)
    assert np.array_equal(peaks.below_floor, floor > 0.0)
    assert np.array_equal(peaks.sample, [0, -1, 0, -1])


def test_landings_together_are_each_by_itself():
    """Of other lengths, and more of them than go through a block at once."""
    model = stress_model(300, 20, 12, 3)
    responses = [
        response_of(vibration(12, 40 + 3 * seed, seed, 0.05))
        for seed in range(LANDINGS_AT_ONCE + 3)
    ]
    floor = np.where(np.arange(320) % 3 == 0, 8.0, 0.0)
    together = find_peaks_together(model, responses, floor)
    for response, found in zip(responses, together, strict=True):
        alone = find_peaks(model, response, floor)
        assert np.array_equal(found.stress, alone.stress)
        assert np.array_equal(found.sample, alone.sample)


@pytest.mark.parametrize(
    ("floor", "words"),
    [
        (-1.0, "floor must not be negative, got -1 Pa"),
        (np.ones(3), "floor must be one stress or 4"),
        (np.nan, "floor must not be negative"),
    ],
)
def test_floors_are_checked(floor, words):
    model = stress_model(2, 2, 3, 0)
    with pytest.raises(ModelError, match=words):
        find_peaks(model, response_of(np.ones((3, 20))), floor)


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
    assert peaks.evaluated < 0.2


def test_history_at_rest_has_no_peaks():
    model = stress_model(2, 2, 3, 0)
    peaks = find_peaks(model, response_of(np.zeros((3, 20))))
    assert np.all(peaks.stress == 0.0)


def test_motion_that_is_not_a_number_has_no_peak():
    model = stress_model(2, 2, 3, 0)
    coordinates = np.ones((3, 20))
    coordinates[:, 7] = np.nan
    assert np.all(np.isnan(find_peaks(model, response_of(np.full((3, 20), np.nan))).stress))
    find_peaks(model, response_of(coordinates))  # answers, whatever it is


def test_long_and_calm_histories_need_no_more_evaluations_than_short_ones():
    model = stress_model(20, 20, 12, 3)
    short = vibration(12, 300, 3, 0.01)
    long = np.hstack([short, np.repeat(short[:, -1:], 1700, axis=1)])
    few = find_peaks(model, response_of(short)).evaluated * 300
    many = find_peaks(model, response_of(long)).evaluated * 2000
    assert many <= few + 1
