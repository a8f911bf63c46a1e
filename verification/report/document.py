"""The report as values, the same for the web page and the printed form; all texts are final."""

import string
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from verification.chapter import Comparisons, Item, Plot, Table, Text
from verification.comparison import Comparison
from verification.outcome import Outcome
from verification.report.numerals import Cell, aligned, compared, duration, share, typeset

#: A bar that shows the used part of a tolerance ends here.
FULL = 1.0
#: Digits of the list of all comparisons, at most.
DIGITS = 5


@dataclass(frozen=True, slots=True)
class ComparisonRow:
    """A comparison as it is printed."""

    table: str  #: number of its table, "3.2"
    name: str
    note: str  #: letter of the note on target and tolerance
    cells: tuple[Cell, ...]  #: found, target, unit, difference, tolerance
    used: str  #: share of the tolerance
    bar: float  #: the same, 0 to 1
    holds: bool


@dataclass(frozen=True, slots=True)
class Note:
    """Where targets come from and why tolerances are what they are."""

    letter: str
    source: str
    reason: str


@dataclass(frozen=True, slots=True)
class TextBlock:
    """A paragraph."""

    words: str
    kind: Literal["text"] = "text"


@dataclass(frozen=True, slots=True)
class ComparisonBlock:
    """A table of compared figures."""

    number: str  #: "3.2"
    title: str
    rows: tuple[ComparisonRow, ...]
    notes: tuple[Note, ...]
    kind: Literal["comparisons"] = "comparisons"


@dataclass(frozen=True, slots=True)
class TableBlock:
    """A table to look at."""

    number: str
    title: str
    columns: tuple[Cell, ...]
    rows: tuple[tuple[Cell, ...], ...]
    note: str
    kind: Literal["table"] = "table"


@dataclass(frozen=True, slots=True)
class PlotBlock:
    """A figure; its image is in `Document.images` under ``file``."""

    number: str
    name: str
    caption: str
    file: str
    kind: Literal["plot"] = "plot"


Block = TextBlock | ComparisonBlock | TableBlock | PlotBlock


@dataclass(frozen=True, slots=True)
class Section:
    """A chapter as it is printed."""

    number: int
    name: str
    title: str
    count: str  #: of comparisons
    state: str  #: "all hold", "2 missed", "failed"
    holds: bool
    worst: str  #: largest used share of a tolerance
    time: str
    failure: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, slots=True)
class Document:
    """The whole report."""

    title: str
    headline: str
    holds: bool
    facts: tuple[tuple[str, str], ...]
    sections: tuple[Section, ...]
    rows: tuple[ComparisonRow, ...]  #: all comparisons, worst first
    images: dict[str, bytes]


def build_document(outcomes: Sequence[Outcome], facts: Sequence[tuple[str, str]]) -> Document:
    """Make the report of chapters in their order.

    Raises
    ------
    ValueError
        Two figures have the same name.
    """
    plots = [
        item
        for outcome in outcomes
        if outcome.chapter is not None
        for item in outcome.chapter.items
        if isinstance(item, Plot)
    ]
    for name, count in Counter(plot.name for plot in plots).items():
        if count > 1:
            raise ValueError(f"{count} figures are named {name}")
    ranked = sorted(
        (
            (row, number)
            for chapter, outcome in enumerate(outcomes, 1)
            for item, number in _numbered(chapter, outcome)
            if isinstance(item, Comparisons)
            for row in item.rows
        ),
        key=lambda pair: -pair[0].used,
    )
    return Document(
        title="Hard-landing monitor: verification",
        headline=_headline(outcomes),
        holds=all(outcome.holds for outcome in outcomes),
        facts=tuple(facts),
        sections=tuple(_section(number, outcome) for number, outcome in enumerate(outcomes, 1)),
        rows=_comparison_rows(
            [row for row, _ in ranked], [number for _, number in ranked], {}, DIGITS
        ),
        images={_file(plot): plot.image for plot in plots},
    )


