"""The page on makers' rules knows every rule, source and certainty of the package."""

import re
from pathlib import Path

import pytest

from solver.verdict.makers_rule import Certainty
from solver.verdict.makers_rule_reader import packaged_rule, packaged_rules, read_makers_rule

PAGE = (Path(__file__).parents[3] / "docs" / "makers-rules.md").read_text()
LIMITS, SOURCES = PAGE.split("## Sources and how certain they are")


@pytest.mark.parametrize("name", packaged_rules())
def test_every_rule_is_listed_with_its_certainties(name: str) -> None:
    assert f"`{name}`" in LIMITS
    (line,) = (line for line in SOURCES.splitlines() if line.startswith(f"| `{name}`"))
    certainties = {
        limit.source.certainty
        for criterion in packaged_rule(name).criteria
        for limit in criterion.limits
    }
    assert set(line.split("|")[3].replace(";", " ").split()) == certainties


def test_every_certainty_is_explained() -> None:
    assert all(f"`{certainty}`" in SOURCES for certainty in Certainty)


def test_every_address_of_a_source_is_on_the_page() -> None:
    for name in packaged_rules():
        for criterion in packaged_rule(name).criteria:
            for limit in criterion.limits:
                for host in re.findall(
                    r"[a-z.]+\.(?:com|cn|net|org)/[\w./?=-]+", limit.source.text
                ):
                    assert host in PAGE or "scribd" in host, host


def test_the_example_can_be_read(tmp_path: Path) -> None:
    (example,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    path = tmp_path / "example.toml"
    path.write_text(example)
    assert read_makers_rule(path).title == "Some maker, type 123"
