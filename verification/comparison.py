"""A figure of ours beside one found by other means, with the difference that is admissible."""

from dataclasses import dataclass
from math import inf, isfinite


@dataclass(frozen=True, slots=True)
class Comparison:
    """One compared figure."""

    name: str
    found: float
    target: float
    tolerance: float  #: largest admissible `difference`
    unit: str  #: of ``found`` and ``target``; empty for a plain number
    source: str  #: where the target comes from: author and report, closed form, other code
    reason: str  #: why the tolerance is what it is
    #: What the difference is divided by; None stands for the target's size, 1 for no division.
    scale: float | None = None

    def __post_init__(self) -> None:
        # Scalars of arrays become plain numbers, which every format of the report takes.
        for name in ("found", "target", "tolerance"):
            object.__setattr__(self, name, float(getattr(self, name)))
        if self.scale is not None:
            object.__setattr__(self, "scale", float(self.scale))
        if self.scale is None and self.target == 0:
            raise ValueError(f"{self.name}: a target of zero needs a scale")
        if self.scale is not None and not self.scale > 0:
            raise ValueError(f"{self.name}: the scale must be above zero, got {self.scale:g}")
        if not self.tolerance >= 0:
            raise ValueError(f"{self.name}: the tolerance must not be negative")

    @property
    def is_relative(self) -> bool:
        """Whether the difference is a share of something rather than in the figures' unit."""
        return self.scale != 1

    @property
    def difference(self) -> float:
        """Absolute difference of found and target, divided by the scale."""
        scale = abs(self.target) if self.scale is None else self.scale
        return abs(self.found - self.target) / scale

    @property
    def holds(self) -> bool:
        """Whether the difference is a number within the tolerance."""
        return isfinite(self.difference) and self.difference <= self.tolerance

    @property
    def used(self) -> float:
        """Share of the tolerance that the difference takes; infinite when it is not a number."""
        if not isfinite(self.difference):
            return inf
        if self.difference == 0:
            return 0.0
        return self.difference / self.tolerance if self.tolerance > 0 else inf
