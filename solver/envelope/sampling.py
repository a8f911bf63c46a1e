"""Which landings an envelope is made of: rounds, each drawn to where the last one was unsure.

What matters is the neighbourhood of the verdict's thresholds.  The first round spreads over the
whole box; every later one takes its places in loading and attitude from the same low-discrepancy
sequence (Sobol 1967) and chooses its sink rates so that the surface so far expects utilisations
about the thresholds.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np
from scipy.stats import qmc

from solver.aircraft.assessed_airframe import AssessedAirframe
from solver.aircraft.definition import AircraftDefinition
from solver.arrays import Array
from solver.assess import AssessmentModel, assess_landing
from solver.assessment import TouchdownRecord
from solver.envelope.domain import (
    COORDINATES,
    SINK_RATE,
    Domain,
    coordinates_of,
    domain_of,
    landings_at,
    record_at,
)
from solver.envelope.envelope import rising
from solver.envelope.outcome import outcome
from solver.envelope.samples import Sample, held_out
from solver.envelope.surface import Surface, fit
from solver.errors import ModelError, RecordError, SimulationDivergedError
from solver.landing.contact import Lift

#: Landings of the first round; each later one is as large as all before it.
FIRST_ROUND = 120

#: Expected utilisations of the later rounds, evenly in their logarithm.
_TARGETS = (0.4, 1.15)

#: Sink rates tried for the hardest of an envelope: from, factor, to [m/s]; and what it must use.
_HARDEST = (1.0, 1.25, 12.0)
_FAR_BEYOND = 1.5

#: Stretches at the start of the search: sink rate, roll and lift matter most.
_FIRST_STRETCH = np.array([2.0, 1.2, 0.4, 0.4, 0.4, 1.5, 0.3, 0.25, 0.25, 0.25, 0.25, 0.15])

#: Solves numbered landings, given by their coordinates, and yields them in any order.
Solve = Callable[[Sequence[tuple[int, Array]]], Iterator[Sample]]


def solve_one(model: AssessmentModel, number: int, coordinates: Array) -> Sample:
    """Assess one landing; its coordinates become those that its loading really has."""
    airframe = model.airframe
    record = record_at(airframe.definition, coordinates)
    try:
        assessment = assess_landing(model, record)
    except (RecordError, SimulationDivergedError):
        return Sample(number, coordinates, np.empty(0), np.empty(0))
    loading = airframe.loading_for(
        record.mass, record.centre_of_gravity, record.fuel, record.payload
    )
    found = outcome(airframe.definition, airframe.element_zone, assessment)
    return Sample(
        number,
        coordinates_of(record.contacts[0], loading),
        found.utilisations,
        found.stops,
    )


def find_domain(model: AssessmentModel) -> Domain:
    """Box up to a sink rate that is far beyond the limits in the maximum landing mass.

    Raises
    ------
    ModelError
        That landing cannot be simulated.
    """
    airframe = model.airframe
    definition = airframe.definition
    sink_rate, factor, most = _HARDEST
    while True:
        domain = domain_of(definition, sink_rate)
        middle = record_at(definition, 0.5 * (domain.low + domain.high)).contacts[0]
        record = TouchdownRecord(
            definition.name,
            (replace(middle, sink_rate=sink_rate, roll=0.0, lift=Lift(fraction=1.0)),),
            mass=definition.masses.maximum_landing,
        )
        try:
            assessment = assess_landing(model, record)
        except (RecordError, SimulationDivergedError) as error:
            raise ModelError(
                f"a landing at {sink_rate:.2f} m/s in the maximum landing mass, of which the "
                f"envelope is to be made: {error}"
            ) from error
        used = outcome(definition, airframe.element_zone, assessment).utilisations.max()
        if used > _FAR_BEYOND or sink_rate * factor > most:
            return domain
        sink_rate *= factor


def next_landings(
    domain: Domain, definition: AircraftDefinition, first: int, count: int, surface: Surface | None
) -> Array:
    """Coordinates (count, 12) of the landings of a round, from number ``first`` on."""
    sequence = qmc.Sobol(len(COORDINATES), scramble=False)
    sequence.fast_forward(first + 1)  # its first point is a corner
    cube = sequence.random(count)
    landings = landings_at(domain, definition, cube)
    if surface is None:
        return landings
    low, high = np.log(_TARGETS)
    target = np.exp(low + cube[:, SINK_RATE] * (high - low))
    for row, wanted in zip(landings, target, strict=True):
        sink_rates, used, _ = rising(domain, surface, row)
        row[SINK_RATE] = np.interp(wanted, used, sink_rates)
    return landings


def fitted(domain: Domain, samples: Sequence[Sample], stretch: Array, sweeps: int) -> Surface:
    """Surface through the solved landings that are not held out."""
    solved = [s for s in samples if s.is_solved and not held_out([s.number])[0]]
    return fit(
        domain.unit(np.array([s.coordinates for s in solved])),
        np.array([s.utilisations for s in solved]),
        np.array([s.stops for s in solved]),
        stretch,
        sweeps,
    )


def sample_rounds(
    domain: Domain,
    airframe: AssessedAirframe,
    known: Sequence[Sample],
    count: int,
    solve: Solve,
) -> tuple[list[Sample], Surface]:
    """Solve ``count`` landings in rounds; what is ``known`` already is not solved again."""
    samples = {sample.number: sample for sample in known if sample.number < count}
    stretch = _FIRST_STRETCH
    done = 0
    while done < count:
        first, size = done, min(max(done, FIRST_ROUND), count - done)
        done += size
        missing = [k for k in range(first, first + size) if k not in samples]
        if not missing:
            continue
        surface = None
        if first > 0:
            surface = fitted(domain, [samples[k] for k in range(first)], stretch, sweeps=1)
            stretch = surface.stretch
        landings = next_landings(domain, airframe.definition, first, size, surface)
        asked = [(number, landings[number - first]) for number in missing]
        samples.update({sample.number: sample for sample in solve(asked)})
    ordered = [samples[number] for number in range(count)]
    return ordered, fitted(domain, ordered, stretch, sweeps=3)
