"""Progress on the terminal for whatever takes longer than a moment."""

from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeElapsedColumn

from solver.progress import Progress as ProgressCall

#: Progress goes to standard error, so that standard output holds only the answer.
STANDARD_ERROR = Console(stderr=True)


@contextmanager
def progress_bars() -> Iterator[ProgressCall]:
    """Give a callback that draws one bar for each named step."""
    tasks: dict[str, TaskID] = {}
    columns = (TextColumn("{task.description:<28}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=STANDARD_ERROR) as bars:

        def show(step: str, share: float) -> None:
            if step not in tasks:
                for earlier in tasks.values():  # steps follow one another; stop their clocks
                    bars.update(earlier, completed=1.0)
                tasks[step] = bars.add_task(step, total=1.0)
            bars.update(tasks[step], completed=share)

        yield show
        for task in tasks.values():
            bars.update(task, completed=1.0)
