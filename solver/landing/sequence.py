"""Contacts of one landing in turn: each takes over what the one before left.

A contact's own record tells better how it began than the simulation of the one before, which
therefore ends there.  What no record tells is how fast the wheels turn: as fast as they did when
they left the ground.  Nothing that the simulation knows slows them in the air, and bearings hardly
do within the seconds of a hop.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from solver.arrays import Array
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.history import LandingHistory
from solver.landing.simulate import SimulationOptions, simulate_landing

#: Contacts closer than this are wheels of one touchdown: the load of the first has its peak within
#: it, and it is followed on [s].
SHORTEST = 0.3


@dataclass(frozen=True, slots=True)
class Passage:
    """Where one contact of a landing takes over, and where the next one does."""

    wheel_speeds: Array | None = None  #: (n_gears,) at its beginning, None: at rest [rad/s]
    duration: float = math.inf  #: until the next contact [s]

    def simulate(
        self, aircraft: LandingAircraft, contact: Contact, options: SimulationOptions | None = None
    ) -> LandingHistory:
        """Simulate the contact as `simulate_landing` does, no further than to the next one."""
        options = options or SimulationOptions()
        if self.duration < options.time_limit:
            options = replace(options, time_limit=self.duration)
        return simulate_landing(aircraft, contact, options, self.wheel_speeds)


def simulate_contacts(
    aircraft: LandingAircraft,
    contacts: Sequence[Contact],
    options: SimulationOptions | None = None,
) -> Iterator[LandingHistory]:
    """Simulate the contacts of one landing, one after the other as they are asked for.

    Parameters
    ----------
    aircraft : LandingAircraft
    contacts : sequence of Contact
        In order.  Those whose times do not rise have none; they are followed to the usual end.
    options : SimulationOptions, optional

    Raises
    ------
    RecordError, SimulationDivergedError
        As `simulate_landing`.
    """
    before: LandingHistory | None = None
    for number, contact in enumerate(contacts):
        before = passage(contacts, number, before).simulate(aircraft, contact, options)
        yield before


def passage(contacts: Sequence[Contact], number: int, before: LandingHistory | None) -> Passage:
    """Passage of one contact of a landing.

    Parameters
    ----------
    contacts : sequence of Contact
    number : int
        Its place.
    before : LandingHistory, optional
        Of the contact before it, None for the first.
    """
    speeds = None
    if before is not None:
        hop = contacts[number].time - contacts[number - 1].time
        # Without times the wheels are left as the one before left them.
        at = np.searchsorted(before.time, hop) if hop > 0.0 else len(before.time)
        speeds = np.array([gear.wheel_speed[: at + 1][-1] for gear in before.gears])
    return Passage(speeds, until_next(contacts, number))


def until_next(contacts: Sequence[Contact], number: int) -> float:
    """Time from a contact to the next one [s]; infinite for the last, and for one too close."""
    if number + 1 == len(contacts):
        return math.inf
    duration = contacts[number + 1].time - contacts[number].time
    return duration if duration >= SHORTEST else math.inf
