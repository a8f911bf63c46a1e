"""Many landings at once, over all cores.

Threads, because the integration and the products that follow run outside the interpreter's lock:
nothing has to be sent anywhere.  Every landing is the single form's, to the last bit.
"""

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from solver.errors import SimulationDivergedError
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.history import LandingHistory
from solver.landing.sequence import Passage
from solver.landing.simulate import SimulationOptions

Kept = TypeVar("Kept")


def available_cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def simulate_landings(
    landings: Sequence[tuple[LandingAircraft, Contact]],
    keep: Callable[[int, LandingHistory], Kept],
    options: SimulationOptions | None = None,
    threads: int | None = None,
    passages: Sequence[Passage] | None = None,
) -> list[Kept | SimulationDivergedError]:
    """Simulate landings and keep of each what ``keep`` makes of it, in their order.

    Parameters
    ----------
    landings : sequence of (LandingAircraft, Contact)
    keep : callable
        Takes a landing's place and its history, in the thread that simulated it: the histories of
        thousands of landings would not fit into memory.
    options : SimulationOptions, optional
    threads : int, optional
        All available cores by default.
    passages : sequence of Passage, optional
        Of each landing, where it goes on from an earlier contact or ends at a later one.

    Returns
    -------
    list
        What ``keep`` returned, or the error of a landing whose motion diverged.

    Raises
    ------
    RecordError
        A contact or its lift is outside what a landing can be.
    """
    parts = passages or [Passage()] * len(landings)

    def one(place: int) -> Kept | SimulationDivergedError:
        try:
            history = parts[place].simulate(*landings[place], options)
        except SimulationDivergedError as error:
            return error
        return keep(place, history)

    count = min(threads or available_cores(), len(landings))
    if count <= 1:
        return [one(place) for place in range(len(landings))]
    with ThreadPoolExecutor(count) as pool:
        return list(pool.map(one, range(len(landings))))
