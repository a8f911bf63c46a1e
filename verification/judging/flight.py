"""One drawn landing flown: what really happened to the structure, and what the recorder shows.

Truth is the landing of the aircraft as it really was (its gas pressures, orifices, tyres, friction,
lift course and loading), through the same simulation, reduced inertia relief and search for peaks
that an assessment uses.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import cycle

import numpy as np

from solver.arrays import Array
from solver.flight_data.approach import Approach, fly_in
from solver.flight_data.frame import RecorderFrame
from solver.flight_data.geometry import Installation, aircraft_geometry
from solver.flight_data.recorder import Surroundings, record
from solver.flight_data.window import Window
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.simulate import SimulationOptions, simulate_landing
from verification.judging.population import DrawnLanding
from verification.judging.service_scatter import scattered_aircraft, scattered_lift
from verification.judging.use_of_limits import UseOfLimits

#: For the recording: bounces and the nose are in it, the grid is fine enough for a shock.
_RECORDED = SimulationOptions(time_limit=6.0, stop_when_settled=False, output_interval=2e-3)

_DEGREE = np.deg2rad(1.0)


@dataclass(frozen=True, slots=True)
class FlownLanding:
    """A landing of which everything is known."""

    drawn: DrawnLanding
    contact: Contact  #: true state, true course of the lift
    aircraft: LandingAircraft  #: as it really was
    fills: Array  #: (n_groups,) true fill factors of tanks and bays
    utilisation: float  #: largest use of a limit, airframe or gear; above 1 the landing was hard
    windows: tuple[Window, ...]  #: one for each frame, all of the same motion and sensors


def fly(
    use: UseOfLimits,
    drawn: DrawnLanding,
    frames: Sequence[RecorderFrame],
    believed: Installation,
) -> FlownLanding:
    """Fly and record a landing; the sensors are not quite where they are believed to be."""
    rng = np.random.default_rng([drawn.seed, 0])
    airframe = use.model.airframe
    definition = airframe.definition
    fuel = {tank.name: drawn.fuel_fill * tank.capacity for tank in definition.tanks}
    payload = {
        bay.name: fill * bay.capacity
        for bay, fill in zip(definition.bays, cycle(drawn.payload_fill), strict=False)
    }
    fills = airframe.fill_factors(fuel, payload)
    scatter = definition.scatter
    contact = replace(drawn.contact, lift=scattered_lift(drawn.contact.lift, scatter, rng))
    aircraft = scattered_aircraft(airframe.landing_aircraft(fills), contact, scatter, rng)
    return FlownLanding(
        drawn=drawn,
        contact=contact,
        aircraft=aircraft,
        fills=fills,
        utilisation=use(aircraft, fills, (contact,)),
        windows=_recordings(aircraft, contact, frames, believed, rng, drawn.seed),
    )


def _recordings(
    aircraft: LandingAircraft,
    contact: Contact,
    frames: Sequence[RecorderFrame],
    believed: Installation,
    rng: np.random.Generator,
    seed: int,
) -> tuple[Window, ...]:
    approach = Approach(
        flare=float(rng.uniform(3.0, 7.0)),
        crab=float(rng.normal(0.0, 2.0) * _DEGREE),
        gust=float(rng.uniform(0.1, 0.4)),
        gust_bandwidth=float(rng.uniform(0.3, 1.0)),
        pitch_activity=float(rng.uniform(0.2, 0.6) * _DEGREE),
        roll_activity=float(rng.uniform(0.4, 1.5) * _DEGREE),
        deceleration=float(rng.uniform(0.3, 1.0)),
    )
    motion = fly_in(simulate_landing(aircraft, contact, _RECORDED), approach, rng)
    real = replace(
        believed,
        accelerometer=believed.accelerometer + rng.normal(0.0, believed.position_sd, 3),
        antenna=believed.antenna + rng.normal(0.0, believed.position_sd, 3),
    )
    surroundings = Surroundings(
        runway_slope=float(rng.normal(0.0, 0.004)),
        runway_heading=float(rng.uniform(0.0, 2 * np.pi)),
        headwind=float(rng.normal(4.0, 3.0)),
        mass=aircraft.total_mass,
    )
    geometry = aircraft_geometry(aircraft, real)
    return tuple(record(motion, frame, geometry, surroundings, seed) for frame in frames)
