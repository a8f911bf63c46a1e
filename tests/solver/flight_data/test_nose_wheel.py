"""A hop of the main wheels with the nose wheel down: told, timed, and no deeper than it can be."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

from solver.flight_data.alignment import best
from solver.flight_data.approach import Approach, fly_in
from solver.flight_data.contacts import ContactKind
from solver.flight_data.frame_file import packaged_frame
from solver.flight_data.geometry import Geometry, Wheel
from solver.flight_data.nose_wheel import nose_wheel_is_down, within_travel
from solver.flight_data.onset import ramp_response, rise_onset
from solver.flight_data.parameter import Parameter
from solver.flight_data.reconstruction import FoundContact, reconstruct
from solver.flight_data.recorder import Surroundings, record
from solver.flight_data.touchdown import Estimate, TouchdownState
from solver.flight_data.window import Window
from solver.gear.place import Place
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS
from solver.landing.excerpt import contact_during
from solver.landing.simulate import SimulationOptions, simulate_landing

#: Main wheels hop for more than a second; the nose wheel comes down a few tenths before they do.
HOPS = [
    Contact(sink_rate, 60.0, pitch=pitch, roll=0.01, lift=Lift(fraction=1.0, decay_start=0.6))
    for sink_rate in (2.3, 2.6, 2.9)
    for pitch in (0.05, 0.065, 0.08)
]


@pytest.fixture(scope="module")
def state(window: Window, geometry: Geometry) -> TouchdownState:
    return reconstruct(window, geometry).contacts[0].state


@pytest.fixture(scope="module")
def hops(aircraft: LandingAircraft, geometry: Geometry) -> list[tuple[Contact, FoundContact]]:
    """What each hop ended with, and the contact found there."""
    options = SimulationOptions(time_limit=6.0, stop_when_settled=False, output_interval=2e-3)
    frame, found = packaged_frame("business-jet-8"), []
    for number, contact in enumerate(HOPS):
        history = simulate_landing(aircraft, contact, options)
        motion = fly_in(history, Approach(), np.random.default_rng(number))
        window = record(motion, frame, geometry, Surroundings(mass=12e3), number)
        time = min(
            stay.start for stay in history.contacts if stay.gear != "nose" and stay.start > 1.0
        )
        at = int(np.searchsorted(history.time, time))
        true = replace(contact_during(aircraft, history, at, contact.lift), time=time)
        assert true.nose_wheel_down
        bounces = [c for c in reconstruct(window, geometry).contacts if abs(c.time - time) < 0.3]
        found += [(true, bounce) for bounce in bounces]
    return found


def test_the_wheel_is_known_to_be_down(hops: list[tuple[Contact, FoundContact]]) -> None:
    assert len(hops) == len(HOPS)
    assert all(found.kind is ContactKind.BOUNCE for _, found in hops)
    assert all(found.nose_wheel_down for _, found in hops)


def test_such_a_bounce_is_as_uncertain_as_stated(
    hops: list[tuple[Contact, FoundContact]],
) -> None:
    """Of nine landings a mean square of three is one chance in a thousand (chi-square)."""
    errors = [
        (
            (found.time - true.time) / found.time_sd,
            (found.state.sink_rate.value - true.sink_rate) / found.state.sink_rate.sd,
            (found.state.pitch.value - true.pitch) / found.state.pitch.sd,
            (found.state.pitch_rate.value - true.pitch_rate) / found.state.pitch_rate.sd,
            # With what the nose wheel carries.
            (found.state.lift_fraction.value - true.lift.fraction) / found.state.lift_fraction.sd,
        )
        for true, found in hops
    ]
    assert np.all(np.mean(np.square(errors), axis=0) < 3.0)


def test_a_nose_in_the_air_is_not_taken_for_one_that_is_down(
    state: TouchdownState, geometry: Geometry
) -> None:
    high = replace(state, pitch=Estimate(0.1, 0.007))
    flat = replace(state, pitch=Estimate(0.0, 0.007))
    assert not nose_wheel_is_down(high, 5.0, (), geometry)
    assert nose_wheel_is_down(flat, 5.0, (), geometry)
    assert nose_wheel_is_down(flat, 5.0, (4.5,), geometry)
    assert not nose_wheel_is_down(flat, 5.0, (4.9,), geometry)  # it came down with the mains
    mains = replace(geometry, wheels=geometry.mains)
    assert not nose_wheel_is_down(flat, 5.0, (), mains)


def lowest(wheels: tuple[Wheel, ...], pitch: float) -> float:
    """Height of wheels over the origin at a pitch without roll, by a turn in the plane."""
    turned = np.array([-np.sin(pitch), 0.0, np.cos(pitch)])
    return min(float(wheel.position @ turned) for wheel in wheels)


def test_depth_is_cut_off_at_the_travel_of_the_strut(
    state: TouchdownState, geometry: Geometry
) -> None:
    """Independent: the Gaussian of the pitch integrated over the attitudes that are possible."""
    sd = 0.012
    covariance = state.covariance.copy()
    at = CONTACT_COMPONENTS.index("pitch")
    rate_at = CONTACT_COMPONENTS.index("pitch_rate")
    covariance[at, :] = covariance[:, at] = 0.0
    covariance[at, at] = sd**2
    covariance[at, rate_at] = covariance[rate_at, at] = (
        0.4 * sd * np.sqrt(covariance[rate_at, rate_at])
    )
    nose = geometry.of(Place.NOSE)
    least = min(
        pitch
        for pitch in np.arange(-0.12, 0.05, 1e-5)
        if lowest(nose, pitch) - lowest(geometry.mains, pitch) > -geometry.nose_travel
    )
    given = replace(
        state,
        roll=Estimate(0.0, 0.0),
        pitch=Estimate(least - 0.004, sd),
        covariance=covariance,
    )
    found = within_travel(given, geometry)

    def moment(power: int, about: float) -> float:
        density = norm(given.pitch.value, sd)
        top = given.pitch.value + 12 * sd
        value, _ = quad(lambda p: (p - about) ** power * density.pdf(p), least, top)
        return float(value / density.sf(least))

    mean = moment(1, 0.0)
    assert found.pitch.value == pytest.approx(mean, abs=1e-4)
    assert found.pitch.sd == pytest.approx(np.sqrt(moment(2, mean)), rel=0.01)
    # What goes with the pitch follows it, the rest stays.
    moved = (found.pitch.value - given.pitch.value) * covariance[at, rate_at] / sd**2
    assert found.pitch_rate.value - given.pitch_rate.value == pytest.approx(moved)
    assert found.sink_rate == given.sink_rate
    assert np.all(np.linalg.eigvalsh(found.covariance) > -1e-12)


def test_a_wheel_within_its_travel_is_left_where_it_is(
    state: TouchdownState, geometry: Geometry
) -> None:
    flat = replace(state, pitch=Estimate(0.03, 0.004))
    found = within_travel(flat, geometry)
    assert found.pitch.value == pytest.approx(0.03, abs=1e-6)


def test_a_load_that_comes_up_before_is_not_taken_for_the_onset(window: Window) -> None:
    """A third of the shock from 0.3 s before it, through the recorder's filter, at all phases."""
    normal = best(window, Parameter.NORMAL_ACCELERATION)
    assert normal is not None
    corner = normal.entry.corner.value
    grid = np.arange(-0.5, 0.2, 0.005)
    errors = {True: [], False: []}  # type: dict[bool, list[float]]
    for phase in np.linspace(0.0, normal.interval, 9)[1:]:
        time = np.arange(-3.0, 1.0, normal.interval) + phase
        value = 0.7 + 0.4 * ramp_response(time + 0.3, 0.3, corner)
        value = value + 1.2 * ramp_response(time, 0.06, corner)
        series = replace(normal, time=time - normal.lag, value=value)
        for is_led, found in errors.items():
            onset = rise_onset("onset", series, grid, 0.03, 0.15, 0.0, is_led=is_led)
            assert onset is not None
            found.append(onset.time)
    assert np.mean(errors[False]) < -0.04
    assert abs(np.mean(errors[True])) < 0.02
