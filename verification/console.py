"""Progress of the chapters on a terminal or in a log, and the closing lines."""

from collections.abc import Sequence
from time import monotonic
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

from verification.outcome import Outcome
from verification.report.numerals import compared, duration, share


class Display:
    """One bar for the whole and one for each chapter under way; lines where no terminal is."""

    def __init__(self, total: int, console: Console, log_interval: float = 20.0) -> None:
        self._console, self._interval = console, log_interval
        self._bars = Progress(
            TextColumn("{task.fields[chapter]:<21}"),
            BarColumn(bar_width=28),
            TextColumn("{task.percentage:>3.0f} %"),
            TimeElapsedColumn(),
            TextColumn("{task.description}", style="dim"),
            console=console,
            transient=True,
            disable=not console.is_terminal,
        )
        self._whole = self._bars.add_task("", total=total, chapter="verification")
        self._tasks: dict[str, TaskID] = {}
        self._said: dict[str, float] = {}

    def __enter__(self) -> Self:
        self._bars.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._bars.stop()

    def started(self, chapter: str) -> None:
        """Show a bar for the chapter."""
        self._tasks[chapter] = self._bars.add_task("", total=1.0, chapter=chapter)
        self._said[chapter] = monotonic()

    def progress(self, chapter: str, step: str, share: float) -> None:
        """Move the chapter's bar; a log gets a line every few seconds."""
        self._bars.update(self._tasks[chapter], completed=share, description=step)
        now = monotonic()
        if not self._console.is_terminal and now - self._said[chapter] >= self._interval:
            self._said[chapter] = now
            self._console.print(f"  {chapter}: {step}, {share:.0%}", highlight=False)

    def finished(self, outcome: Outcome) -> None:
        """Take the bar away and say how the chapter ended."""
        self._bars.remove_task(self._tasks[outcome.name])
        self._bars.advance(self._whole)
        count, missed = len(outcome.comparisons), len(outcome.missed)
        words = f"{count} compared, all hold" if count else "nothing to compare"
        if missed:
            words = f"{count} compared, {missed} missed"
        if outcome.chapter is None:
            words = f"failed: {outcome.failure.strip().splitlines()[-1]}"
        line = Text(f"{outcome.name:<21} {words}, {duration(outcome.seconds)}")
        self._console.print(line, style="" if outcome.holds else "red")


def closing_lines(outcomes: Sequence[Outcome], console: Console) -> None:
    """Print what did not hold, and what failed."""
    missed = [(outcome.name, row) for outcome in outcomes for row in outcome.missed]
    if missed:
        table = Table(box=None, style="red", header_style="bold red", pad_edge=False)
        table.add_column("does not hold", overflow="fold")
        for heading in ("found", "target", "unit", "difference", "tolerance", "used"):
            table.add_column(heading, justify="left" if heading == "unit" else "right")
        for chapter, row in missed:
            figures = compared(row)
            table.add_row(
                f"{chapter}: {row.name}",
                figures.found,
                figures.target,
                figures.unit,
                figures.difference,
                figures.tolerance,
                share(row.used),
            )
        console.print(table)
    for outcome in outcomes:
        if outcome.chapter is None:
            console.print(f"{outcome.name} failed", style="bold red")
            console.print(Text(outcome.failure), style="red")
