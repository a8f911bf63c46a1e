"""The report on paper, set by Typst."""

import json
import shutil
from dataclasses import asdict
from pathlib import Path
from tempfile import TemporaryDirectory

import typst

from verification.report.document import Document

LAYOUT = Path(__file__).with_name("print.typ")


def write_print(document: Document, path: Path, pixels_per_inch: float | None = None) -> None:
    """Write the PDF, or one PNG for each page where a resolution is given.

    Parameters
    ----------
    path : Path
        For pictures with ``{p}`` in its name, the page's number.
    """
    with TemporaryDirectory() as name:
        folder = Path(name)
        layout = folder / LAYOUT.name
        shutil.copy(LAYOUT, layout)
        for file, image in document.images.items():
            (folder / file).write_bytes(image)
        values = asdict(document)
        del values["images"]
        (folder / "document.json").write_text(json.dumps(values))
        # Fonts of the program itself only, so that the same run looks the same everywhere.
        typst.compile(
            str(layout),
            output=str(path),
            root=str(folder),
            ignore_system_fonts=True,
            format="pdf" if pixels_per_inch is None else "png",
            ppi=pixels_per_inch,
        )