def _headline(outcomes: Sequence[Outcome]) -> str:
    total = sum(len(outcome.comparisons) for outcome in outcomes)
    missed = sum(len(outcome.missed) for outcome in outcomes)
    failed = sum(outcome.chapter is None for outcome in outcomes)
    if missed:
        words = f"{missed} of {total} comparisons {'does' if missed == 1 else 'do'} not hold"
    else:
        words = f"All {total} comparisons hold"
    if failed:
        words += f"; {failed} {'chapter' if failed == 1 else 'chapters'} failed"
    return words


def _section(number: int, outcome: Outcome) -> Section:
    worst = max((row.used for row in outcome.comparisons), default=None)
    missed = len(outcome.missed)
    state = "all hold" if outcome.comparisons else "nothing compared"
    if missed:
        state = f"{missed} missed"
    if outcome.chapter is None:
        state = "failed"
    return Section(
        number=number,
        name=outcome.name,
        title=outcome.name if outcome.chapter is None else outcome.chapter.title,
        count=str(len(outcome.comparisons)),
        state=state,
        holds=outcome.holds,
        worst="–" if worst is None else share(worst),
        time=duration(outcome.seconds_with_stored),
        failure=outcome.failure,
        blocks=_blocks(number, outcome),
    )


def _numbered(chapter: int, outcome: Outcome) -> Iterator[tuple[Item, str]]:
    """Items of a chapter with their numbers; tables and figures are counted apart."""
    tables = figures = 0
    for item in () if outcome.chapter is None else outcome.chapter.items:
        if isinstance(item, Plot):
            figures += 1
            yield item, f"{chapter}.{figures}"
        elif isinstance(item, Text):
            yield item, ""
        else:
            tables += 1
            yield item, f"{chapter}.{tables}"


def _blocks(chapter: int, outcome: Outcome) -> tuple[Block, ...]:
    blocks: list[Block] = []
    for item, number in _numbered(chapter, outcome):
        if isinstance(item, Text):
            blocks.append(TextBlock(typeset(item.words)))
        elif isinstance(item, Plot):
            blocks.append(PlotBlock(number, item.name, typeset(item.caption), _file(item)))
        elif isinstance(item, Comparisons):
            blocks.append(_comparison_block(number, item))
        else:
            blocks.append(_table_block(number, item))
    return tuple(blocks)


def _file(plot: Plot) -> str:
    return f"{plot.name}.{plot.format}"


def _comparison_block(number: str, item: Comparisons) -> ComparisonBlock:
    letters: dict[tuple[str, str], str] = {}
    for row in item.rows:
        letters.setdefault((row.source, row.reason), _letter(len(letters)))
    return ComparisonBlock(
        number=number,
        title=typeset(item.title),
        rows=_comparison_rows(item.rows, [number] * len(item.rows), letters),
        notes=tuple(Note(letter, *map(typeset, texts)) for texts, letter in letters.items()),
    )


def _letter(index: int) -> str:
    alphabet = string.ascii_lowercase
    return alphabet[index % 26] * (1 + index // 26)


def _comparison_rows(
    rows: Sequence[Comparison],
    tables: Sequence[str],
    letters: dict[tuple[str, str], str],
    most_digits: int = 9,
) -> tuple[ComparisonRow, ...]:
    figures = [compared(row, most_digits) for row in rows]
    columns = aligned(
        [
            [figure.found for figure in figures],
            [figure.target for figure in figures],
            [figure.unit for figure in figures],
            [figure.difference for figure in figures],
            [figure.tolerance for figure in figures],
        ]
    )
    return tuple(
        ComparisonRow(
            table=table,
            name=typeset(row.name),
            note=letters.get((row.source, row.reason), ""),
            cells=cells,
            used=share(row.used),
            bar=min(row.used, FULL),
            holds=row.holds,
        )
        for row, table, cells in zip(rows, tables, zip(*columns, strict=True), strict=True)
    )


def _table_block(number: str, item: Table) -> TableBlock:
    """Cells aligned column by column; a heading is aligned as its column is."""
    columns = aligned(
        [[typeset(row[index]) for row in item.rows] for index in range(len(item.columns))]
    )
    headings = tuple(
        Cell(heading, is_number=bool(column) and all(cell.is_number for cell in column))
        for heading, column in zip(item.columns, columns, strict=True)
    )
    rows = tuple(zip(*columns, strict=True))
    return TableBlock(number, typeset(item.title), headings, rows, typeset(item.note))
