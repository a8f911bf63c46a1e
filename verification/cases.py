"""Landings of the example aircraft that chapters and benchmarks share."""

from dataclasses import dataclass
from math import radians

import numpy as np

from solver.aircraft.assessed_airframe import AssessedAirframe
from solver.arrays import Array
from solver.inertia_relief.loads import LandingLoads, landing_loads
from solver.landing.contact import Contact
from solver.landing.simulate import SimulationOptions, simulate_landing


@dataclass(frozen=True, slots=True)
class Case:
    """A landing at a loading that no mass state of the basis has."""

    name: str
    title: str
    contact: Contact
    fuel: tuple[float, ...]  #: fill of each tank
    payload: tuple[float, ...]  #: fill of each bay

    def factors(self, airframe: AssessedAirframe) -> Array:
        """Fill factors of tanks and bays, cycled over what the aircraft has."""
        tanks, bays = len(airframe.definition.tanks), len(airframe.definition.bays)
        return np.concatenate([np.resize(self.fuel, tanks), np.resize(self.payload, bays)])

    def loads(self, airframe: AssessedAirframe, duration: float) -> LandingLoads:
        """Simulate the landing and give the structure's loads up to ``duration`` [s]."""
        history = simulate_landing(
            airframe.landing_aircraft(self.factors(airframe)),
            self.contact,
            SimulationOptions(time_limit=max(duration, 1.0), stop_when_settled=False),
        )
        return landing_loads(airframe, history).until(duration)


CASES = (
    Case(
        "roll",
        "3 degrees of roll, 9.5 ft/s, unequal tanks",
        Contact(
            sink_rate=2.9,
            ground_speed=58.0,
            pitch=radians(4.0),
            roll=radians(3.0),
            drift=radians(2.0),
            roll_rate=radians(3.0),
        ),
        fuel=(0.42, 0.33),
        payload=(0.8, 0.15, 0.6),
    ),
    Case(
        "nose-first",
        "nose gear first, 8 ft/s, little fuel",
        Contact(
            sink_rate=2.4,
            ground_speed=64.0,
            pitch=radians(-2.5),
            roll=radians(-0.5),
            pitch_rate=radians(-1.0),
        ),
        fuel=(0.12,),
        payload=(0.3, 0.9, 0.2),
    ),
    Case(
        "level",
        "level, 10 ft/s, partial fuel",
        Contact(sink_rate=3.048, ground_speed=60.0, pitch=radians(2.0)),
        fuel=(0.71,),
        payload=(0.35, 0.1, 0.05),
    ),
    Case(
        "tail-down",
        "8 degrees of pitch, 8.5 ft/s, port wing low, nearly full tanks",
        Contact(
            sink_rate=2.6,
            ground_speed=52.0,
            pitch=radians(8.0),
            roll=radians(-1.5),
            drift=radians(-3.0),
            pitch_rate=radians(-2.0),
        ),
        fuel=(0.93, 0.88),
        payload=(0.05, 0.4, 0.9),
    ),
    # The settings of the basis were chosen without a look at this one.
    Case(
        "one-wheel",
        "5 degrees of roll, 7 ft/s, starboard tank nearly empty, baggage only",
        Contact(
            sink_rate=2.1,
            ground_speed=61.0,
            pitch=radians(3.0),
            roll=radians(5.0),
            drift=radians(-2.0),
            roll_rate=radians(-4.0),
        ),
        fuel=(0.63, 0.07),
        payload=(0.0, 0.05, 1.0),
    ),
)
