"""Usual landings of an aircraft, to know how its reduced coordinates move.

They decide which directions of the basis are kept and how stress is compressed
(`solver.inertia_relief.compression`).  They fill the range of touchdowns and loadings evenly: what
no landing like it has moved would be missing when one comes.

Source: Halton, "On the efficiency of certain quasi-random sequences of points in evaluating
multi-dimensional integrals", Numer. Math. 2 (1960).
"""

from math import radians
from typing import TYPE_CHECKING

from scipy.stats import qmc

from solver.arrays import Array, Single
from solver.errors import SimulationDivergedError
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import landing_loads
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.response import landing_response
from solver.landing.contact import Contact
from solver.landing.simulate import SimulationOptions, simulate_landing
from solver.progress import Progress, silent

if TYPE_CHECKING:
    from solver.aircraft.airframe import Airframe

#: Touchdowns; those that an aircraft's gears cannot take are left out.
COUNT = 72
#: Smallest and largest sink rate and ground speed [m/s], pitch, roll, drift [deg], and rates of
#: pitch, roll, yaw [deg/s].
RANGES = (
    (0.4, 3.6), (48.0, 72.0), (-3.0, 9.0), (-5.0, 5.0), (-6.0, 6.0), (-4.0, 4.0), (-15.0, 15.0),
    (-3.0, 3.0),
)  # fmt: skip
_DURATION = 1.0  #: [s]


def reference_contacts(groups: int, count: int = COUNT) -> list[tuple[Contact, Array]]:
    """Touchdowns, each with the fill of every one of ``groups`` tanks and bays."""
    sequence = qmc.Halton(len(RANGES) + groups, scramble=False)
    sequence.fast_forward(1)  # the first point is a corner
    contacts = []
    for point in sequence.random(count):
        sink_rate, ground_speed, *angles = (
            low + share * (high - low) for share, (low, high) in zip(point, RANGES, strict=False)
        )
        pitch, roll, drift, pitch_rate, roll_rate, yaw_rate = map(radians, angles)
        contact = Contact(
            sink_rate=sink_rate,
            ground_speed=ground_speed,
            pitch=pitch,
            roll=roll,
            drift=drift,
            pitch_rate=pitch_rate,
            roll_rate=roll_rate,
            yaw_rate=yaw_rate,
        )
        contacts.append((contact, point[len(RANGES) :]))
    return contacts


def reference_motions(
    airframe: "Airframe", model: ReducedModel, progress: Progress = silent
) -> list[Single]:
    """Coordinates (m, nt) over each landing that can be simulated."""
    options = SimulationOptions(time_limit=_DURATION, stop_when_settled=False)
    contacts = reference_contacts(model.group_count)
    motions = []
    for index, (contact, factors) in enumerate(contacts):
        progress("reference landings", index / len(contacts))
        try:
            history = simulate_landing(airframe.landing_aircraft(factors), contact, options)
        except SimulationDivergedError:  # beyond what this aircraft's gears take
            continue
        response = landing_response(assemble(model, factors), landing_loads(airframe, history))
        motions.append(response.coordinates)
    progress("reference landings", 1.0)
    return motions
