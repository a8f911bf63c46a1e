"""What became of a chapter in a run."""

from dataclasses import dataclass

from verification.chapter import Chapter
from verification.comparison import Comparison
from verification.run import StoredResult


@dataclass(frozen=True, slots=True)
class Outcome:
    """A chapter as it was computed, or why it could not be."""

    name: str
    chapter: Chapter | None  #: None: it failed
    failure: str  #: traceback; empty unless it failed
    seconds: float  #: that it took in this run
    taken: tuple[StoredResult, ...] = ()
    aircraft: str = ""  #: hash of the aircraft it used, if any

    @property
    def comparisons(self) -> tuple[Comparison, ...]:
        """Compared figures, none of a chapter that failed."""
        return () if self.chapter is None else self.chapter.comparisons

    @property
    def missed(self) -> tuple[Comparison, ...]:
        """Compared figures that do not hold."""
        return tuple(row for row in self.comparisons if not row.holds)

    @property
    def holds(self) -> bool:
        """Whether it was computed and all its comparisons hold."""
        return self.chapter is not None and not self.missed

    @property
    def seconds_with_stored(self) -> float:
        """What it takes from nothing: this run, and what earlier ones spent on kept results."""
        return self.seconds + sum(result.seconds for result in self.taken if result.is_earlier)
