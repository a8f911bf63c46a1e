"""What a motion counts: mean squares over landings, and slender elements."""

import numpy as np
from scipy.sparse import csr_array

from solver.fe.stress import StressRecovery
from solver.inertia_relief.basis import BasisSettings, build_basis
from solver.inertia_relief.compression import principal_axes
from solver.inertia_relief.motion_measure import LEAST_STRESSED, motion_measure
from verification.inertia_relief.winged_body import winged_body


def test_energy_and_stress_have_a_mean_square_of_one_each() -> None:
    winged = winged_body(6, 8)
    basis = build_basis(
        winged.structure, winged.structure.inertia, winged.groups, winged.applied,
        BasisSettings(modes=10, harmonic_states=()),
    )  # fmt: skip
    size = basis.shape[1]
    history = (
        np.random.default_rng(1).standard_normal((size, 300)) * np.geomspace(1, 1e-3, size)[:, None]
    )
    covariance = history @ history.T / 300
    measure = motion_measure(winged.recovery, basis, covariance)
    np.testing.assert_allclose(measure, measure.T, rtol=1e-5, atol=1e-9 * measure.max())
    squares = np.einsum("it,ij,jt->t", history, measure, history)
    np.testing.assert_allclose(squares.mean(), 2.0, rtol=1e-5)
    energy = np.sum(history**2, axis=0)
    assert np.all(squares > energy / energy.mean())


def beams_that_each_feel_one_coordinate(sensitivities: np.ndarray) -> StressRecovery:
    """Recovery of beams whose every stress is a coordinate's amplitude times a factor [Pa]."""
    count = len(sensitivities)
    rows = np.zeros((9 * count, count))
    for beam, factor in enumerate(sensitivities):
        rows[9 * beam : 9 * beam + 9, beam] = factor
    return StressRecovery(csr_array((0, count)), csr_array(rows))


def test_motion_of_little_energy_that_stresses_an_element_is_kept() -> None:
    """The second coordinate has a millionth of the motion and half of the first one's stress."""
    amplitudes = np.array([1.0, 1e-6, 1e-6])
    recovery = beams_that_each_feel_one_coordinate(np.array([1e6, 5e11, 1.0]))
    history = (amplitudes[:, None] * np.random.default_rng(0).standard_normal((3, 500))).astype(
        np.float32
    )
    by_energy, _ = principal_axes([history], 3)
    assert by_energy.shape == (3, 1)
    axes, spread = principal_axes(
        [history], 3, lambda covariance: motion_measure(recovery, np.eye(3), covariance)
    )
    assert axes.shape == (3, 2)
    np.testing.assert_allclose(axes.T @ axes, np.eye(2), atol=1e-9)
    assert np.abs(axes[1, 0]) > 0.99
    assert spread[0] < spread[1]


def test_an_element_below_the_least_stress_counts_by_its_share_of_the_largest() -> None:
    """Diagonal entries in closed form: energy, and s^2 over the larger of both squares."""
    recovery = beams_that_each_feel_one_coordinate(np.array([1.0, 0.01]))
    measure = motion_measure(recovery, np.eye(2), np.eye(2))
    parts = np.array([1.0, 1e-4 / LEAST_STRESSED**2])
    np.testing.assert_allclose(measure, np.diag(0.5 + parts / parts.sum()), rtol=1e-6)
