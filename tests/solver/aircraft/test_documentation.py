"""The page on aircraft folders names exactly what the reader knows."""

import re
from pathlib import Path

from solver.aircraft.definition_file import DefinitionFile
from solver.aircraft.nastran import HARMLESS_PARAMETERS, SUPPORTED_CARDS
from solver.aircraft.nastran_sections import SHAPES

PAGE = (Path(__file__).parents[3] / "docs" / "aircraft-folder.md").read_text()


def listed(pattern: str) -> set[str]:
    match = re.search(pattern, PAGE, re.DOTALL)
    assert match is not None
    return set(re.findall(r"[A-Z][A-Z0-9]+", match[1])) | set(re.findall(r"\b[IT]\b", match[1]))


def test_supported_cards_are_listed():
    assert listed(r"\nRead: (.*?)\.\n") == set(SUPPORTED_CARDS) - {"PARAM"}


def test_harmless_parameters_are_listed():
    assert listed(r"`check`: (.*?), and WTMASS") == set(HARMLESS_PARAMETERS)


def test_cross_sections_are_listed():
    assert listed(r"\| PBARL \| (.*?) \|") == set(SHAPES)


def test_every_table_of_the_definition_is_described():
    tables = {
        name
        for name, field in DefinitionFile.model_fields.items()
        if not (field.annotation is str or name == "bulk_data")
    }
    described = set(re.findall(r"`\[+(\w+)", PAGE))
    assert tables == described
