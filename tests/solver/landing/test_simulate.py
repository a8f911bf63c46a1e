"""Start, contacts, lift and end of a landing."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from solver.errors import ModelError, RecordError
from solver.landing.aircraft import Aerodynamics
from solver.landing.contact import Contact, Lift, LiftModel
from solver.landing.history import Outcome
from solver.landing.initial import initial_state
from solver.landing.lift import lift_course, lift_fraction
from solver.landing.peaks import refined_peak
from solver.landing.simulate import SimulationOptions, simulate_landing
from tests.solver.landing.business_jet import business_jet, rigid_legged
from tests.solver.landing.free_flight import fly, records

G = 9.80665


@pytest.mark.parametrize("fraction", [1.0, 0.6])
def test_gears_hang_at_rest_before_the_ground(fraction: float) -> None:
    aircraft = business_jet()
    airframe, gears = records(aircraft)
    course = (fraction, np.inf, 1.0, fraction)
    contact = Contact(2.0, 60.0, pitch=0.05, roll=0.03, pitch_rate=0.05)
    state = initial_state(contact, airframe, gears, np.array(course))
    state[2] -= 10.0  # high above the ground: whatever moves now would be a spurious ring
    flight = fly(airframe, gears, state, 0.05, course=course)
    strokes = flight.states[:, 13::5][:, :3]
    assert np.ptp(strokes, axis=0).max() < 2e-6
    # The strut transmits what the unsprung mass hangs with, the stop the rest of the preload.
    hanging = flight.gear_answers["strut_force"][0, 0]
    acceleration = flight.answers["acceleration"][0] - flight.answers["gravity"][0]
    assert hanging == pytest.approx(95.0 * acceleration[2], rel=0.05)


def test_first_tyre_just_touches_and_the_others_do_not() -> None:
    airframe, gears = records(business_jet())
    course = np.array([1.0, np.inf, 1.0, 1.0])
    state = initial_state(Contact(1.0, 60.0, pitch=0.05, roll=0.03), airframe, gears, course)
    answers = fly(airframe, gears, state, 1e-3).gear_answers
    assert answers["deflection"][0].max() == pytest.approx(0.0, abs=1e-9)
    assert answers["deflection"][0].argmax() == 1  # the right wheel, as the right wing is down


def test_centre_of_gravity_of_the_whole_aircraft_has_the_contacts_speed() -> None:
    aircraft = business_jet()
    contact = Contact(2.0, 60.0, pitch=0.05, roll_rate=0.2, pitch_rate=0.1, yaw_rate=-0.1)
    history = simulate_landing(aircraft, contact, SimulationOptions(time_limit=0.01))
    turn_down = history.gravity[0] / G
    arm = (aircraft.total_centre_of_gravity - aircraft.centre_of_gravity) * [-1, 1, -1]
    velocity = history.velocity[0] + np.cross(history.rate[0], arm)
    assert velocity @ turn_down == pytest.approx(2.0, rel=1e-12)
    assert np.linalg.norm(velocity) == pytest.approx(np.hypot(60.0, 2.0), rel=1e-12)


def test_aircraft_in_trim_has_no_acceleration_before_the_ground_acts() -> None:
    history = simulate_landing(
        business_jet(Aerodynamics()), Contact(2.0, 60.0), SimulationOptions(time_limit=0.01)
    )
    assert np.abs(history.acceleration[0]).max() < 0.01
    assert np.abs(history.rate_derivative[0]).max() < 1e-3
    assert history.normal_load_factor[0] == pytest.approx(1.0, abs=1e-3)


def test_lift_equal_to_weight_for_ever_hops_and_says_so() -> None:
    contact = Contact(1.5, 60.0, pitch=0.05, lift=Lift(LiftModel.HELD))
    history = simulate_landing(business_jet(Aerodynamics()), contact)
    assert history.outcome is Outcome.TIME_LIMIT
    assert history.time[-1] == pytest.approx(4.0)
    first = next(c for c in history.contacts if c.gear == "left")
    assert first.start == 0.0
    assert first.end is not None
    assert first.closure_speed == pytest.approx(1.5, abs=0.05)


def test_decaying_lift_settles_with_the_weight_on_the_wheels() -> None:
    aircraft = business_jet()
    history = simulate_landing(aircraft, Contact(1.0, 60.0, pitch=0.04))
    assert history.outcome is Outcome.SETTLED
    assert history.time[-1] < 4.0
    window = history.time > history.time[-1] - 0.15
    assert np.abs(history.rate[window, :2]).max() < 0.05
    assert all(np.abs(gear.stroke_rate[window]).max() < 0.15 for gear in history.gears)
    # What is left of the motion, 0.15 m/s in 0.1 s, is a sixth of the weight.
    load = -sum(gear.ground_force[-1, 2] for gear in history.gears)
    lift = 0.3 + 0.7 * np.exp(-(history.time[-1] - 0.5))
    assert load == pytest.approx((1 - lift) * aircraft.total_mass * G, rel=0.25)
    assert {c.gear for c in history.contacts if c.end is None} == {"left", "right", "nose"}


def test_every_bounce_is_reported_with_its_own_peak() -> None:
    history = simulate_landing(business_jet(), Contact(2.0, 60.0, pitch=0.05))
    for gear in history.gears:
        stays = [c for c in history.contacts if c.gear == gear.name]
        force = -gear.ground_force[:, 2]
        for earlier, later in pairwise(stays):
            assert earlier.end is not None
            assert earlier.end < later.start
            between = (history.time > earlier.end) & (history.time < later.start)
            assert np.all(force[between] == 0)
        assert max(c.peak_ground_force for c in stays) == pytest.approx(force.max(), rel=1e-3)
    starts = [contact.start for contact in history.contacts]
    assert starts == sorted(starts)
    assert len(history.contacts) > 3


def test_lift_that_answers_to_the_motion_damps_the_bounce() -> None:
    plain = business_jet()
    answering = replace(plain, aerodynamics=replace(plain.aerodynamics, lift_slope_area=5.0 * 47.9))
    contact = Contact(2.0, 60.0, pitch=0.05)
    hop = [c for c in simulate_landing(plain, contact).contacts if c.gear == "left"]
    stay = [c for c in simulate_landing(answering, contact).contacts if c.gear == "left"]
    assert len(hop) > 1
    assert len(stay) == 1


def test_closed_stop_is_reached_but_not_passed_in_a_crash() -> None:
    aircraft = rigid_legged()
    history = simulate_landing(
        aircraft, Contact(5.0, 60.0, lift=Lift(LiftModel.HELD)), SimulationOptions(time_limit=0.3)
    )
    assert 0.38 < max(gear.stroke.max() for gear in history.gears) < 0.42
    assert history.energy.stops.max() > 30 * history.energy.stops[0]
    assert history.energy.closure_error < 1e-4


def test_course_of_the_lift() -> None:
    course = lift_course(Lift(fraction=0.9, decay_start=0.4, decay_time=0.5, residual_fraction=0.1))
    values = (course.fraction, course.decay_start, course.decay_time, course.residual_fraction)
    assert lift_fraction(0.3, *values) == 0.9
    assert lift_fraction(0.9, *values) == pytest.approx(0.1 + 0.8 * np.exp(-1.0))
    assert course.final_fraction == 0.1
    held = lift_course(Lift(LiftModel.HELD, fraction=0.9))
    assert lift_fraction(100.0, held.fraction, held.decay_start, 1.0, 0.0) == 0.9
    trimmed = lift_course(Lift(LiftModel.TRIMMED, recorded_normal_acceleration=1.08))
    assert trimmed.fraction == 1.08


@pytest.mark.parametrize(
    ("contact", "words"),
    [
        (Contact(-1.0, 60.0), "sink_rate -1 is outside 0.01 to 15"),
        (Contact(1.0, float("nan")), "ground_speed nan is outside"),
        (Contact(1.0, 60.0, pitch=1.6), "pitch 1.6 is outside"),
        (Contact(1.0, 60.0, lift=Lift(fraction=-1.0)), "fraction -1 is outside"),
        (Contact(1.0, 60.0, lift=Lift(LiftModel.TRIMMED)), "needs recorded_normal_acceleration"),
        (Contact(1.0, 60.0, lift=Lift(decay_time=0.0)), "decay_time"),
    ],
)
def test_impossible_contact_is_refused_by_field_value_and_range(
    contact: Contact, words: str
) -> None:
    with pytest.raises(RecordError, match=words):
        simulate_landing(rigid_legged(), contact)


def test_impossible_aircraft_is_refused() -> None:
    plain = rigid_legged()
    with pytest.raises(ModelError, match="principal moments"):
        replace(plain, inertia=np.diag([1e4, 1e4, 1e5]))
    with pytest.raises(ModelError, match="mass"):
        replace(plain, mass=0.0)
    with pytest.raises(ModelError, match="distinct"):
        replace(plain, gears=plain.gears[:1] * 2)


def test_peak_between_samples_is_that_of_a_parabola() -> None:
    time = np.linspace(0.0, 1.0, 11)
    moment, value = refined_peak(time, 3.0 - 20.0 * (time - 0.537) ** 2)
    assert moment == pytest.approx(0.537, abs=1e-12)
    assert value == pytest.approx(3.0, abs=1e-12)
    assert refined_peak(time, time) == (1.0, 1.0)
