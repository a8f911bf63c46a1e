"""What a landing used of its limits, part by part: the smooth quantities behind its verdict.

The largest utilisation of all has a kink wherever another part takes over, and hardly anything can
be interpolated through those.  That of one zone, or of one gear, is far smoother.
"""

from dataclasses import dataclass

import numpy as np

from solver.aircraft.definition import AircraftDefinition
from solver.arrays import Array, IntArray
from solver.assessment import Assessment


@dataclass(frozen=True, slots=True)
class Outcome:
    """Shares of the limits that the verdict grades, and of the stops that it only looks at."""

    utilisations: Array  #: (n_zones + n_gears,) peak over limit
    stops: Array  #: (2 n_gears,) stroke over full stroke, tyre deflection over bottoming


def outcome(
    definition: AircraftDefinition, element_zone: IntArray, assessment: Assessment
) -> Outcome:
    """Outcome of an assessment of one contact, in the order of the definition.

    Parameters
    ----------
    definition : AircraftDefinition
        Names zones and gears.
    element_zone : (ne,) array
        Zone of each element.
    assessment : Assessment
        With its peak field.
    """
    field = assessment.peak_field
    if field is None:
        raise ValueError("an assessment without contacts has no outcome")
    zones = np.zeros(len(definition.zones))
    np.maximum.at(zones, element_zone, field.utilisation)
    tyres = {gear.name: gear.tyre.bottoming_deflection for gear in definition.gears}
    loads = assessment.gear_loads
    return Outcome(
        utilisations=np.concatenate([zones, [load.utilisation for load in loads]]),
        stops=np.array(
            [load.stroke_utilisation for load in loads]
            + [load.tyre_deflection / tyres[load.gear] for load in loads]
        ),
    )
