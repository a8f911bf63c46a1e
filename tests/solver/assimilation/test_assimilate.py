"""Contacts corrected by their responses: synthetic landings whose truth is known.

Truth is the landing simulation of an aircraft that differs from the nominal one by the scatter of
service.  How honest the deviations are over hundreds of landings is `benchmarks.assimilation`'s to
say; here each single error must stay below what chance leaves.
"""

from dataclasses import replace

import numpy as np
import pytest

from solver.assimilation.assimilate import Assimilation, assimilate, uncorrected
from solver.assimilation.parameters import GAS_PRESSURE, contact_values
from solver.assimilation.scattered_landing import scattered_landing
from solver.flight_data.approach import Approach, fly_in
from solver.flight_data.contacts import ContactKind
from solver.flight_data.frame_file import packaged_frame
from solver.flight_data.geometry import Geometry
from solver.flight_data.parameter import Parameter
from solver.flight_data.reconstruction import Reconstruction, reconstruct
from solver.flight_data.recorder import Surroundings, record
from solver.flight_data.window import Window
from solver.gear.place import Place
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift
from solver.landing.excerpt import contact_during
from solver.landing.simulate import SimulationOptions, simulate_landing
from tests.solver.assimilation.conftest import Recovered


def first_only(reconstruction: Reconstruction, later: float = 0.0) -> Reconstruction:
    """First contact alone, found so much later than it was [s]."""
    first = reconstruction.contacts[0]
    return replace(reconstruction, contacts=(replace(first, time=first.time + later),))


@pytest.fixture(scope="module")
def corrected(
    landings: list[Recovered], aircraft: LandingAircraft, geometry: Geometry
) -> list[Assimilation]:
    return [
        assimilate(each.true.landing.window, first_only(each.reconstruction), aircraft, geometry)
        for each in landings
    ]


def test_good_recordings_are_explained_and_correct_the_state(
    corrected: list[Assimilation],
) -> None:
    for each in corrected:
        (update,) = each.updates
        assert update.is_corrected, update.misfit
        assert each.unexplained == ()
        assert each.contacts == (update.contact,)


def test_sink_rate_is_better_known_and_nearer_the_truth(
    corrected: list[Assimilation], landings: list[Recovered]
) -> None:
    before, after = [], []
    for each, given in zip(corrected, landings, strict=True):
        (update,) = each.updates
        true = given.true.landing.contact.sink_rate
        before.append(update.prior.sink_rate - true)
        after.append(update.contact.sink_rate - true)
        assert update.uncertainty.matrix[0, 0] < 0.8 * update.prior_uncertainty.matrix[0, 0]
    assert np.sum(np.square(after)) < np.sum(np.square(before))


def test_errors_of_the_whole_state_are_within_the_stated_covariance(
    corrected: list[Assimilation], landings: list[Recovered]
) -> None:
    for each, given in zip(corrected, landings, strict=True):
        error = contact_values(each.contacts[0]) - contact_values(given.true.landing.contact)
        squared = error @ np.linalg.solve(each.uncertainties[0].matrix, error)
        assert squared < 27.9  # chi-square of 9 degrees of freedom passes it once in a thousand


def test_the_simulated_peak_is_compared_as_recorded(corrected: list[Assimilation]) -> None:
    for each in corrected:
        misfit = each.misfit
        assert misfit is not None
        assert misfit.peak.posterior == pytest.approx(misfit.peak.recorded, abs=0.1)
        assert misfit.peak.rate in (8.0, 16.0)
        assert misfit.effective_parameters < misfit.measurements


def test_a_contact_found_half_a_second_late_is_unexplained_and_leaves_the_state(
    landings: list[Recovered], aircraft: LandingAircraft, geometry: Geometry
) -> None:
    given = landings[1]
    late = first_only(given.reconstruction, later=0.5)
    answer = assimilate(given.true.landing.window, late, aircraft, geometry)
    (update,) = answer.updates
    assert not update.is_corrected
    assert update.contact == update.prior
    (text,) = answer.unexplained
    assert "contact 1: normal acceleration peaked at" in text


def test_a_leaking_strut_is_named(aircraft: LandingAircraft, geometry: Geometry) -> None:
    mains = [wheel.gear for wheel in geometry.wheels if wheel.place is not Place.NOSE]
    leak = {GAS_PRESSURE + gear: float(np.log(0.3)) for gear in mains}
    frame = packaged_frame("business-jet-16")
    window = scattered_landing(aircraft, geometry, frame, 816, defects=leak).landing.window
    found = first_only(reconstruct(window, geometry))
    misfit = assimilate(window, found, aircraft, geometry).misfit
    assert misfit is not None
    assert not misfit.is_explained


