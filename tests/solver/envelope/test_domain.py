"""The box of landings: what is inside, what is not and how it is said."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import qmc

from solver.aircraft.loading import Loading
from solver.envelope.domain import (
    COORDINATES,
    FUEL,
    MASS,
    ROLL,
    coordinates_of,
    domain_of,
    landings_at,
    lopsided,
    record_at,
    three_wheel_pitch,
    uncovered,
)
from solver.landing.contact import Contact, Lift, LiftModel
from tests.solver.verdict.rule_cases import mini_definition

CONTACT = Contact(
    sink_rate=2.0, ground_speed=55.0, pitch=0.05, roll=-0.03, drift=0.01, pitch_rate=0.02,
    roll_rate=0.01, yaw_rate=-0.005,
)  # fmt: skip


def loading(lateral: float = 0.0) -> Loading:
    return Loading(
        np.zeros(5), 11_000.0, np.array([9.9, lateral, 1.5]), {"l": 700.0, "r": 700.0}, {}, ()
    )


def test_all_wheels_touch_at_the_three_wheel_pitch() -> None:
    """Turned by it, the lowest points of nose and main wheels are equally high."""
    definition = mini_definition()
    pitch = three_wheel_pitch(definition)
    heights = {}
    for gear in definition.gears:
        axle = gear.pivot + gear.strut.extended_length * gear.axis
        low = axle[2] - gear.tyre.free_radius
        heights[gear.position] = low * math.cos(pitch) - axle[0] * math.sin(pitch)
    assert heights["nose"] == pytest.approx(heights["main"], abs=1e-12)


def test_a_mirrored_contact_has_the_same_coordinates() -> None:
    mirrored = replace(CONTACT, roll=0.03, drift=-0.01, roll_rate=-0.01, yaw_rate=0.005)
    assert coordinates_of(CONTACT, loading()) == pytest.approx(coordinates_of(mirrored, loading()))
    assert coordinates_of(CONTACT, loading())[ROLL] == 0.03


def test_a_record_of_coordinates_has_them_again() -> None:
    definition = mini_definition()
    domain = domain_of(definition, 4.0)
    wanted = 0.3 * domain.low + 0.7 * domain.high
    record = record_at(definition, wanted)
    assert sum(record.fuel.values()) == pytest.approx(wanted[FUEL])
    found = coordinates_of(
        record.contacts[0],
        Loading(
            np.zeros(5),
            record.mass or 0.0,
            np.array([record.centre_of_gravity, 0.0, 1.5]),
            record.fuel,
            {},
            (),
        ),
    )
    assert found == pytest.approx(wanted)


def test_sampled_landings_lie_inside_and_weigh_what_they_may() -> None:
    definition = mini_definition()
    domain = domain_of(definition, 4.0)
    landings = landings_at(domain, definition, qmc.Sobol(len(COORDINATES), seed=2).random(256))
    assert [domain.outside(landing) for landing in landings] == [None] * 256
    payload = landings[:, MASS] - definition.masses.operating_empty - landings[:, FUEL]
    assert payload.min() >= -1e-9
    assert payload.max() <= sum(bay.capacity for bay in definition.bays) + 1e-9
    assert landings[:, MASS].max() <= definition.masses.maximum_takeoff + 1e-9


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("roll", math.radians(9.0), "roll 9 deg is outside the envelope's 0 to 5"),
        ("drift", math.radians(4.0), "drift 4 deg is outside the envelope's -1.5 to 1.5"),
        ("yaw_rate", math.radians(-3.0), "yaw rate -3 deg/s is outside the envelope's -0.75"),
        ("ground_speed", 20.0, "ground speed 20 m/s is outside the envelope's"),
        ("lift_fraction", 0.2, "lift fraction 0.2 of the weight is outside the envelope's 0.6"),
    ],
)
def test_what_lies_outside_is_named_with_its_range(name: str, value: float, said: str) -> None:
    domain = domain_of(mini_definition(), 4.0)
    place = 0.5 * (domain.low + domain.high)
    assert domain.outside(place) is None
    place[COORDINATES.index(name)] = value
    assert said in (domain.outside(place) or "")


def test_lift_of_another_course_is_not_covered() -> None:
    assert uncovered(CONTACT) is None
    assert "held" in (uncovered(replace(CONTACT, lift=Lift(LiftModel.HELD))) or "")
    assert "decays" in (uncovered(replace(CONTACT, lift=Lift(decay_start=3.0))) or "")


def test_trimmed_lift_counts_as_what_it_was_trimmed_to() -> None:
    lift = Lift(LiftModel.TRIMMED, fraction=1.0, recorded_normal_acceleration=0.9)
    found = coordinates_of(replace(CONTACT, lift=lift), loading())
    assert found[COORDINATES.index("lift_fraction")] == 0.9


def test_a_lopsided_loading_is_not_covered() -> None:
    domain = domain_of(mini_definition(), 4.0)
    assert lopsided(domain, loading()) is None
    assert "off the plane of symmetry" in (lopsided(domain, loading(0.2)) or "")
