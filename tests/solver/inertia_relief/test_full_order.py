"""Full-order integration against modal series, exact oscillators and other axes."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from solver.errors import ModelError
from solver.inertia_relief.accumulate import PeakAccumulator
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.full_order import BodyLoads, integrate_together
from solver.inertia_relief.motion import RigidMotion
from solver.inertia_relief.static import inertia_relief
from verification.inertia_relief.beam_dynamics import (
    LENGTH,
    spin_frequencies,
    spinning_step_response,
    step_response,
)
from verification.inertia_relief.free_beam import history
from verification.inertia_relief.spin_up import (
    FINAL_RATE,
    Ramp,
    by_inertia_relief,
    by_segments,
    linear_theory,
    steady_extension,
)
from verification.inertia_relief.time_steps import newmark_error
from verification.inertia_relief.winged_body import (
    balanced_landing,
    full_order_peaks,
    turned_landing,
    winged_body,
)


def test_free_beam_under_a_step_load_follows_its_modal_series():
    _, found, expected = step_response()
    np.testing.assert_allclose(found, expected, atol=5e-3 * np.abs(expected).max())


def test_beam_spinning_about_its_axis_answers_at_its_frequencies_plus_and_minus_the_spin():
    """In space the deflection is a beam under a turning force: an exact modal oscillator."""
    _, found, expected = spinning_step_response()
    scale = np.abs(expected).max()
    np.testing.assert_allclose(found, expected, atol=1e-2 * scale)
    assert np.abs(found.real).max() > 0.2 * scale  # the Coriolis force moves it out of the plane


@pytest.mark.parametrize("depth", [0.02, 0.2])
def test_frequencies_in_spinning_axes_are_those_at_rest_plus_and_minus_the_spin(depth):
    """To rounding, and only as long as W acts on the rotary inertias as well."""
    found, expected = spin_frequencies(depth)
    np.testing.assert_allclose(found, expected, rtol=1e-9)
    without, _ = spin_frequencies(depth, rotary_rates=False)
    slenderness = depth / LENGTH
    assert np.abs(without / expected - 1).max() > slenderness**2


def test_beam_spun_up_smoothly_follows_the_linear_theory_of_the_mean_axis_frame():
    """Ritz series of the linear equation; steady extension rho A w^2 L^3 / (3 E A)."""
    time = 0.05 * np.arange(401)
    ramp = Ramp(FINAL_RATE)
    found, expected = by_inertia_relief(ramp, time, count=20), linear_theory(ramp, time)
    np.testing.assert_allclose(found.lag, expected.lag, atol=3e-3 * np.abs(expected.lag).max())
    np.testing.assert_allclose(found.extension, expected.extension, atol=1e-7)
    assert found.extension[-1] == pytest.approx(steady_extension(FINAL_RATE), rel=1e-3)


def test_linear_theory_leaves_out_a_share_of_the_square_of_the_rate():
    """Geometric stiffness, which a chain of masses in space has: a quarter at half the rate."""
    time = 0.05 * np.arange(401)
    errors = []
    for rate in (3.0, 1.5):
        exact = by_segments(Ramp(rate), time, 20).lag
        errors.append(by_inertia_relief(Ramp(rate), time, count=20).lag.min() / exact.min() - 1)
    assert errors[0] / errors[1] == pytest.approx(4.0, abs=0.4)
    assert 0.0 < errors[0] < 0.08


def test_time_integration_converges_with_second_order():
    result = newmark_error(levels=3, duration=0.1)
    assert result.order == pytest.approx(2.0, abs=0.1)
    assert result.errors[-1] < 1e-4


def test_constant_loads_leave_the_structure_in_its_steady_state():
    winged = winged_body(6, 8)
    factors = np.array([0.5, 0.5])
    body = winged.body(factors)
    time = np.arange(11) * 1e-3
    rate = np.broadcast_to([0.05, -0.1, 0.08], (11, 3))
    derivative = np.broadcast_to([0.2, 0.1, -0.3], (11, 3))
    zero = np.zeros((11, 3))
    motion = RigidMotion(body.centre_of_gravity, zero, zero, rate, derivative)
    amplitudes = np.ones((11, winged.applied.shape[1])) * 1e3
    loads = BodyLoads(time, winged.applied, amplitudes, motion)
    found = history(body, loads, RayleighDamping(), substeps=2)
    np.testing.assert_allclose(
        found, np.repeat(found[:, :1], 11, axis=1), atol=1e-8 * np.abs(found).max()
    )
    still = inertia_relief(body).displacement(winged.applied @ amplitudes[0])
    assert np.abs(found[:, 0] - still).max() > 1e-5 * np.abs(still).max()  # W terms take part


@pytest.mark.parametrize("seed", [3, 8])
def test_peaks_do_not_depend_on_origin_and_direction_of_the_axes(seed):
    turn = Rotation.random(rng=np.random.default_rng(seed)).as_matrix()
    shift = np.array([30.0, -4.0, 9.0])
    factors = np.array([0.7, 0.1])
    straight = winged_body(6, 8)
    turned = winged_body(6, 8, turn, shift)
    loads = balanced_landing(straight, factors, seed, duration=0.1)
    peaks = full_order_peaks(straight, factors, loads, RayleighDamping())
    other = full_order_peaks(turned, factors, turned_landing(loads, turn, shift), RayleighDamping())
    np.testing.assert_allclose(other.stress, peaks.stress, rtol=1e-6)


def test_peaks_keep_the_earliest_largest_value_of_any_block():
    winged = winged_body(6, 8)
    factors = np.array([0.0, 1.0])
    loads = balanced_landing(winged, factors, 1, duration=0.08)
    body_loads = BodyLoads(loads.time, winged.applied, loads.applied_amplitudes(), loads.motion)
    whole = history(winged.body(factors), body_loads, RayleighDamping(), 1)
    recovery = winged.recovery
    stress = recovery.von_mises(recovery.shell_operator @ whole, recovery.beam_operator @ whole)
    peaks = full_order_peaks(winged, factors, loads, RayleighDamping())
    np.testing.assert_array_equal(peaks.sample, stress.argmax(axis=1))
    np.testing.assert_allclose(peaks.stress, stress.max(axis=1), rtol=1e-13)


def test_landings_side_by_side_are_each_by_itself():
    winged, factors = winged_body(6, 8), np.array([0.85, 0.3])
    landings = [balanced_landing(winged, factors, seed, duration=0.03) for seed in (3, 8)]
    peaks = [PeakAccumulator(winged.recovery) for _ in landings]
    damping = RayleighDamping(0.02, 3.0, 40.0)
    loads = [
        BodyLoads(each.time, winged.applied, each.applied_amplitudes(), each.motion)
        for each in landings
    ]
    integrate_together(winged.body(factors), loads, damping, peaks, substeps=2)
    for landing, found in zip(landings, peaks, strict=True):
        alone = full_order_peaks(winged, factors, landing, damping, substeps=2)
        np.testing.assert_allclose(found.stress, alone.stress, rtol=1e-6)


def test_landings_side_by_side_must_share_their_time():
    winged, factors = winged_body(6, 8), np.array([0.85, 0.3])
    short, long = (balanced_landing(winged, factors, 3, duration) for duration in (0.02, 0.03))
    loads = [
        BodyLoads(each.time, winged.applied, each.applied_amplitudes(), each.motion)
        for each in (short, long)
    ]
    with pytest.raises(ModelError, match="landing 1 has another time grid"):
        integrate_together(
            winged.body(factors), loads, RayleighDamping(), [lambda *_: None, lambda *_: None]
        )
