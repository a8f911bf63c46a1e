"""Tables go into the page where it has a place for them, and nowhere else."""

from pathlib import Path

import pytest

from verification.judging.docs import fill_page
from verification.judging.tables import Table

TABLE = Table("one", "Title", ("a", "b"), (("1", r"x\1"), ("2", "y")))
PAGE = "before\n<!-- table: one -->\nold\n<!-- end -->\nafter\n"


def test_a_table_replaces_what_stood_there(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(PAGE)
    fill_page(page, [TABLE])
    once = page.read_text()
    assert once.startswith("before\n<!-- table: one -->\nTitle.\n\n| a | b |\n| --- | --- |\n")
    assert r"| 1 | x\1 |" in once
    assert "old" not in once
    assert once.endswith("<!-- end -->\nafter\n")
    fill_page(page, [TABLE])
    assert page.read_text() == once


def test_a_page_without_a_place_is_refused_unchanged(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("nothing")
    with pytest.raises(ValueError, match="0 places for the table one"):
        fill_page(page, [TABLE])
    assert page.read_text() == "nothing"
