"""Usual landings of an aircraft, to know how its reduced coordinates move.

They steer how stress is compressed (`solver.inertia_relief.compression`), never what it is.
"""

from itertools import product
from math import radians
from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Single
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

#: Sink rate [m/s] with drift and roll rate [deg, deg/s], pitch [deg], roll [deg]: all combined.
_SINK = ((1.0, 2.0, 1.0), (2.2, -3.0, 3.0), (3.4, 1.0, -2.0))
_PITCH = (-2.5, 1.0, 4.5, 8.0)
_ROLL = (0.0, 3.0)
#: Fill of every tank and bay, in turn.
_FILL = (0.1, 0.5, 0.9, 0.3, 0.7)
_GROUND_SPEED = 58.0  #: [m/s]
_DURATION = 1.0  #: [s]


def reference_motions(
    airframe: "Airframe", model: ReducedModel, progress: Progress = silent
) -> list[Single]:
    """Coordinates (m, nt) over each landing that can be simulated."""
    options = SimulationOptions(time_limit=_DURATION, stop_when_settled=False)
    cases = list(product(_SINK, _PITCH, _ROLL))
    motions = []
    for index, ((sink, drift, roll_rate), pitch, roll) in enumerate(cases):
        progress("reference landings", index / len(cases))
        factors = np.resize(np.roll(_FILL, index), model.group_count)
        contact = Contact(
            sink_rate=sink,
            ground_speed=_GROUND_SPEED,
            pitch=radians(pitch),
            roll=radians(roll if index % 2 else -roll),
            drift=radians(drift),
            roll_rate=radians(roll_rate),
        )
        try:
            history = simulate_landing(airframe.landing_aircraft(factors), contact, options)
        except SimulationDivergedError:  # beyond what this aircraft's gears take
            continue
        response = landing_response(assemble(model, factors), landing_loads(airframe, history))
        motions.append(response.coordinates)
    progress("reference landings", 1.0)
    return motions
