"""Directional stability in the air and on the wheels."""

from dataclasses import replace

import numpy as np
import pytest

from solver.arrays import Array
from solver.frames import euler_from_quaternion
from solver.landing.aircraft import Aerodynamics, LandingAircraft
from solver.landing.contact import Contact
from solver.landing.initial import initial_state
from solver.landing.simulate import SimulationOptions, simulate_landing
from tests.solver.landing.business_jet import business_jet, rigid_legged
from tests.solver.landing.free_flight import fly, records

#: C_n_beta S b of a jet of 47.9 m2 and 19.3 m with 0.1 per rad [m3].
STIFFNESS = 0.1 * 47.9 * 19.3
SPEED = 60.0


def yaw_inertia(aircraft: LandingAircraft) -> float:
    """About the whole aircraft's centre of gravity, struts extended [kg m2]."""
    centre = aircraft.total_centre_of_gravity
    _, gears = records(aircraft)

    def squared(point: Array) -> float:
        return float(np.sum((point - centre)[:2] ** 2))

    total = aircraft.inertia[2, 2] + aircraft.mass * squared(aircraft.centre_of_gravity)
    for gear, record in zip(aircraft.gears, gears, strict=True):
        total += gear.unsprung_mass * squared(gear.extended_axle) + record["transverse_inertia"]
    return float(total)


def test_an_aircraft_in_the_wind_swings_as_a_pendulum() -> None:
    """No weight, no ground: I psi'' = -rho V^2 / 2 C_n_beta S b psi for small angles."""
    aircraft = replace(rigid_legged(), aerodynamics=Aerodynamics(yaw_stiffness=STIFFNESS))
    airframe, gears = records(aircraft, gravity=0.0)
    first = np.deg2rad(1.0)
    state = initial_state(
        Contact(0.0, SPEED, drift=first), airframe, gears, np.array([0.0, np.inf, 1.0, 0.0])
    )
    state[2] = -100.0
    flight = fly(airframe, gears, state, 2.0)
    stiffness = 0.5 * airframe["air_density"] * SPEED**2 * STIFFNESS
    frequency = np.sqrt(stiffness / yaw_inertia(aircraft))
    yaw = euler_from_quaternion(flight.states[:, 3:7])[2]
    assert yaw == pytest.approx(first * np.cos(frequency * flight.time), abs=1e-3 * first)


def test_the_roll_out_swings_out_with_a_fin_and_diverges_without() -> None:
    """Two degrees of drift at a soft touchdown, nobody steering."""
    plain = business_jet()
    finned = replace(plain, aerodynamics=replace(plain.aerodynamics, yaw_stiffness=STIFFNESS))
    options = SimulationOptions(time_limit=8.0, stop_when_settled=False, output_interval=4e-3)
    contact = Contact(1.0, 65.0, pitch=np.deg2rad(4.0), drift=np.deg2rad(2.0))
    rates = {}
    for name, aircraft in (("plain", plain), ("finned", finned)):
        history = simulate_landing(aircraft, contact, options)
        assert history.energy.closure_error < 1e-4
        rate = np.abs(history.rate[:, 2])
        rates[name] = (rate[history.time > 7.0].max(), rate[np.abs(history.time - 4.0) < 0.5].max())
    late, earlier = rates["plain"]
    assert late > 1.5 * earlier
    late, earlier = rates["finned"]
    assert late < 0.7 * earlier
