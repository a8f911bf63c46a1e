"""Synthetic landings with their recordings: truth from the landing simulation, drawn by a seed."""

from dataclasses import dataclass, replace

import numpy as np

from solver.arrays import Array
from solver.flight_data.approach import Approach, fly_in
from solver.flight_data.frame import RecorderFrame
from solver.flight_data.geometry import Geometry
from solver.flight_data.motion import Motion, velocity_at
from solver.flight_data.recorder import Surroundings, record
from solver.flight_data.window import Window
from solver.gear.place import Place
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift
from solver.landing.history import LandingHistory
from solver.landing.simulate import SimulationOptions, simulate_landing

#: Long enough for bounces and the nose to come down; grid fine enough for a shock.
_OPTIONS = SimulationOptions(time_limit=6.0, stop_when_settled=False, output_interval=2e-3)

#: How far the sensors really sit from where they are believed to be [m].
_SENSOR_SD = 0.1


@dataclass(frozen=True, slots=True)
class SyntheticLanding:
    """A landing of which everything is known."""

    contact: Contact  #: state at the first contact, which is at time 0
    history: LandingHistory
    motion: Motion
    window: Window

    def gear_sink_rate(self, point: Array) -> float:
        """Vertical speed of a point of the aircraft at the first contact, downward [m/s]."""
        first = int(np.argmin(np.abs(self.motion.time)))
        return float(velocity_at(self.motion, point)[first, 2])

    def main_contacts(self, geometry: Geometry) -> tuple[float, ...]:
        """List when the main wheels come down after all of them were off the ground [s]."""
        noses = {wheel.gear for wheel in geometry.of(Place.NOSE)}
        times: list[float] = []
        until = -np.inf
        for stay in self.history.contacts:
            if stay.gear in noses:
                continue
            if stay.start > until:
                times.append(stay.start)
            until = max(until, np.inf if stay.end is None else stay.end)
        return tuple(times)

    def main_gears_again(self, geometry: Geometry) -> tuple[float, ...]:
        """List when any main gear comes down again, whether others had stayed down or not [s]."""
        times: list[float] = []
        for wheel in geometry.mains:
            stays = [c.start for c in self.history.contacts if c.gear == wheel.gear]
            times += sorted(stays)[1:]
        return tuple(sorted(times))

    def nose_contact(self, geometry: Geometry) -> float | None:
        """Time of the first contact of the nose wheel [s]."""
        noses = {wheel.gear for wheel in geometry.of(Place.NOSE)}
        return min((c.start for c in self.history.contacts if c.gear in noses), default=None)


def synthetic_landing(
    aircraft: LandingAircraft, geometry: Geometry, frame: RecorderFrame, seed: int
) -> SyntheticLanding:
    """Draw a landing, simulate it and record it.

    The spread is that of service with a generous share of firm landings: sink rates from a gamma
    distribution of mean 1.1 m/s between 0.2 and 3.6 m/s, some degrees of roll, pitch, drift and
    crab, gusts, runway slope, and sensors that are not quite where they are believed to be.
    """
    rng = np.random.default_rng(seed)
    degree = np.deg2rad(1.0)
    contact = Contact(
        sink_rate=float(np.clip(rng.gamma(2.5, 0.45), 0.2, 3.6)),
        ground_speed=float(rng.normal(60.0, 4.0)),
        pitch=float(rng.normal(5.0, 1.2) * degree),
        roll=float(rng.normal(0.0, 1.5) * degree),
        drift=float(rng.normal(0.0, 2.0) * degree),
        pitch_rate=float(rng.normal(0.0, 1.0) * degree),
        roll_rate=float(rng.normal(0.0, 1.5) * degree),
        yaw_rate=float(rng.normal(0.0, 0.8) * degree),
        lift=Lift(fraction=float(rng.normal(1.0, 0.05))),
    )
    history = simulate_landing(aircraft, contact, _OPTIONS)
    approach = Approach(
        flare=float(rng.uniform(3.0, 7.0)),
        crab=float(rng.normal(0.0, 2.0) * degree),
        gust=float(rng.uniform(0.1, 0.4)),
        gust_bandwidth=float(rng.uniform(0.3, 1.0)),
        pitch_activity=float(rng.uniform(0.2, 0.6) * degree),
        roll_activity=float(rng.uniform(0.4, 1.5) * degree),
        deceleration=float(rng.uniform(0.3, 1.0)),
    )
    motion = fly_in(history, approach, rng)
    believed = geometry.installation
    real = replace(
        believed,
        accelerometer=believed.accelerometer + rng.normal(0.0, _SENSOR_SD, 3),
        antenna=believed.antenna + rng.normal(0.0, _SENSOR_SD, 3),
    )
    surroundings = Surroundings(
        runway_slope=float(rng.normal(0.0, 0.004)),
        runway_heading=float(rng.uniform(0.0, 2 * np.pi)),
        headwind=float(rng.normal(4.0, 3.0)),
        mass=aircraft.total_mass,
    )
    window = record(motion, frame, replace(geometry, installation=real), surroundings, seed)
    return SyntheticLanding(contact, history, motion, window)
