"""Judge the monitor: ``python -m verification.judging``.

Flies the published accidents, scaled to the example aircraft, and a synthetic fleet with known
truth; prints what each method makes of it and writes tables and figures to ``var/judge``.  Landings
are stored as they are flown, so that an interrupted run goes on where it stopped; they count as
long as seed and sources are unchanged.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table as PrintedTable
from threadpoolctl import threadpool_limits

from solver.assessment import Verdict
from verification.chapter import Plot
from verification.judging.accident_file import published_cases
from verification.judging.accidents import JudgedCase, Scale, fly_case, scale_of
from verification.judging.docs import fill_page, write_figures
from verification.judging.figures import figures_of
from verification.judging.fleet import Fleet, fly_fleet, judging_model
from verification.judging.knowledge import compared_knowledge, learned_parameters
from verification.judging.methods import Answers
from verification.judging.score import FleetScore, score_fleet
from verification.judging.tables import (
    Table,
    calibration_table,
    cases_table,
    fleet_table,
    knowledge_table,
    learned_table,
    methods_table,
)
from verification.run import ROOT

#: Landings of the complete and of the quick form.
COMPLETE, QUICK = 160, 10

#: Of the tables where no terminal says how wide it is.
_WIDTH = 240

PAGE, FIGURES = ROOT / "docs" / "judging.md", ROOT / "docs" / "figures" / "judging"


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly, print, write; the exit status is 1 if an accident comes out NORMAL."""
    parser = argparse.ArgumentParser(prog="python -m verification.judging", description=__doc__)
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} landings")
    parser.add_argument("--landings", type=int, help=f"of the fleet ({COMPLETE})")
    parser.add_argument("--seed", type=int, default=4711, help="of the fleet (4711)")
    parser.add_argument("--processes", type=int, default=2, help="landings at a time (2)")
    parser.add_argument("--docs", action="store_true", help="also write docs/judging.md")
    parser.add_argument(
        "--folder", type=Path, default=ROOT / "var" / "judge", help="of answers and figures"
    )
    options = parser.parse_args(arguments)
    landings = options.landings or (QUICK if options.quick else COMPLETE)
    if options.docs and options.quick:
        parser.error("--docs shows the complete form, not the quick one")
    if landings < 1:
        parser.error(f"--landings must be 1 or more, got {landings}")

    console = Console(width=None if sys.stdout.isatty() else _WIDTH)
    cache = ROOT / "var" / "cache"
    scale, cases = _cases(options.folder, cache)
    fleet = Fleet(landings, options.seed, options.folder, cache, options.processes)
    answers = _flown(fleet, console)
    tables = [cases_table(cases, scale)]
    figures: tuple[Plot, ...] = ()
    try:
        score = score_fleet(answers, options.seed)
    except ValueError as error:
        console.print(f"{landings} landings are too few to compare methods: {error}", style="red")
    else:
        tables += _fleet_tables(answers, score)
        figures = figures_of(score)
    for table in tables:
        _show(table, console)
    write_figures(figures, options.folder)
    if options.docs:
        write_figures(figures, FIGURES)
        fill_page(PAGE, tables)
    normal = [c.case.name for c in cases if _is_missed(c)]
    if normal:
        console.print(f"accidents that came out NORMAL: {', '.join(normal)}", style="bold red")
    return int(bool(normal))


def _is_missed(judged: JudgedCase) -> bool:
    return judged.case.expected is Verdict.HARD and judged.assessment.verdict is Verdict.NORMAL


def _cases(folder: Path, cache: Path) -> tuple[Scale, list[JudgedCase]]:
    folder.mkdir(parents=True, exist_ok=True)
    with threadpool_limits(1):
        model = judging_model(folder, cache)
        scale = scale_of(model)
        return scale, [fly_case(model, scale, case) for case in published_cases()]


def _flown(fleet: Fleet, console: Console) -> list[Answers]:
    with Progress(
        TextColumn("landings"),
        BarColumn(bar_width=28),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        console=console,
        transient=True,
    ) as bar:
        task = bar.add_task("", total=fleet.landings)
        return fly_fleet(fleet, lambda done: bar.update(task, completed=done))


def _fleet_tables(answers: Sequence[Answers], score: FleetScore) -> list[Table]:
    tables = [fleet_table(answers, score), methods_table(score)]
    for name, title, calibration in (
        ("calibration-flown", "As flown", score.calibration_flown),
        ("calibration-service", "Weighted to service", score.calibration_service),
    ):
        if calibration is not None:
            tables.append(calibration_table(name, title, calibration))
    return [
        *tables,
        knowledge_table(compared_knowledge(answers)),
        learned_table(learned_parameters(answers)),
    ]


def _show(table: Table, console: Console) -> None:
    printed = PrintedTable(title=table.title, title_justify="left", box=None, pad_edge=False)
    for heading in table.headings:
        printed.add_column(heading, overflow="fold")
    for row in table.rows:
        printed.add_row(*row)
    console.print(printed)
    console.print()


if __name__ == "__main__":
    sys.exit(main())
