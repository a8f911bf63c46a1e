"""The landings that the three analyses follow, and the instants they are compared at."""

from dataclasses import dataclass, replace
from math import radians

import numpy as np

from solver.aircraft.airframe import Airframe
from solver.arrays import Array, IntArray
from solver.inertia_relief.loads import LandingLoads, landing_loads
from solver.landing.contact import Contact, Lift, LiftModel
from solver.landing.history import LandingHistory
from solver.landing.simulate import SimulationOptions, simulate_landing
from verification.cases import CASES, Case

#: Table 1 of Lee et al., port wing down so that the left gear touches first as in Fig. 28.  The
#: paper states no lift; two thirds of the weight is what 14 CFR 23.725 lets a drop test assume.
PAPER = Case(
    "paper",
    "Table 1: 3 degrees of roll and pitch, 0.5 m/s",
    Contact(
        sink_rate=0.5,
        ground_speed=50.0,
        pitch=radians(3.0),
        roll=radians(-3.0),
        lift=Lift(LiftModel.HELD, fraction=2.0 / 3.0),
    ),
    fuel=(0.5,),
    payload=(0.5,),
)

#: 10 ft/s, the limit sink speed of 14 CFR 25.473.
HARD = replace(
    CASES[0],
    name="hard",
    title="hard: 10 ft/s, 3 degrees of roll",
    contact=replace(CASES[0].contact, sink_rate=3.048),
)

NOSE_FIRST = CASES[1]

#: Instants of Table 2 [s].
INSTANTS = (0.25, 0.50, 0.75, 0.99)


@dataclass(frozen=True, slots=True)
class GearPeak:
    """Largest vertical load of one gear from the ground within the part that is followed."""

    gear: str
    sample: int
    force: float  #: [N]


@dataclass(frozen=True, slots=True)
class Landed:
    """A simulated landing and the samples at which fields are compared."""

    case: Case
    factors: Array  #: fill of tanks and bays
    history: LandingHistory  #: may go on after the part that is followed
    loads: LandingLoads  #: of the part that is followed
    instants: IntArray  #: samples of the table
    peaks: tuple[GearPeak, ...]  #: of the gears that touch down, in the order of their peaks

    @property
    def wanted(self) -> IntArray:
        """Samples whose fields are kept: the instants of the table, then the gears' peaks."""
        peaks = np.array([peak.sample for peak in self.peaks], dtype=np.int64)
        return np.concatenate([self.instants, peaks])

    def field(self, peak: GearPeak) -> int:
        """Row of a gear's peak in the kept fields."""
        return len(self.instants) + self.peaks.index(peak)


def landed(airframe: Airframe, case: Case, duration: float) -> Landed:
    """Simulate a landing and choose the samples to compare.

    Parameters
    ----------
    duration : float
        Followed part [s]; the instants of the table are the same shares of it as of a second.
    """
    factors = case.factors(airframe)
    history = simulate_landing(
        airframe.landing_aircraft(factors),
        case.contact,
        SimulationOptions(time_limit=max(duration, 0.1), stop_when_settled=False),
    )
    loads = landing_loads(airframe, history).until(duration)
    count = len(loads.time)
    instants = np.array([np.abs(loads.time - share * duration).argmin() for share in INSTANTS])
    peaks = []
    for gear in history.gears:
        upward = -gear.ground_force[:count, 2]
        if upward.max() > 0:
            peaks.append(GearPeak(gear.name, int(upward.argmax()), float(upward.max())))
    peaks.sort(key=lambda peak: peak.sample)
    return Landed(case, factors, history, loads, instants, tuple(peaks))
