"""Harmonic responses that the basis is made of, against their series of modes."""

import numpy as np
import pytest

from solver.inertia_relief.basis import elastic_modes, harmonic_response
from verification.inertia_relief.winged_body import WingedBody, winged_body

FACTORS = np.array([0.5, 0.5])


@pytest.fixture(scope="module")
def winged() -> WingedBody:
    return winged_body(6, 8)


@pytest.mark.parametrize("loss", [0.0, 0.15])
def test_every_mode_answers_as_an_oscillator_with_the_loss(winged: WingedBody, loss: float) -> None:
    """``q = phi' f / (w_n^2 - w^2 (1 - i loss))``, in phase and out of phase side by side."""
    body = winged.body(FACTORS)
    frequencies, shapes = elastic_modes(body, 12)
    frequency = 30.0
    response = harmonic_response(body, winged.applied, frequency, loss)
    found = shapes.T @ (body.mass @ response)
    stretched = frequencies**2 - (2 * np.pi * frequency) ** 2 * (1 - 1j * loss)
    expected = (shapes.T @ winged.applied) / stretched[:, None]
    scale = np.abs(expected).max()
    np.testing.assert_allclose(
        found, np.hstack([expected.real, expected.imag]), rtol=1e-5, atol=1e-6 * scale
    )
    momentum = body.rigid_momentum.T @ response
    assert (
        np.abs(momentum).max()
        < 1e-9 * np.abs(body.rigid_momentum).max() * np.abs(response).sum(axis=0).max()
    )
