"""Tables and figures put into the docs: prose is written by people, figures by the run."""

import re
from collections.abc import Sequence
from pathlib import Path

from verification.chapter import Plot
from verification.judging.tables import Table

_PAPER = b'<rect width="100%" height="100%" fill="#ffffff"/>'


def write_figures(figures: Sequence[Plot], folder: Path) -> None:
    """Write drawings, one file each, on white paper: pages of docs may be dark."""
    folder.mkdir(parents=True, exist_ok=True)
    for figure in figures:
        image = figure.image.replace(b"<defs>", _PAPER + b"<defs>", 1)
        (folder / f"{figure.name}.{figure.format}").write_bytes(image)


def fill_page(page: Path, tables: Sequence[Table]) -> None:
    """Put tables between ``<!-- table: name -->`` and ``<!-- end -->`` in a page.

    Raises
    ------
    ValueError
        The page has no place for a table.
    """
    text = page.read_text(encoding="utf-8")
    for table in tables:
        place = re.compile(rf"(<!-- table: {table.name} -->\n).*?(<!-- end -->)", re.DOTALL)
        # Backslashes of a replacement would be read as references.
        filled = f"{table.title}.\n\n{table.markdown()}\n".replace("\\", r"\\")
        text, count = place.subn(rf"\g<1>{filled}\g<2>", text)
        if count != 1:
            raise ValueError(f"{page}: {count} places for the table {table.name}, needed is one")
    page.write_text(text, encoding="utf-8")
