"""A published limit as a curve over roll or mass: straight lines between points, and steps."""

from bisect import bisect_left
from dataclasses import dataclass
from enum import StrEnum

#: Share by which a number may pass a point or limit and still be on it: units were converted.
ROUNDING = 1e-9


class Outside(StrEnum):
    """What holds where the curve's points end."""

    HOLD = "hold"  #: the value of the last point
    INSPECT = "inspect"  #: the limit is zero: inspect whatever was recorded
    CANNOT_TELL = "cannot tell"  #: the rule does not apply there


@dataclass(frozen=True, slots=True)
class LimitCurve:
    """Points of rising argument; two points at one argument are a step.

    At a step the value before it still holds ("between 25 500 and 34 000 kg: 2.0 g; above
    34 000 kg: 1.75 g").
    """

    arguments: tuple[float, ...]  #: magnitudes of roll [rad] or mass [kg]; one for a constant
    values: tuple[float, ...]
    outside: Outside = Outside.HOLD

    def covers(self, argument: float) -> bool:
        """Whether the points reach to the argument."""
        first, last = self.arguments[0], self.arguments[-1]
        return first * (1.0 - ROUNDING) <= argument <= last * (1.0 + ROUNDING)

    def value(self, argument: float) -> float:
        """Interpolated value, that of the nearest point outside."""
        arguments, values = self.arguments, self.values
        following = bisect_left(arguments, argument * (1.0 - ROUNDING))
        if following == 0:
            return values[0]
        if following == len(arguments):
            return values[-1]
        before, after = arguments[following - 1], arguments[following]
        share = min((argument - before) / (after - before), 1.0)
        return values[following - 1] + share * (values[following] - values[following - 1])
