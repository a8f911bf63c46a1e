"""The report as one web page that needs nothing but itself."""

import re
from base64 import b64encode
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from verification import plots
from verification.report.document import Document

TEMPLATES = Path(__file__).parent

#: Inks of the plots that the page exchanges with its own, so that they suit a dark page.
_INKS = {plots.INK: "var(--ink)", plots.FAINT: "var(--faint)", plots.GRID: "var(--grid)"} | {
    colour: f"var(--c{index})" for index, colour in enumerate(plots.COLOURS)
}


def write_page(document: Document, path: Path) -> None:
    """Write the page."""
    environment = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    images = {file: _image(file, image) for file, image in document.images.items()}
    style = Markup((TEMPLATES / "page.css").read_text())
    text = environment.get_template("page.html.j2").render(
        document=document, images=images, style=style
    )
    path.write_text(text, encoding="utf-8")


def _image(file: str, image: bytes) -> Markup:
    """Drawing for the page: SVG in line, pictures as data."""
    name, _, kind = file.rpartition(".")
    if kind == "svg":
        return Markup(inline_svg(name, image.decode()))
    data = b64encode(image).decode()
    return Markup('<img src="data:image/png;base64,{}" alt="">').format(data)


def inline_svg(name: str, text: str) -> str:
    """SVG to stand inside a page: no prolog or metadata, ids of its own, the page's inks."""
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r"<style.*?</style>", "", text, flags=re.DOTALL)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    head, rest = text.split(">", 1)
    head = re.sub(r'\s(xmlns(:\w+)?|width|height|version)="[^"]*"', "", head)
    text = f'{head} aria-hidden="true">{rest}'
    text = re.sub(r'\bid="([^"]+)"', rf'id="{name}-\1"', text)
    text = re.sub(r"url\(#([^)]+)\)", rf"url(#{name}-\1)", text)
    text = re.sub(r'xlink:href="#([^"]+)"', rf'href="#{name}-\1"', text)
    for ink, variable in _INKS.items():
        text = text.replace(ink, variable)
    return text.strip()
