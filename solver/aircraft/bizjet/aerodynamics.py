"""Damping of the example aircraft from its planforms, by strip theory.

Each strip of a surface sees the change of incidence that the rotation gives it and answers with
the surface's lift slope; downwash lag, fuselage and nacelles are left out.
Source: Etkin and Reid, Dynamics of Flight (1996), chapter 5; lift slope from Helmbold's formula
with sweep (DATCOM 4.1.3.2, low speed).
"""

import math
from dataclasses import dataclass

import numpy as np

from solver.aircraft.bizjet import dimensions as dim
from solver.aircraft.bizjet.loading import REFERENCE_CENTRE

#: Dynamic pressure at the tailplane and fin over that of the free stream; assumed.
TAIL_EFFICIENCY = 0.95


@dataclass(frozen=True, slots=True)
class Damping:
    """C_lp per p b / (2 V), C_mq per q c / (2 V), C_nr per r b / (2 V), all per rad."""

    roll: float
    pitch: float
    yaw: float


def lift_slope(aspect_ratio: float, half_chord_sweep: float) -> float:
    """Lift slope of a finite wing in incompressible flow [1/rad]."""
    sweep = math.tan(half_chord_sweep)
    return 2 * math.pi * aspect_ratio / (2 + math.sqrt(4 + aspect_ratio**2 * (1 + sweep**2)))


def damping() -> Damping:
    """Damping derivatives about the reference centre of gravity."""
    y = np.linspace(0, dim.HALF_SPAN, 2001)
    chord = dim.wing_chord(y)
    area, span = dim.WING_AREA, dim.WING_SPAN
    root = dim.WING_APEX + dim.WING_ROOT_CHORD / 2
    tip = float(dim.wing_leading_edge(dim.HALF_SPAN)) + dim.WING_TIP_CHORD / 2
    wing_slope = lift_slope(span**2 / area, math.atan2(tip - root, dim.HALF_SPAN))
    roll = -4 * wing_slope / (area * span**2) * float(np.trapezoid(chord * y**2, y))

    tail_area = dim.TAIL_HALF_SPAN * (dim.FIN_TIP_CHORD + dim.TAIL_TIP_CHORD)
    tail_slope = lift_slope(
        (2 * dim.TAIL_HALF_SPAN) ** 2 / tail_area,
        math.atan2(
            dim.TAIL_TIP_LEADING_EDGE + dim.TAIL_TIP_CHORD / 2
            - dim.FIN_TIP_LEADING_EDGE - dim.FIN_TIP_CHORD / 2,
            dim.TAIL_HALF_SPAN,
        ),
    )  # fmt: skip
    lever = _quarter_chord(
        dim.FIN_TIP_LEADING_EDGE, dim.FIN_TIP_CHORD, dim.TAIL_TIP_LEADING_EDGE, dim.TAIL_TIP_CHORD
    )
    pitch = -2 * TAIL_EFFICIENCY * tail_slope * tail_area * lever**2 / (area * dim.MEAN_CHORD**2)

    height = dim.FIN_TIP_HEIGHT - dim.FIN_ROOT_HEIGHT
    fin_area = height * (dim.FIN_ROOT_CHORD + dim.FIN_TIP_CHORD) / 2
    fin_slope = lift_slope(
        # The tailplane on its tip acts as an end plate, which doubles the effective height's
        # square less the gap at the root: 1.5 is a common mean (DATCOM 5.3.1.1).
        1.5 * height**2 / fin_area,
        math.atan2(
            dim.FIN_TIP_LEADING_EDGE + dim.FIN_TIP_CHORD / 2
            - dim.FIN_ROOT_LEADING_EDGE - dim.FIN_ROOT_CHORD / 2,
            height,
        ),
    )  # fmt: skip
    lever = _quarter_chord(
        dim.FIN_ROOT_LEADING_EDGE, dim.FIN_ROOT_CHORD, dim.FIN_TIP_LEADING_EDGE, dim.FIN_TIP_CHORD
    )
    yaw = -2 * TAIL_EFFICIENCY * fin_slope * fin_area * lever**2 / (area * span**2)
    return Damping(round(roll, 4), round(pitch, 3), round(yaw, 4))


def _quarter_chord(root: float, root_chord: float, tip: float, tip_chord: float) -> float:
    """Distance aft of the centre of gravity of a surface's mean quarter chord [m]."""
    share = (root_chord + 2 * tip_chord) / (3 * (root_chord + tip_chord))
    chord = root_chord + share * (tip_chord - root_chord)
    return root + share * (tip - root) + chord / 4 - REFERENCE_CENTRE[0]
