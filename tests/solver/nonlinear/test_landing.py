"""From a simulated landing to nonlinear stresses, beside extended inertia relief."""

from math import radians

import numpy as np
import pytest

from solver.errors import ModelError
from solver.frames import quaternion_from_euler, rotation_matrix
from solver.inertia_relief.accumulate import PeakAccumulator
from solver.inertia_relief.build import airframe_damping
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.full_order import BodyLoads, integrate_full_order
from solver.inertia_relief.loads import applied_shapes, landing_loads
from solver.landing.contact import Contact
from solver.landing.simulate import SimulationOptions, simulate_landing
from solver.nonlinear.landing import nonlinear_landing
from solver.nonlinear.loads import directed_landing_loads, structural_attitude
from solver.nonlinear.recorder import NonlinearLanding

FACTORS = np.array([0.45, 0.3, 0.8])
DURATION = 0.15


@pytest.fixture(scope="module")
def history(mini):
    contact = Contact(
        sink_rate=1.5, ground_speed=55.0, pitch=radians(3), roll=radians(3), roll_rate=radians(4)
    )
    options = SimulationOptions(time_limit=0.3, stop_when_settled=False)
    return simulate_landing(mini.landing_aircraft(FACTORS), contact, options)


@pytest.fixture(scope="module")
def landing(mini, history):
    return nonlinear_landing(mini, FACTORS, history, duration=DURATION, stress_times=[0.0, 0.1])


def test_attitude_turns_structural_axes_to_those_of_the_first_sample(history):
    matrices = rotation_matrix(structural_attitude(history.attitude))
    np.testing.assert_allclose(matrices[0], np.eye(3), atol=1e-14)
    # seen from inertial axes gravity stands still; z of both is what the landing calls -z
    gravity = history.gravity * np.array([-1.0, 1.0, -1.0])
    seen = np.einsum("tij,tj->ti", matrices, gravity)
    np.testing.assert_allclose(seen, np.broadcast_to(seen[0], seen.shape), atol=1e-10)
    # a pitch-up of the body lifts the nose, which points to -x, towards +z
    level, up = quaternion_from_euler(0, 0, 0), quaternion_from_euler(0, radians(10), 0)
    nose = rotation_matrix(structural_attitude(np.stack([level, up])))[1] @ [-1.0, 0.0, 0.0]
    np.testing.assert_allclose(nose, [-np.cos(radians(10)), 0, np.sin(radians(10))], atol=1e-14)


def test_peaks_are_those_of_inertia_relief_but_for_geometry(mini, history, landing):
    loads = landing_loads(mini, history).until(DURATION)
    peaks = PeakAccumulator(mini.recovery)
    integrate_full_order(
        free_body(mini.structure, mini.inertia(FACTORS)),
        BodyLoads(loads.time, applied_shapes(mini), loads.applied_amplitudes(), loads.motion),
        airframe_damping(mini),
        peaks,
        substeps=2,
    )
    stressed = peaks.stress > 0.2 * peaks.stress.max()
    assert stressed.sum() > 20
    np.testing.assert_allclose(landing.peak_stress[stressed], peaks.stress[stressed], rtol=0.02)
    assert landing.peak_stress.argmax() == peaks.stress.argmax()


def test_account_of_energy_and_momentum_closes(landing):
    assert landing.energy_error < 1e-5
    assert landing.momentum_error.max() < 1e-5
    assert landing.energies[0, 0] > 0.0  # it starts with a rate


def test_airframe_follows_the_rigid_aircraft_without_being_led(mini, history, landing):
    count = len(landing.time)
    expected = rotation_matrix(structural_attitude(history.attitude))[:count]
    drift = np.einsum("tij,tkj->tik", landing.turn, expected)
    angle = np.arccos(np.clip((np.trace(drift, axis1=1, axis2=2) - 1) / 2, -1, 1))
    assert angle.max() < radians(0.3)


def test_kept_fields_are_those_of_their_samples(landing):
    np.testing.assert_array_equal(landing.stress_samples, [0, 100])
    np.testing.assert_allclose(landing.stress.max(axis=1), landing.largest_stress[[0, 100]])
    assert np.all(landing.stress <= landing.peak_stress + 1e-6)


def test_loads_of_another_landing_are_refused(mini, history):
    loads = landing_loads(mini, history).until(0.1)
    object.__setattr__(loads, "time", loads.time + 0.5)
    with pytest.raises(ModelError, match="time grid"):
        directed_landing_loads(mini, history, loads)


def test_result_can_be_stored_as_arrays_and_taken_back(landing):
    again = NonlinearLanding.of(landing.arrays())
    assert again.report == landing.report
    np.testing.assert_array_equal(again.stress, landing.stress)
    np.testing.assert_array_equal(again.momentum_error, landing.momentum_error)
