"""Under which circumstances a run was made: versions, processor, date, what was kept."""

import os
import platform
import subprocess
from collections.abc import Sequence
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, distributions, version
from pathlib import Path

from verification.outcome import Outcome
from verification.report.numerals import duration
from verification.run import ROOT

#: Libraries whose versions the report states.
LIBRARIES = ("numpy", "scipy", "numba", "matplotlib", "typst")
#: Independent codes, where they are installed.
PEERS = ("exudyn", "KratosMultiphysics")


def facts(outcomes: Sequence[Outcome], form: str, elapsed: float) -> list[tuple[str, str]]:
    """Names and values for the report's first page."""
    libraries = ", ".join(f"{name} {version(name)}" for name in (*LIBRARIES, *_installed(PEERS)))
    kept = [result for outcome in outcomes for result in outcome.taken if result.is_earlier]
    time = duration(elapsed)
    if kept:
        count = f"{len(kept)} result" + ("s" if len(kept) > 1 else "")
        time += f"; {count} of unchanged sources kept from an interrupted or earlier run, "
        time += f"computed in {duration(sum(result.seconds for result in kept))}"
    aircraft = sorted({outcome.aircraft for outcome in outcomes if outcome.aircraft})
    return [
        ("Date", datetime.now(UTC).strftime("%d %B %Y, %H:%M UTC")),
        ("Form", form),
        ("Running time", time),
        ("Program", _program()),
        ("Libraries", f"Python {platform.python_version()}, {libraries}"),
        ("Processor", f"{os.cpu_count()} cores, {_processor()}; one thread for each chapter"),
        (
            "Aircraft model",
            ", ".join(f"EBJ-19, SHA-256 {value[:16]}" for value in aircraft) or "not used",
        ),
    ]


def _installed(names: Sequence[str]) -> list[str]:
    """Those of the names that are installed."""
    known = {distribution.name for distribution in distributions()}
    return [name for name in names if name in known]


def _program() -> str:
    try:
        text = f"hardlanding {version('hardlanding')}"
    except PackageNotFoundError:
        text = "hardlanding"
    commit = _git("rev-parse", "--short=12", "HEAD")
    if commit:
        changed = _git("status", "--porcelain", "--", "solver", "verification")
        text += f", commit {commit}" + (" with changes" if changed else "")
    return text


def _git(*arguments: str) -> str:
    """Give the answer of git, empty outside a checkout."""
    try:
        answer = subprocess.run(
            ["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=True, timeout=20
        )
    except (OSError, subprocess.SubprocessError):
        return ""
    return answer.stdout.strip()


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    for line in lines:
        if line.startswith("model name"):
            return " ".join(line.partition(":")[2].split())
    return platform.processor() or platform.machine()
