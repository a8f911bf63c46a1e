"""Run the verification and write its report: ``python -m verification``.

Writes ``var/verify/report.html`` and ``report.pdf`` from numbers computed in this run.  Long
results are stored as they are found, so that an interrupted run goes on where it stopped; they
count as long as the sources and inputs they rest on are unchanged.  The exit status is 1 if a
comparison does not hold or a chapter fails.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from time import perf_counter

from rich.console import Console

from verification import work
from verification.chapter import Plot
from verification.chapters import existing, in_starting_order
from verification.circumstances import facts
from verification.console import Display, closing_lines
from verification.outcome import Outcome
from verification.report import build_document, write_page, write_pages, write_print
from verification.run import ROOT, Run

#: Where the chapters are.
CHAPTERS = work.CHAPTERS

#: Where the docs are, and what of them is written here.
DOCS = ROOT / "docs"
PAGES, FIGURES = Path("verification"), Path("figures") / "verification"
PAPER = b'<rect width="100%" height="100%" fill="#ffffff"/>'


def main(arguments: Sequence[str] | None = None) -> int:
    """Compute, write, print what does not hold."""
    available = existing()
    parser = argparse.ArgumentParser(prog="python -m verification", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="short form, a few minutes")
    parser.add_argument(
        "--only", action="append", choices=available, metavar="CHAPTER",
        help=f"one chapter; may be repeated ({', '.join(available)})",
    )  # fmt: skip
    parser.add_argument(
        "--docs", action="store_true", help="also write chapters and figures below docs"
    )
    parser.add_argument("--processes", type=int, default=2, help="chapters at a time (2)")
    parser.add_argument(
        "--folder", type=Path, default=ROOT / "var" / "verify", help="of results and report"
    )
    options = parser.parse_args(arguments)
    if options.docs and options.quick:
        parser.error("--docs shows the complete form, not the quick one")
    names = tuple(name for name in available if not options.only or name in options.only)

    console = Console(stderr=True)
    start = perf_counter()
    outcomes = _outcomes(names, options, console)
    form = "quick" if options.quick else "complete"
    if options.only:
        form += f", {', '.join(names)} only"
    document = build_document(outcomes, facts(outcomes, form, perf_counter() - start))
    stem = "report" + ("-quick" if options.quick else "") + ("-part" if options.only else "")
    page, printed = (options.folder / f"{stem}.{kind}" for kind in ("html", "pdf"))
    write_page(document, page)
    write_print(document, printed)
    if options.docs:
        write_figures(outcomes, DOCS / FIGURES)
        write_pages(document, DOCS / PAGES, Path("..") / FIGURES)
    closing_lines(outcomes, console)
    console.print(document.headline, style="bold" if document.holds else "bold red")
    print(f"{page}\n{printed}")
    return 0 if document.holds else 1


def _outcomes(
    names: tuple[str, ...], options: argparse.Namespace, console: Console
) -> list[Outcome]:
    options.folder.mkdir(parents=True, exist_ok=True)
    with Display(len(names), console) as display:
        run = Run(options.folder, options.quick)
        started = in_starting_order(names)
        if options.processes == 1 or len(names) == 1:
            found = work.compute_here(started, run, display, CHAPTERS)
        else:
            found = work.compute_apart(started, run, display, options.processes, CHAPTERS)
    by_name = {outcome.name: outcome for outcome in found}
    return [by_name[name] for name in names]


def write_figures(outcomes: Sequence[Outcome], folder: Path) -> None:
    """Write the drawings of the chapters for the docs, one file each."""
    folder.mkdir(parents=True, exist_ok=True)
    for outcome in outcomes:
        if outcome.chapter is None:
            continue
        for item in outcome.chapter.items:
            if isinstance(item, Plot):
                # Drawings are transparent; pages of docs may be dark.
                image = item.image
                if item.format == "svg":
                    image = image.replace(b"<defs>", PAPER + b"<defs>", 1)
                (folder / f"{item.name}.{item.format}").write_bytes(image)


if __name__ == "__main__":
    sys.exit(main())
