"""Synthetic landings of an aircraft that is not quite the one the estimator believes in.

Gas pressures, orifices, tyres, mass, centre of gravity and the lift's decay are drawn from the
scatter of service: the recording comes from that aircraft, and the estimator is given the nominal
one.
"""

from dataclasses import dataclass, replace

import numpy as np

from solver.assimilation.parameters import (
    ServiceScatter,
    perturbed_aircraft,
    perturbed_lift,
    service_parameters,
)
from solver.flight_data.approach import Approach, fly_in
from solver.flight_data.fleet import SyntheticLanding, synthetic_landing
from solver.flight_data.frame import RecorderFrame
from solver.flight_data.geometry import Geometry
from solver.flight_data.recorder import Surroundings, record
from solver.landing.aircraft import LandingAircraft
from solver.landing.simulate import SimulationOptions, simulate_landing

#: As `solver.flight_data.fleet`: bounces and the nose wheel are in it.
_OPTIONS = SimulationOptions(time_limit=6.0, stop_when_settled=False, output_interval=2e-3)


@dataclass(frozen=True, slots=True)
class ScatteredLanding:
    """A landing with its recording, and what was different from the nominal aircraft."""

    landing: SyntheticLanding
    aircraft: LandingAircraft  #: that really landed
    changes: dict[str, float]  #: of `service_parameters`


def scattered_landing(
    aircraft: LandingAircraft,
    geometry: Geometry,
    frame: RecorderFrame,
    seed: int,
    scatter: ServiceScatter | None = None,
    defects: dict[str, float] | None = None,
) -> ScatteredLanding:
    """Draw a landing of an aircraft out of service and record it.

    Parameters
    ----------
    aircraft, geometry
        As believed.
    frame : RecorderFrame
    seed : int
        State of the contact, sensors and recorder errors are drawn as by `synthetic_landing`.
    scatter : ServiceScatter, optional
    defects : dict, optional
        Added to the changes drawn, by name.
    """
    contact = synthetic_landing(aircraft, geometry, frame, seed).contact
    rng = np.random.default_rng([seed, 1])
    parameters = service_parameters(
        aircraft, scatter or ServiceScatter(), geometry.centre_of_gravity_sd
    )
    changes = {
        name: float(sd * rng.standard_normal()) + (defects or {}).get(name, 0.0)
        for name, sd in parameters.items()
    }
    real = perturbed_aircraft(aircraft, changes)
    contact = replace(contact, lift=perturbed_lift(contact.lift, changes))
    history = simulate_landing(real, contact, _OPTIONS)
    degree = np.deg2rad(1.0)
    approach = Approach(
        flare=float(rng.uniform(3.0, 7.0)),
        crab=float(rng.normal(0.0, 2.0) * degree),
        gust=float(rng.uniform(0.1, 0.4)),
        gust_bandwidth=float(rng.uniform(0.3, 1.0)),
        deceleration=float(rng.uniform(0.3, 1.0)),
    )
    motion = fly_in(history, approach, rng)
    place = geometry.installation
    sensors = replace(
        place,
        accelerometer=place.accelerometer + rng.normal(0.0, place.position_sd, 3),
        antenna=place.antenna + rng.normal(0.0, place.position_sd, 3),
    )
    surroundings = Surroundings(
        runway_slope=float(rng.normal(0.0, 0.004)),
        runway_heading=float(rng.uniform(0.0, 2 * np.pi)),
        headwind=float(rng.normal(4.0, 3.0)),
        mass=aircraft.total_mass,
    )
    window = record(motion, frame, replace(geometry, installation=sensors), surroundings, seed)
    return ScatteredLanding(SyntheticLanding(contact, history, motion, window), real, changes)
