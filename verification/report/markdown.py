"""Chapters of the report as pages of the docs, in Markdown."""

from pathlib import Path

from verification.report.document import (
    Block,
    ComparisonBlock,
    Document,
    PlotBlock,
    Section,
    TableBlock,
    TextBlock,
)
from verification.report.numerals import Cell

#: Written at the head of every page.
NOTICE = "<!-- Written by `make verify DOCS=1` from the figures of that run. -->"


def write_pages(document: Document, folder: Path, figures: Path) -> None:
    """Write one page for each chapter of the run into ``folder``; others stay as they are.

    Parameters
    ----------
    figures : Path
        Where the drawings are, relative to ``folder``.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for section in document.sections:
        (folder / f"{section.name}.md").write_text(_page(section, figures), encoding="utf-8")


def _page(section: Section, figures: Path) -> str:
    parts = [NOTICE, f"# {section.title}", f"{section.count} comparisons, {section.state}."]
    parts += [_block(block, figures) for block in section.blocks]
    return "\n\n".join(parts) + "\n"


def _block(block: Block, figures: Path) -> str:
    match block:
        case TextBlock():
            return block.words
        case PlotBlock():
            place = (figures / block.file).as_posix()
            return f"![{_plain(block.name)}]({place})\n\n{block.caption}"
        case ComparisonBlock():
            return _comparisons(block)
        case TableBlock():
            rows = [[_cell(cell) for cell in row] for row in block.rows]
            lines = _table([cell.text for cell in block.columns], rows)
            return "\n\n".join(filter(None, [f"**{block.title}**", lines, block.note]))


def _comparisons(block: ComparisonBlock) -> str:
    heads = ["", "found", "target", "unit", "difference", "tolerance", "used", "note"]
    rows = [
        [
            row.name if row.holds else f"**{row.name} (missed)**",
            *[_cell(cell) for cell in row.cells],
            row.used,
            row.note,
        ]
        for row in block.rows
    ]
    notes = [f"- {note.letter}: target: {note.source}. {note.reason}" for note in block.notes]
    return "\n\n".join([f"**{block.title}**", _table(heads, rows), "\n".join(notes)])


def _table(heads: list[str], rows: list[list[str]]) -> str:
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join("| " + " | ".join(_plain(cell) for cell in line) + " |" for line in lines)


def _cell(cell: Cell) -> str:
    return cell.text.strip()


def _plain(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")