def without_response(window: Window, contact: float) -> Window:
    """Window whose normal acceleration stops at the contact."""
    return replace(
        window,
        channels=tuple(
            replace(c, time=c.time[c.time < contact], value=c.value[c.time < contact])
            if c.parameter is Parameter.NORMAL_ACCELERATION
            else c
            for c in window.channels
        ),
    )


def test_what_carries_no_information_leaves_the_prior_and_says_so(
    landings: list[Recovered], aircraft: LandingAircraft, geometry: Geometry
) -> None:
    given = landings[0]
    found = first_only(given.reconstruction)
    window = without_response(given.true.landing.window, found.contacts[0].time)
    (update,) = assimilate(window, found, aircraft, geometry).updates
    assert update.misfit is None
    assert update.contact == update.prior
    assert update.uncertainty == update.prior_uncertainty
    assert "normal acceleration" in update.unchanged_because


def test_a_contact_that_the_next_one_follows_at_once_is_left_alone(
    landings: list[Recovered], aircraft: LandingAircraft, geometry: Geometry
) -> None:
    given = landings[0]
    first = given.reconstruction.contacts[0]
    bounce = replace(first, kind=ContactKind.BOUNCE, time=first.time + 0.2)
    window = without_response(given.true.landing.window, first.time)
    both = replace(given.reconstruction, contacts=(first, bounce))
    updates = assimilate(window, both, aircraft, geometry).updates
    assert "after 0.20 s" in updates[0].unchanged_because
    assert "normal acceleration" in updates[1].unchanged_because
    assert updates[1].contact.time == pytest.approx(0.2)
    assert updates[1].misfit is None


def test_a_bounce_goes_on_with_the_lift_that_the_first_response_tells(
    landings: list[Recovered], aircraft: LandingAircraft, geometry: Geometry
) -> None:
    """One course of the lift in a landing; how much there is at a contact is its own state."""
    given = landings[0]
    first = given.reconstruction.contacts[0]
    bounce = replace(first, kind=ContactKind.BOUNCE, time=first.time + 0.9)
    both = replace(given.reconstruction, contacts=(first, bounce))
    corrected, later = assimilate(given.true.landing.window, both, aircraft, geometry).updates
    assert corrected.is_corrected
    course = corrected.contact.lift
    assert course.decay_start != Lift().decay_start
    assert later.prior.lift == replace(
        course,
        decay_start=pytest.approx(max(course.decay_start - 0.9, 0.0)),
        fraction=later.prior.lift.fraction,
    )
    untold = uncorrected(both, "no mesh").contacts
    assert untold[0].lift.decay_start == Lift().decay_start
    assert untold[1].lift.decay_start == 0.0


def test_a_response_corrects_a_bounce_as_well(
    aircraft: LandingAircraft, geometry: Geometry
) -> None:
    """Main wheels that hop with the nose wheel down: the truth is one simulation of all of it."""
    before, after = [], []
    options = SimulationOptions(time_limit=4.0, stop_when_settled=False, output_interval=2e-3)
    for number, sink_rate in enumerate((2.3, 2.5, 2.7)):
        lift = Lift(fraction=1.0, decay_start=0.6)
        contact = Contact(sink_rate, 60.0, pitch=0.065, roll=0.01, lift=lift)
        history = simulate_landing(aircraft, contact, options)
        motion = fly_in(history, Approach(), np.random.default_rng(number))
        frame, around = packaged_frame("business-jet-16"), Surroundings(mass=aircraft.total_mass)
        window = record(motion, frame, geometry, around, number)
        _, bounce = assimilate(window, reconstruct(window, geometry), aircraft, geometry).updates
        assert bounce.found.nose_wheel_down
        assert bounce.is_corrected, bounce.misfit
        time = min(c.start for c in history.contacts if c.gear != "nose" and c.start > 1.0)
        at = int(np.searchsorted(history.time, time))
        true = contact_during(aircraft, history, at, lift).sink_rate
        before.append((bounce.prior.sink_rate - true) / bounce.found.state.sink_rate.sd)
        after.append((bounce.contact.sink_rate - true) / bounce.uncertainty.matrix[0, 0] ** 0.5)
        assert bounce.uncertainty.matrix[0, 0] < 0.5 * bounce.prior_uncertainty.matrix[0, 0]
    # Chi-square of three degrees of freedom passes it once in a thousand.
    assert np.sum(np.square(before)) < 16.3
    assert np.sum(np.square(after)) < 16.3


def test_wheels_that_follow_belong_to_the_contact_before(landings: list[Recovered]) -> None:
    given = landings[0].reconstruction
    nose = replace(given.contacts[0], kind=ContactKind.DEROTATION)
    answer = uncorrected(replace(given, contacts=(given.contacts[0], nose)), "no mesh")
    (update,) = answer.updates
    assert update.unchanged_because == "no mesh"
    assert answer.misfit is None
