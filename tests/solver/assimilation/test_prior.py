"""Parameters of a contact: what each changes, and their joint prior."""

from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from solver.aircraft.definition_reader import load_definition
from solver.assimilation.model_error import ModelError, acceleration_error, turned
from solver.assimilation.parameters import (
    ServiceScatter,
    contact_values,
    contact_with,
    perturbed_aircraft,
    perturbed_lift,
    service_parameters,
)
from solver.assimilation.samples import ChannelSamples, Response, response_after
from solver.assimilation.state import INSTANT, Believed, prior, simulated, unit_of
from solver.flight_data.geometry import Geometry
from solver.flight_data.parameter import Parameter
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS
from tests.solver.assimilation.conftest import Recovered

CONTACT = Contact(2.0, 60.0, pitch=0.08, roll=0.01)


@pytest.fixture(scope="module")
def response(landings: list[Recovered]) -> Response:
    given = landings[1]
    first = given.reconstruction.contacts[0]
    found = response_after(
        given.true.landing.window, first.time, 0.1, 0.8, given.reconstruction.datum, ModelError()
    )
    assert found is not None
    return found


@pytest.fixture(scope="module")
def believed(aircraft: LandingAircraft, geometry: Geometry, landings: list[Recovered]) -> Believed:
    state = landings[1].reconstruction.contacts[0].state
    return Believed(aircraft, geometry, CONTACT, state.covariance, 0.03, ServiceScatter())


def test_no_change_is_the_nominal_aircraft(aircraft: LandingAircraft) -> None:
    nothing = dict.fromkeys(service_parameters(aircraft, ServiceScatter(), 0.05), 0.0)
    same = perturbed_aircraft(aircraft, nothing)
    assert same.mass == aircraft.mass
    assert [g.strut for g in same.gears] == [g.strut for g in aircraft.gears]
    assert perturbed_lift(Lift(), nothing) == Lift()


def test_a_factor_changes_its_strut_alone(aircraft: LandingAircraft) -> None:
    changes = dict.fromkeys(service_parameters(aircraft, ServiceScatter(), 0.05), 0.0)
    name = aircraft.gears[1].name
    changed = perturbed_aircraft(aircraft, changes | {f"gas_pressure {name}": np.log(0.3)})
    pressures = [
        new.strut.initial_gas_pressure / old.strut.initial_gas_pressure
        for new, old in zip(changed.gears, aircraft.gears, strict=True)
    ]
    assert pressures == pytest.approx([1.0, 0.3, 1.0])


def test_state_of_a_contact_goes_round(aircraft: LandingAircraft) -> None:
    values = np.arange(1.0, 10.0) / 20.0
    values[4] = 55.0  # a ground speed
    np.testing.assert_array_equal(contact_values(contact_with(CONTACT, values)), values)


def test_a_state_out_of_range_is_kept_at_its_end() -> None:
    values = contact_values(CONTACT)
    values[0] = -0.4
    assert contact_with(CONTACT, values).sink_rate == 0.01


def test_prior_holds_the_given_covariance_and_what_is_shared_with_the_samples(
    believed: Believed, response: Response
) -> None:
    joint = prior(believed, response.channels)
    whole = joint.covariance(np.eye(len(joint.names)))
    count = len(CONTACT_COMPONENTS)
    np.testing.assert_allclose(whole[:count, :count], believed.covariance, rtol=1e-6, atol=1e-10)
    roll, bias = joint.names.index("roll"), joint.names.index("roll bias")
    # What the level showed too high, the roll was taken too high by.
    assert whole[roll, bias] == pytest.approx(-whole[bias, bias], rel=0.05)
    instant = joint.names.index(INSTANT)
    scatter = response.channels[0].entry.delay_scatter.value
    assert whole[instant, instant] == pytest.approx(0.03**2 + scatter**2, rel=1e-6)


def test_expected_parameters_are_the_landing_as_believed(
    believed: Believed, response: Response
) -> None:
    joint = prior(believed, response.channels)
    aircraft, contact = simulated(joint, joint.named(np.zeros(len(joint.names))))
    assert contact == CONTACT
    assert aircraft.mass == believed.aircraft.mass


def test_units_are_those_of_the_quantities() -> None:
    names = ("sink_rate", "instant", "gas_pressure left", "centre_of_gravity", "pitch bias")
    others = ("normal_acceleration bias", "roll delay", "residual_lift", "accelerometer z")
    units = [unit_of(name) for name in (*names, *others)]
    assert units == ["m/s", "s", "ln", "m", "rad", "g", "s", "1", "m"]


def test_a_turned_angle_scatters_as_its_closed_form() -> None:
    after = np.array([-0.2, 0.3, 0.5])
    covariance = turned(after, 0.6)
    assert covariance[0, 0] == 0.0
    assert covariance[1, 1] == pytest.approx(0.6 * 0.3**3 / 3)
    # Integral of (t1 - s)(t2 - s) from 0 to t1.
    s = np.linspace(0.0, 0.3, 20001)
    assert covariance[1, 2] == pytest.approx(0.6 * np.trapezoid((0.3 - s) * (0.5 - s), s), rel=1e-6)


def test_the_simulations_error_grows_with_what_was_recorded() -> None:
    after, value = np.array([-0.05, 0.05, 0.15, 0.25]), np.array([1.0, 1.8, 2.0, 1.5])
    model = ModelError(response=0.1, normal_air=0.0)
    covariance = acceleration_error(Parameter.NORMAL_ACCELERATION, after, value, model)
    np.testing.assert_allclose(np.sqrt(np.diag(covariance)), [0.0, 0.08, 0.1, 0.1])
    assert np.linalg.eigvalsh(covariance).min() > -1e-12


def test_only_normal_acceleration_reaches_back_before_the_contact(response: Response) -> None:
    for channel in response.channels:
        after = channel.time - channel.entry.delay.value
        assert (after.min() < 0.0) == (channel.parameter is Parameter.NORMAL_ACCELERATION)
        assert after.max() <= 0.8


def test_samples_are_whitened_by_their_covariance(response: Response) -> None:
    channel: ChannelSamples = response.channels[0]
    product = channel.whiten @ channel.covariance @ channel.whiten.T
    np.testing.assert_allclose(product, np.eye(len(channel.time)), atol=1e-9)
    assert response.whiten.shape == (len(response.measured),) * 2


def test_without_normal_acceleration_there_is_nothing_to_compare(
    landings: list[Recovered],
) -> None:
    window = landings[0].true.landing.window
    kept = tuple(c for c in window.channels if c.parameter is not Parameter.NORMAL_ACCELERATION)
    found = response_after(replace(window, channels=kept), 0.0, 0.1, 0.8, None, ModelError())
    assert found is None


def test_an_aircraft_that_states_no_scatter_has_the_usual_one(aircraft_folder: Path) -> None:
    """Two rooms name the usual scatter, a definition file and an estimate without one."""
    stated = ServiceScatter.stated(load_definition(aircraft_folder / "mini").scatter)
    usual = ServiceScatter()
    for field in fields(ServiceScatter):
        assert getattr(stated, field.name) == pytest.approx(getattr(usual, field.name))
