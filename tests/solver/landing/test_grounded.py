"""Main wheels that come back from a hop while the nose wheel stayed on the ground."""

from dataclasses import replace

import numpy as np
import pytest

from solver.frames import body_structural, rotation_matrix
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift, LiftModel
from solver.landing.excerpt import contact_during
from solver.landing.history import LandingHistory
from solver.landing.records import GRAVITY
from solver.landing.simulate import SimulationOptions, simulate_landing

#: Hops off its main wheels; the nose wheel comes down at 1.25 s, the main wheels at 1.67 s.
FIRST = Contact(2.5, 60.0, pitch=0.08, roll=0.01, lift=Lift(fraction=1.0, decay_start=0.6))

SHORT = SimulationOptions(time_limit=1.0, stop_when_settled=False)


@pytest.fixture(scope="module")
def whole(aircraft: LandingAircraft) -> LandingHistory:
    return simulate_landing(aircraft, FIRST, SimulationOptions(stop_when_settled=False))


@pytest.fixture(scope="module")
def touch(whole: LandingHistory) -> int:
    """First sample at which a main wheel is back on the ground; the nose wheel has been."""
    left, right, nose = (gear.tyre_deflection > 0.0 for gear in whole.gears)
    hop = np.flatnonzero(~left & ~right & nose)
    return int(hop[-1]) + 1


@pytest.fixture(scope="module")
def second(aircraft: LandingAircraft, whole: LandingHistory, touch: int) -> Contact:
    return contact_during(aircraft, whole, touch, FIRST.lift)


def main_loads(history: LandingHistory, first: int = 0) -> list[float]:
    return [float(-gear.ground_force[first:, 2].min()) for gear in history.gears[:2]]


def test_the_contact_has_the_loads_of_the_whole_landing(
    aircraft: LandingAircraft, whole: LandingHistory, touch: int, second: Contact
) -> None:
    """Against the simulation in one go; a nose wheel that just touched leaves them far too hard."""
    speeds = np.array([gear.wheel_speed[touch] for gear in whole.gears])
    after = simulate_landing(aircraft, second, SHORT, speeds)
    assert main_loads(after) == pytest.approx(main_loads(whole, touch), rel=0.01)
    nose, real = after.gears[2], whole.gears[2]
    assert nose.stroke[0] == pytest.approx(real.stroke[touch], abs=2e-3)
    assert nose.stroke_rate[0] == pytest.approx(real.stroke_rate[touch], abs=0.05)
    assert nose.wheel_speed[0] == pytest.approx(real.wheel_speed[touch], rel=0.01)
    rest = real.strut_force[touch : touch + len(after.time)]
    assert nose.strut_force.max() == pytest.approx(rest.max(), rel=0.03)

    air = second.lift.fraction + real.ground_force[touch, 2] / (aircraft.total_mass * GRAVITY)
    touching = replace(second, nose_wheel_down=False, lift=replace(second.lift, fraction=air))
    harder = simulate_landing(aircraft, touching, SHORT, speeds)
    assert np.all(np.array(main_loads(harder)) > 1.2 * np.array(main_loads(whole, touch)))


def test_what_carries_the_aircraft_is_what_the_accelerometer_shows(
    aircraft: LandingAircraft, second: Contact
) -> None:
    """Newton's law: whoever carries it, the centre of gravity falls with the rest of its weight."""
    contact = replace(second, roll=0.0, drift=0.0, roll_rate=0.0, yaw_rate=0.0)
    down = simulate_landing(aircraft, contact, SHORT)
    assert down.gears[2].ground_force[0, 2] < -0.03 * aircraft.total_mass * GRAVITY
    turn = rotation_matrix(down.attitude[0])
    rate, arm = down.rate[0], body_structural(
        aircraft.total_centre_of_gravity - aircraft.centre_of_gravity
    )  # fmt: skip
    falling = down.acceleration[0] + np.cross(down.rate_derivative[0], arm)
    falling = falling + np.cross(rate, np.cross(rate, arm))
    # Moving struts, 2 % of the mass, do not fall with it.
    expected = (1.0 - second.lift.fraction) * GRAVITY
    assert (turn @ falling)[2] == pytest.approx(expected, abs=0.02 * GRAVITY)


def test_strut_and_tyre_share_the_depth_and_nothing_rings(
    aircraft: LandingAircraft, second: Contact
) -> None:
    """Heights of the wheels from the attitude alone, struts upright to a degree."""
    contact = replace(second, roll=0.0, drift=0.0, roll_rate=0.0, yaw_rate=0.0)
    history = simulate_landing(aircraft, contact, SHORT)
    bottoms = [
        gear.extended_axle - np.array([0.0, 0.0, gear.tyre.free_radius]) for gear in aircraft.gears
    ]
    across = np.array([-np.sin(contact.pitch), 0.0, np.cos(contact.pitch)])
    depth = float((bottoms[0] - bottoms[2]) @ across)
    nose = history.gears[2]
    assert depth > 0.1
    assert nose.stroke[0] + nose.tyre_deflection[0] == pytest.approx(depth, abs=0.01)
    # Against the weight: the load goes on as it began, over the time a wheel would bounce in.
    change = np.ptp(nose.ground_force[:5, 2]) / (aircraft.total_mass * GRAVITY)
    assert change < 0.02
    assert history.energy.closure_error < 1e-4


def test_a_nose_wheel_in_the_air_stays_there(aircraft: LandingAircraft) -> None:
    contact = Contact(1.5, 60.0, pitch=0.09)
    down = simulate_landing(aircraft, replace(contact, nose_wheel_down=True), SHORT)
    ever = simulate_landing(aircraft, contact, SHORT)
    np.testing.assert_array_equal(down.acceleration, ever.acceleration)


@pytest.mark.parametrize(
    ("lift", "most"),
    [
        (Lift(fraction=0.5, residual_fraction=0.3), 0.2),  # lift does not rise to what it tends to
        (Lift(LiftModel.HELD, fraction=0.2), 0.2),  # nor does it pull the aircraft down
        (Lift(fraction=0.3, residual_fraction=0.3), 0.0),
        (Lift(fraction=0.1, residual_fraction=0.3), 0.0),
    ],
)
def test_an_attitude_that_the_nose_wheel_cannot_bear_leaves_the_mains_in_the_air(
    aircraft: LandingAircraft, lift: Lift, most: float
) -> None:
    contact = Contact(1.5, 60.0, pitch=-0.08, lift=lift, nose_wheel_down=True)
    history = simulate_landing(aircraft, contact, SHORT)
    carried = -history.gears[2].ground_force[0, 2] / (aircraft.total_mass * GRAVITY)
    # Its leg swings back a little under the load, and is then less deep.
    assert carried == pytest.approx(most, rel=0.05, abs=1e-4)
    assert not history.gears[0].tyre_deflection[0] > 0.0
