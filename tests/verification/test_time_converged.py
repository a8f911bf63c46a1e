"""The limit of small steps, against much smaller steps."""

import numpy as np

from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.full_order import BodyLoads
from verification.inertia_relief.time_converged import converged_peaks, limit_weights
from verification.inertia_relief.winged_body import (
    balanced_landing,
    full_order_peaks,
    winged_body,
)

DAMPING = RayleighDamping(0.02, 3.0, 40.0)
FACTORS = np.array([0.85, 0.3])


def test_weights_are_those_of_richardson_and_leave_every_power_out() -> None:
    np.testing.assert_allclose(limit_weights((2, 4)), [-1 / 3, 4 / 3], rtol=1e-12)
    steps = 1.0 / np.array([2.0, 3.0, 4.0])
    weights = limit_weights((2, 3, 4))
    # 3 + 5 h^2 - 2 h^4 at h = 0
    np.testing.assert_allclose(weights @ (3 + 5 * steps**2 - 2 * steps**4), 3.0, rtol=1e-12)


def test_limit_is_much_nearer_to_tiny_steps_than_the_shortest_ones_and_tells_its_error() -> None:
    winged = winged_body(6, 8)
    loads = balanced_landing(winged, FACTORS, seed=4, duration=0.2, step=5e-3)
    body_loads = BodyLoads(loads.time, winged.applied, loads.applied_amplitudes(), loads.motion)
    found = converged_peaks(
        winged.body(FACTORS), [body_loads] * 2, DAMPING, winged.recovery, (8, 12, 16), 1e-10
    )
    np.testing.assert_array_equal(found.stress[0], found.stress[1])
    # independent of the weights of three: Richardson's of two, at a sixth of the shortest steps
    tiny = [full_order_peaks(winged, FACTORS, loads, DAMPING, count).stress for count in (48, 96)]
    exact = tiny[1] + (tiny[1] - tiny[0]) / 3
    stressed = exact > 0.1 * exact.max()
    error = np.abs(found.stress[0] / exact - 1)[stressed].max()
    finest = full_order_peaks(winged, FACTORS, loads, DAMPING, 16).stress
    assert error < 0.25 * np.abs(finest / exact - 1)[stressed].max()
    assert error < 2 * found.error[0][stressed].max()
