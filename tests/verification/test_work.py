from pathlib import Path

import pytest

from verification import __main__ as command
from verification.outcome import Outcome
from verification.run import Run
from verification.work import compute_apart, compute_here

SAMPLES = "tests.verification.sample_chapters"


class Watcher:
    def __init__(self) -> None:
        self.steps: list[tuple[str, str, float]] = []
        self.ends: list[str] = []

    def started(self, chapter: str) -> None:
        pass

    def progress(self, chapter: str, step: str, share: float) -> None:
        self.steps.append((chapter, step, share))

    def finished(self, outcome: Outcome) -> None:
        self.ends.append(outcome.name)


def test_chapter_that_raises_keeps_none_from_the_rest(tmp_path: Path) -> None:
    watcher = Watcher()
    broken, held = compute_here(["broken", "held"], Run(tmp_path), watcher, SAMPLES)
    assert broken.chapter is None
    assert "RuntimeError: the bridge is out" in broken.failure
    assert held.holds
    assert watcher.steps == [("held", "counting", 1.0)]
    assert watcher.ends == ["broken", "held"]


def test_process_that_dies_fails_its_chapter_and_is_replaced(tmp_path: Path) -> None:
    watcher = Watcher()
    names = ["killed", "broken", "missed", "held"]
    outcomes = compute_apart(names, Run(tmp_path), watcher, 2, SAMPLES)
    killed, broken, missed, held = outcomes
    assert killed.chapter is None
    assert "exit code -9" in killed.failure
    assert "the bridge is out" in broken.failure
    assert [row.found for row in missed.missed] == [1100.0]
    assert held.holds
    assert ("held", "counting", 1.0) in watcher.steps
    assert sorted(watcher.ends) == sorted(names)


def run_command(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, chapters: tuple[str, ...], *more: str
) -> int:
    monkeypatch.setattr(command, "CHAPTERS", SAMPLES)
    monkeypatch.setattr(command, "existing", lambda: chapters)
    return command.main(["--folder", str(tmp_path), "--processes", "1", *more])


def test_command_succeeds_where_everything_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run_command(tmp_path, monkeypatch, ("held",)) == 0
    assert capsys.readouterr().out.split() == [
        str(tmp_path / "report.html"),
        str(tmp_path / "report.pdf"),
    ]
    page = (tmp_path / "report.html").read_text()
    assert "All 2 comparisons hold" in page
    assert "four &lt;thirds&gt;" in page


def test_comparison_that_does_not_hold_fails_the_command_and_is_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run_command(tmp_path, monkeypatch, ("held", "missed")) == 1
    printed = capsys.readouterr().err
    line = next(line for line in printed.splitlines() if "ten per cent off" in line)
    for figure in ("1.100", "1.000", "kN", "10 %", "1.0 %"):
        assert figure in line
    assert "1 of 3 comparisons does not hold" in (tmp_path / "report.html").read_text()


def test_failed_chapter_fails_the_command_after_the_others_ran(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run_command(tmp_path, monkeypatch, ("broken", "held")) == 1
    assert "the bridge is out" in capsys.readouterr().err
    page = (tmp_path / "report.html").read_text()
    assert "the bridge is out" in page
    assert "What holds" in page


def test_one_chapter_alone_is_reported_apart(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert run_command(tmp_path, monkeypatch, ("held", "missed"), "--only", "held", "--quick") == 0
    assert (tmp_path / "report-quick-part.html").exists()
    assert not (tmp_path / "report.html").exists()


def test_docs_get_the_figures_and_the_chapters_of_the_report(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(command, "DOCS", tmp_path / "docs")
    run_command(tmp_path, monkeypatch, ("held",), "--docs")
    (drawing,) = (tmp_path / "docs" / "figures" / "verification").iterdir()
    assert drawing.name in (tmp_path / "docs" / "verification" / "held.md").read_text()
    assert drawing.name == "held-square.svg"
    assert b"<svg" in drawing.read_bytes()
    with pytest.raises(SystemExit):
        run_command(tmp_path, monkeypatch, ("held",), "--docs", "--quick")
