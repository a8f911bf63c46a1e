"""How much an aircraft differs from its definition at a landing that nobody measured.

Standard deviations, relative ones as shares of the defined value.  The defaults of the definition
file are assumed, of the size of servicing tolerances and of what tyres and runways vary by; an
operator with records of his own should state his.
"""

from dataclasses import dataclass
from enum import StrEnum
from statistics import NormalDist


class AllowableBasis(StrEnum):
    """What the stated allowables are, as a quantile of the strength's distribution.

    A- and B-basis values are exceeded by 99 % and 90 % of specimens (MMPDS, chapter 9; the 95 %
    confidence that belongs to them is left out, which puts the strength a little too low).
    """

    LIMIT = "limit"  #: the limit itself: the question is whether this stress is exceeded
    A = "A"
    B = "B"

    @property
    def deviations_below_mean(self) -> float:
        """Standard deviations from the stated value up to the mean strength."""
        return {"limit": 0.0, "A": NormalDist().inv_cdf(0.99), "B": NormalDist().inv_cdf(0.90)}[
            self.value
        ]


@dataclass(frozen=True, slots=True)
class Scatter:
    """Standard deviations of what no record tells."""

    gas_pressure: float  #: relative, of every strut on its own
    strut_damping: float  #: relative, orifices and seal friction, of every strut on its own
    tyre_stiffness: float  #: relative, of every gear's tyres on their own
    tyre_friction: float  #: relative, of all tyres together: it is the runway's
    lift_decay_start: float  #: [s]
    lift_decay_time: float  #: relative
    residual_lift_fraction: float  #: of the weight
    structural_damping: float  #: relative
    allowable: float  #: relative, of every zone on its own
    allowable_basis: AllowableBasis
