"""One landing near the limit judged with more and more of the truth: what would have told it.

Rows by name; those that only one recorder has end with its name, the others hold for the first.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from solver.assimilation.assimilate import Assimilation
from solver.assimilation.parameters import perturbed_aircraft
from solver.errors import SolverError
from solver.landing.aircraft import LandingAircraft
from verification.judging.flight import FlownLanding
from verification.judging.reading import Reading
from verification.judging.true_parts import Belief, Part, with_truth
from verification.judging.use_of_limits import UseOfLimits

#: True use of a limit of the landings that count: far from the limit any method tells them.
NEAR = (0.7, 1.5)

#: Use of a limit below which an answer need not be exact: it is far from calling a landing hard.
_LEAST = 0.5

SMOOTHED, ASSIMILATED = "state by the smoother", "state after assimilation"
LEARNED = "state and gears after assimilation"
TRUE_STATE = "true state, aircraft as defined"
TRUE_LANDING = "true state, all of these"
ALL = "all of these"


def is_near_limit(utilisation: float) -> bool:
    """Whether a landing counts, by its true use of a limit."""
    return NEAR[0] <= utilisation <= NEAR[1]


def alone(part: Part) -> str:
    """Row of a part of the truth by itself."""
    return f"and {part} alone"


def together(part: Part) -> str:
    """Row of a part of the truth and all parts before it."""
    return ALL if part is list(Part)[-1] else f"and {part} too"


def uses_by_knowledge(
    use: UseOfLimits, flown: FlownLanding, readings: Mapping[str, tuple[Reading, Assimilation]]
) -> dict[str, float]:
    """Use of a limit by name of what is known; rows that cannot be simulated are left out.

    Parameters
    ----------
    use : UseOfLimits
    flown : FlownLanding
    readings : mapping
        Name of a recorder to what its window shows, before and after assimilation; parts of the
        truth go to the first.
    """
    found = {}
    for name, belief in _beliefs(flown, readings):
        try:
            found[name] = use(belief.aircraft, belief.fills, belief.contacts, _LEAST)
        except SolverError:
            continue
    return found


def _beliefs(
    flown: FlownLanding, readings: Mapping[str, tuple[Reading, Assimilation]]
) -> Iterator[tuple[str, Belief]]:
    for place, (recorder, (reading, updated)) in enumerate(readings.items()):
        smoothed = Belief(reading.aircraft, reading.loading.factors, reading.contacts)
        assimilated = replace(smoothed, contacts=updated.contacts)
        yield f"{SMOOTHED}, {recorder}", smoothed
        yield f"{ASSIMILATED}, {recorder}", assimilated
        learned = replace(assimilated, aircraft=_learned(reading, updated))
        yield f"{LEARNED}, {recorder}", learned
        yield f"{ALL}, {recorder}", with_truth(assimilated, flown, tuple(Part))
        if place == 0:
            yield from _with_parts(assimilated, flown)
            contact = replace(
                flown.contact,
                lift=replace(smoothed.contacts[0].lift, fraction=flown.contact.lift.fraction),
            )
            true = replace(smoothed, contacts=(contact,))
            yield TRUE_STATE, true
            yield TRUE_LANDING, with_truth(true, flown, tuple(Part))


def _learned(reading: Reading, updated: Assimilation) -> LandingAircraft:
    """Aircraft whose gears are as the recorded response tells them, in the recorded loading."""
    first = updated.updates[0]
    if first.corrected is None or not first.is_corrected:
        return reading.aircraft
    changes = {each.name: each.posterior for each in first.corrected.parameters}
    return perturbed_aircraft(reading.aircraft, changes | {"mass": 0.0, "centre_of_gravity": 0.0})


def _with_parts(belief: Belief, flown: FlownLanding) -> Iterator[tuple[str, Belief]]:
    parts = tuple(Part)
    for part in parts:
        yield alone(part), with_truth(belief, flown, (part,))
    # The first by itself is there already, all of them for every recorder.
    for count in range(2, len(parts)):
        yield together(parts[count - 1]), with_truth(belief, flown, parts[:count])
