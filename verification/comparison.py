"""A figure of ours beside one found by other means, with the difference that is admissible."""

from dataclasses import dataclass
from math import isfinite


@dataclass(frozen=True, slots=True)
class Comparison:
    """One compared figure."""

    name: str
    found: float
    target: float
    tolerance: float  #: largest admissible `difference`
    unit: str  #: of ``found`` and ``target``
    source: str  #: where the target comes from: author and report, closed form, other code
    reason: str  #: why the tolerance is what it is
    #: What the difference is divided by; None stands for the target's size, 1 for no division.
    scale: float | None = None

    @property
    def difference(self) -> float:
        """Absolute difference of found and target, divided by the scale."""
        scale = abs(self.target) if self.scale is None else self.scale
        return abs(self.found - self.target) / scale

    @property
    def holds(self) -> bool:
        """Whether the difference is a number within the tolerance."""
        return isfinite(self.difference) and self.difference <= self.tolerance
