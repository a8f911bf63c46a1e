"""Terms left out of the reduced coefficients change what they change at full order."""

from dataclasses import replace

import numpy as np
import pytest

from solver.inertia_relief.basis import BasisSettings
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.full_order import BodyLoads
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.motion import RigidMotion
from verification.inertia_relief.free_beam import history
from verification.inertia_relief.omitted_terms import OMISSIONS, peaks_of, without
from verification.inertia_relief.winged_body import balanced_landing, reduced, winged_body

DAMPING = RayleighDamping(0.02, 3.0, 40.0)
FACTORS = np.array([0.85, 0.3])
BY_NAME = {omission.name: omission for omission in OMISSIONS}


def full_order_stress(winged, loads, omission):
    """Peaks of the full order with r loads as applied loads, and rates that only u sees."""
    body = winged.body(FACTORS)
    motion = loads.motion.at(body.centre_of_gravity)
    inertial = body.inertia.rigid_load_shapes(motion.origin)
    amplitudes = motion.inertia_amplitudes()
    for columns in omission.of_r:
        amplitudes[:, columns] = 0.0
    # the frame's acceleration makes up for the r loads that its rates bring along
    rate = motion.rate if not omission.of_u else np.zeros_like(motion.rate)
    derivative = motion.rate_derivative if not omission.of_u else np.zeros_like(motion.rate)
    turning = RigidMotion(motion.origin, np.zeros_like(rate), np.zeros_like(rate), rate, derivative)
    amplitudes = amplitudes - turning.inertia_amplitudes()
    shapes = np.hstack([winged.applied, inertial])
    loads = BodyLoads(
        loads.time, shapes, np.hstack([loads.applied_amplitudes(), amplitudes]), turning
    )
    u = history(body, loads, DAMPING, substeps=2)
    recovery = winged.recovery
    return recovery.von_mises(recovery.shell_operator @ u, recovery.beam_operator @ u).max(axis=1)


@pytest.mark.parametrize(
    "name", ["u: all", "r: centrifugal, M W W r and w × J w", "r: Euler, M W' r"]
)
def test_reduced_and_full_order_lose_the_same(name):
    winged = winged_body(6, 8)
    loads = balanced_landing(winged, FACTORS, 5, duration=0.2)
    complete, omission = replace(BY_NAME[name], of_u=(), of_r=()), BY_NAME[name]
    expected = full_order_stress(winged, loads, omission) - full_order_stress(
        winged, loads, complete
    )
    loading = assemble(reduced(winged, BasisSettings(modes=30), DAMPING), FACTORS)
    whole = peaks_of(loading, loads).stress
    found = peaks_of(without(loading, omission), loads).stress - whole
    if omission.of_r and name.startswith("r: Euler"):
        # an angular acceleration only moves the frame: its load is M times a rigid motion
        assert np.abs(expected).max() < 1e-9 * whole.max()
        assert np.abs(found).max() < 1e-6 * whole.max()
    else:
        assert np.abs(expected).max() > 1e-3 * whole.max()
        np.testing.assert_allclose(found, expected, atol=0.03 * np.abs(expected).max())
