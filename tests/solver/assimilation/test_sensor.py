"""Predicted samples are those that the recorder model shows without errors."""

from dataclasses import replace

import numpy as np
import pytest

from solver.assimilation.sensor import SensorCourses, SensorErrors, mean_specific_force
from solver.flight_data.frame import Certainty, Figure, RecordedParameter, RecorderFrame
from solver.flight_data.frame_file import packaged_frame
from solver.flight_data.geometry import Geometry
from solver.flight_data.motion import motion_of_landing, velocity_at
from solver.flight_data.parameter import Parameter
from solver.flight_data.recorder import Surroundings, record
from solver.frames import rotation_matrix
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.history import LandingHistory
from solver.landing.records import GRAVITY
from solver.landing.simulate import SimulationOptions, simulate_landing

COMPARED = (
    Parameter.NORMAL_ACCELERATION,
    Parameter.LATERAL_ACCELERATION,
    Parameter.LONGITUDINAL_ACCELERATION,
    Parameter.PITCH,
    Parameter.ROLL,
)


@pytest.fixture(scope="module")
def history(aircraft: LandingAircraft) -> LandingHistory:
    contact = Contact(2.0, 60.0, pitch=0.08, roll=0.02, pitch_rate=0.02, roll_rate=-0.03)
    options = SimulationOptions(output_interval=1e-3, time_limit=1.2, stop_when_settled=False)
    return simulate_landing(aircraft, contact, options)


def faultless(entry: RecordedParameter) -> RecordedParameter:
    none = Figure(0.0, Certainty.ASSUMED)
    zero = dict.fromkeys(("noise", "bias", "scale", "delay_scatter", "resolution"), none)
    return replace(entry, **zero)


@pytest.fixture(scope="module")
def frame() -> RecorderFrame:
    given = packaged_frame("business-jet-16")
    return replace(given, parameters=tuple(faultless(entry) for entry in given.parameters))


@pytest.mark.parametrize("parameter", COMPARED)
def test_prediction_is_the_recording_without_errors(
    parameter: Parameter, history: LandingHistory, frame: RecorderFrame, geometry: Geometry
) -> None:
    window = record(motion_of_landing(history), frame, geometry, Surroundings(), 3)
    channel = window.first(parameter)
    assert channel is not None
    courses = SensorCourses(history, geometry.installation.accelerometer)
    predicted = courses.predicted(frame.require(parameter), channel.time)
    # Means over 1 ms against values at instants, behind an 8 Hz filter.
    inside = channel.time > 0.05
    scale = np.ptp(channel.value)
    np.testing.assert_allclose(predicted[inside], channel.value[inside], atol=0.01 * scale)


def test_mean_force_adds_up_to_the_change_of_velocity(
    history: LandingHistory, geometry: Geometry
) -> None:
    motion = motion_of_landing(history)
    place = geometry.installation.accelerometer
    force = mean_specific_force(motion, place)[1:]
    turn = rotation_matrix(motion.attitude)
    middle = (turn[:-1] + turn[1:]) / 2
    earth = np.einsum("tij,tj->ti", middle, force) + np.array([0.0, 0.0, GRAVITY])
    velocity = velocity_at(motion, place)
    gained = velocity[-1] - velocity[0]
    np.testing.assert_allclose(earth.sum(axis=0) * motion.interval, gained, atol=1e-4)


def test_a_coarse_grid_predicts_what_a_fine_one_does(
    aircraft: LandingAircraft, history: LandingHistory, geometry: Geometry
) -> None:
    contact = Contact(2.0, 60.0, pitch=0.08, roll=0.02, pitch_rate=0.02, roll_rate=-0.03)
    options = SimulationOptions(output_interval=4e-3, time_limit=1.2, stop_when_settled=False)
    place = geometry.installation.accelerometer
    entry = packaged_frame("business-jet-8").require(Parameter.NORMAL_ACCELERATION)
    time = np.arange(0.05, 1.1, 0.05)
    fine = SensorCourses(history, place).predicted(entry, time)
    coarse = SensorCourses(simulate_landing(aircraft, contact, options), place)
    np.testing.assert_allclose(coarse.predicted(entry, time), fine, atol=0.005)


def test_errors_shift_stretch_and_delay(history: LandingHistory, geometry: Geometry) -> None:
    courses = SensorCourses(history, geometry.installation.accelerometer)
    entry = packaged_frame("business-jet-8").require(Parameter.NORMAL_ACCELERATION)
    time = np.linspace(0.1, 1.0, 10)
    plain = courses.predicted(entry, time)
    biased = courses.predicted(entry, time, SensorErrors(bias=0.1))
    np.testing.assert_allclose(biased, plain + 0.1)
    # The datum is taken at one g, so that a gain turns about it.
    stretched = courses.predicted(entry, time, SensorErrors(scale=0.2))
    np.testing.assert_allclose(stretched - 1.0, 1.2 * (plain - 1.0))
    late = courses.predicted(entry, time + 0.04, SensorErrors(delay=0.04))
    np.testing.assert_allclose(late, plain)


def test_an_angle_before_the_contact_goes_on_at_its_rate(
    history: LandingHistory, geometry: Geometry
) -> None:
    courses = SensorCourses(history, geometry.installation.accelerometer)
    entry = replace(
        packaged_frame("business-jet-8").require(Parameter.ROLL),
        delay=Figure(0.0, Certainty.ASSUMED),
    )
    before = courses.predicted(entry, np.array([-0.1, 0.0]))
    # Euler rate of roll, ISO 1151-1, at the contact's pitch and rates; yaw rate is zero.
    rate = -0.03 + np.tan(0.08) * 0.02 * np.sin(0.02)
    assert before[1] - before[0] == pytest.approx(0.1 * rate, rel=0.02)
