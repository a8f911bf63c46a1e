"""A landing taken apart at its hop has the loads of the whole."""

import math
from dataclasses import replace

import numpy as np
import pytest

from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift
from solver.landing.excerpt import contact_during
from solver.landing.history import LandingHistory
from solver.landing.sequence import Passage, passage, simulate_contacts, until_next
from solver.landing.simulate import SimulationOptions, simulate_landing

#: Hops off the main wheels with the nose up and comes down on them again after 1.5 s.
FIRST = Contact(2.0, 60.0, pitch=0.1, pitch_rate=0.15, lift=Lift(fraction=1.0, decay_start=0.6))


@pytest.fixture(scope="module")
def whole(aircraft: LandingAircraft) -> LandingHistory:
    return simulate_landing(aircraft, FIRST, SimulationOptions(stop_when_settled=False))


@pytest.fixture(scope="module")
def touch(whole: LandingHistory) -> int:
    """First sample of the second contact."""
    in_air = np.all([gear.tyre_deflection <= 0.0 for gear in whole.gears], axis=0)
    return int(np.flatnonzero(in_air)[-1]) + 1


@pytest.fixture(scope="module")
def second(aircraft: LandingAircraft, whole: LandingHistory, touch: int) -> Contact:
    return contact_during(aircraft, whole, touch, FIRST.lift)


def test_the_parts_have_the_loads_of_the_whole(
    aircraft: LandingAircraft, whole: LandingHistory, touch: int, second: Contact
) -> None:
    """Against the simulation in one go; the drag is a spun-up wheel's, a few percent of the load.

    Half a percent is left by legs that still swing, and by angle of attack and speed, to which the
    lift of a contact is referred.
    """
    before, after = simulate_contacts(aircraft, (FIRST, second))
    assert before.time[-1] == pytest.approx(second.time, abs=1e-9)
    np.testing.assert_array_equal(before.attitude, whole.attitude[: len(before.time)])
    for part, gear in zip(after.gears, whole.gears, strict=True):
        rest = gear.ground_force[touch:]
        assert part.ground_force[:, 2].min() == pytest.approx(rest[:, 2].min(), rel=0.01)
        assert part.ground_force[:, 0].min() == pytest.approx(rest[:, 0].min(), rel=0.02)
        assert part.stroke.max() == pytest.approx(gear.stroke[touch:].max(), rel=0.01)


def test_wheels_at_rest_would_be_dragged(aircraft: LandingAircraft, second: Contact) -> None:
    """What a hop that began with wheels at rest showed: the drag of a spin-up, which was over."""
    *_, after = simulate_contacts(aircraft, (FIRST, second))
    at_rest = simulate_landing(aircraft, second)
    for turning, dragged in zip(after.gears[:2], at_rest.gears[:2], strict=True):
        vertical = -dragged.ground_force[:, 2].min()
        assert -dragged.ground_force[:, 0].min() > 0.3 * vertical
        assert -turning.ground_force[:, 0].min() < 0.05 * vertical


def test_wheels_go_on_as_they_turned(aircraft: LandingAircraft, whole: LandingHistory) -> None:
    """The mains have rolled, the nose wheel has not touched; in the air no speed changes."""
    later = replace(FIRST, time=1.2)
    found = passage((FIRST, later), 1, whole)
    assert found.wheel_speeds is not None
    row = int(np.searchsorted(whole.time, 1.2))
    expected = [gear.wheel_speed[row] for gear in whole.gears]
    np.testing.assert_array_equal(found.wheel_speeds, expected)
    left, right, nose = found.wheel_speeds
    radius = aircraft.gears[0].tyre.free_radius
    assert (left, right) == pytest.approx((FIRST.ground_speed / radius,) * 2, rel=0.05)
    # Its speed is counted against the airframe, which has pitched meanwhile.
    assert abs(nose) < 0.01 * left
    (_, after) = simulate_contacts(aircraft, (FIRST, later), SimulationOptions(time_limit=1.5))
    assert [gear.wheel_speed[0] for gear in after.gears] == expected
    assert after.energy.closure_error < 1e-4


def test_a_single_contact_is_simulated_as_ever(aircraft: LandingAircraft) -> None:
    (alone,) = simulate_contacts(aircraft, (FIRST,), SimulationOptions(time_limit=0.3))
    ever = simulate_landing(aircraft, FIRST, SimulationOptions(time_limit=0.3))
    np.testing.assert_array_equal(alone.acceleration, ever.acceleration)


@pytest.mark.parametrize(
    ("times", "expected"),
    [
        ((0.0, 1.5, 3.0), (1.5, 1.5, math.inf)),
        # No times: followed to the end, with the wheels as they were there.
        ((0.0, 0.0), (math.inf, math.inf)),
        # Two wheels of one touchdown.
        ((0.0, 0.1), (math.inf, math.inf)),
    ],
)
def test_a_contact_ends_where_the_next_begins(
    times: tuple[float, ...], expected: tuple[float, ...]
) -> None:
    contacts = [replace(FIRST, time=time) for time in times]
    assert tuple(until_next(contacts, number) for number in range(len(contacts))) == expected


def test_contacts_without_times_take_the_wheels_over_all_the_same(whole: LandingHistory) -> None:
    found = passage((FIRST, FIRST), 1, whole)
    assert found.wheel_speeds is not None
    np.testing.assert_array_equal(found.wheel_speeds, [g.wheel_speed[-1] for g in whole.gears])
    assert passage((FIRST, FIRST), 0, None).wheel_speeds is None


def test_a_shorter_limit_stays(aircraft: LandingAircraft) -> None:
    history = Passage(duration=1.0).simulate(aircraft, FIRST, SimulationOptions(time_limit=0.2))
    assert history.time[-1] == pytest.approx(0.2)


def test_lift_is_the_same_whoever_looks_at_it() -> None:
    course = Lift(fraction=0.9, decay_start=0.8, decay_time=1.3, residual_fraction=0.2)
    assert course.seen_from(0.3) == replace(course, decay_start=pytest.approx(0.5))
    assert course.seen_from(2.0).decay_start == 0.0
