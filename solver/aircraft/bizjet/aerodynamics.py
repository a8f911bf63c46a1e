"""Damping and weathercock stability of the example aircraft from its planforms, by strip theory.

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


def _mean_quarter_chord(
    root: float, root_chord: float, tip: float, tip_chord: float
) -> tuple[float, float]:
    """Station of a trapezoid's mean quarter chord [m], and its share of the span."""
    share = (root_chord + 2 * tip_chord) / (3 * (root_chord + tip_chord))
    chord = root_chord + share * (tip_chord - root_chord)
    return root + share * (tip - root) + chord / 4, share


#: Tailplane: area [m2]; station of its mean quarter chord [m], share of the half span.
TAIL_AREA = dim.TAIL_HALF_SPAN * (dim.FIN_TIP_CHORD + dim.TAIL_TIP_CHORD)
TAIL_CENTRE = _mean_quarter_chord(
    dim.FIN_TIP_LEADING_EDGE, dim.FIN_TIP_CHORD, dim.TAIL_TIP_LEADING_EDGE, dim.TAIL_TIP_CHORD
)
#: Fin: height [m], area [m2]; station of its mean quarter chord [m], share of the height.
FIN_HEIGHT = dim.FIN_TIP_HEIGHT - dim.FIN_ROOT_HEIGHT
FIN_AREA = FIN_HEIGHT * (dim.FIN_ROOT_CHORD + dim.FIN_TIP_CHORD) / 2
FIN_CENTRE = _mean_quarter_chord(
    dim.FIN_ROOT_LEADING_EDGE, dim.FIN_ROOT_CHORD, dim.FIN_TIP_LEADING_EDGE, dim.FIN_TIP_CHORD
)


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


def fin_slope() -> float:
    """Lift slope of the fin [1/rad].

    The tailplane on its tip acts as an end plate, which doubles the effective height's square less
    the gap at the root: 1.5 is a common mean (DATCOM 5.3.1.1).
    """
    sweep = math.atan2(
        dim.FIN_TIP_LEADING_EDGE + dim.FIN_TIP_CHORD / 2
        - dim.FIN_ROOT_LEADING_EDGE - dim.FIN_ROOT_CHORD / 2,
        FIN_HEIGHT,
    )  # fmt: skip
    return lift_slope(1.5 * FIN_HEIGHT**2 / FIN_AREA, sweep)


def damping() -> Damping:
    """Damping derivatives about the reference centre of gravity."""
    y = np.linspace(0, dim.HALF_SPAN, 2001)
    chord = dim.wing_chord(y)
    area, span = dim.WING_AREA, dim.WING_SPAN
    root = dim.WING_APEX + dim.WING_ROOT_CHORD / 2
    tip = float(dim.wing_leading_edge(dim.HALF_SPAN)) + dim.WING_TIP_CHORD / 2
    wing_slope = lift_slope(span**2 / area, math.atan2(tip - root, dim.HALF_SPAN))
    roll = -4 * wing_slope / (area * span**2) * float(np.trapezoid(chord * y**2, y))

    tail_slope = lift_slope(
        (2 * dim.TAIL_HALF_SPAN) ** 2 / TAIL_AREA,
        math.atan2(
            dim.TAIL_TIP_LEADING_EDGE + dim.TAIL_TIP_CHORD / 2
            - dim.FIN_TIP_LEADING_EDGE - dim.FIN_TIP_CHORD / 2,
            dim.TAIL_HALF_SPAN,
        ),
    )  # fmt: skip
    lever = TAIL_CENTRE[0] - REFERENCE_CENTRE[0]
    pitch = -2 * TAIL_EFFICIENCY * tail_slope * TAIL_AREA * lever**2 / (area * dim.MEAN_CHORD**2)

    lever = FIN_CENTRE[0] - REFERENCE_CENTRE[0]
    yaw = -2 * TAIL_EFFICIENCY * fin_slope() * FIN_AREA * lever**2 / (area * span**2)
    return Damping(round(roll, 4), round(pitch, 3), round(yaw, 4))


def weathercock() -> float:
    """C_n_beta per rad about the reference centre of gravity: the fin's side force on its lever."""
    lever = FIN_CENTRE[0] - REFERENCE_CENTRE[0]
    side_force = TAIL_EFFICIENCY * fin_slope() * FIN_AREA
    return round(side_force * lever / (dim.WING_AREA * dim.WING_SPAN), 4)
