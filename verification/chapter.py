"""What a chapter of the report is made of."""

from dataclasses import dataclass
from typing import Literal

from verification.comparison import Comparison


@dataclass(frozen=True, slots=True)
class Text:
    """A paragraph of plain words."""

    words: str


@dataclass(frozen=True, slots=True)
class Comparisons:
    """Compared figures, shown as one table; any that does not hold fails the command."""

    title: str
    rows: tuple[Comparison, ...]


@dataclass(frozen=True, slots=True)
class Table:
    """Figures to look at, without a judgement; cells are already formatted."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""


@dataclass(frozen=True, slots=True)
class Plot:
    """A drawn figure; ``name`` is unique in the report and names its file in ``docs/figures``."""

    name: str
    caption: str
    image: bytes
    format: Literal["svg", "png"]


Item = Text | Comparisons | Table | Plot


@dataclass(frozen=True, slots=True)
class Chapter:
    """One chapter: its module's name, title and contents in order."""

    name: str
    title: str
    items: tuple[Item, ...]

    @property
    def comparisons(self) -> tuple[Comparison, ...]:
        """All compared figures of the chapter."""
        tables = (item for item in self.items if isinstance(item, Comparisons))
        return tuple(row for table in tables for row in table.rows)
