"""How fast this process solves, which decides how many landings it claims at once."""

from dataclasses import dataclass

#: Weight of the latest landing: fleets are mixed, so the estimate follows within a few landings.
_WEIGHT = 0.3


@dataclass(slots=True)
class Pace:
    """Running estimate of the time that a landing takes."""

    seconds: float | None = None  #: None until a landing was solved

    def note(self, seconds: float) -> None:
        """Take a solved landing into account."""
        known = self.seconds
        self.seconds = seconds if known is None else known + _WEIGHT * (seconds - known)

    def batch(self, within: float, most: int) -> int:
        """How many landings can be solved ``within`` so many seconds; at least one."""
        if self.seconds is None:
            return 1
        if self.seconds * most <= within:
            return most
        return max(1, int(within / self.seconds))
