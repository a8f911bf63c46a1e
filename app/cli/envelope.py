"""`hardlanding envelope`: limit sink rates of an aircraft over attitude, loading and lift."""

import json
import math
import os
import sys
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.table import Table

from app.cli.progress import STANDARD_ERROR, progress_bars
from app.config import Settings, get_settings
from app.fleet.envelopes import Envelopes
from app.fleet.registry import AircraftRegistry
from solver.assessment import ADVISORY
from solver.envelope.build import LANDINGS, EnvelopeBusyError, build_envelope
from solver.envelope.domain import COORDINATES
from solver.envelope.envelope import COVERED_SHARE, Envelope, LimitSinkRate
from solver.envelope.sections import limit_at, loading_at, usual_contact
from solver.errors import RecordError, SolverError

#: Of the table: rolls [degrees], and masses as shares of the way from empty to take-off.
_ROLLS = (0.0, 2.0, 4.0, 6.0)
_FOOT = 0.3048

#: The background has what nobody else wants.
_LOWEST_PRIORITY = 19


def missing_command() -> list[str]:
    """The program that makes whatever envelope is missing, for the supervisor."""
    return [sys.executable, "-m", "app.cli.main", "envelope", "--missing"]


def envelope(
    aircraft: Annotated[
        str | None, typer.Argument(help="Name of an installed aircraft (default: the only one).")
    ] = None,
    landings: Annotated[
        int, typer.Option(min=120, help="How many to simulate; a run continues where it stopped.")
    ] = LANDINGS,
    processes: Annotated[
        int | None, typer.Option(min=1, help="Side by side (default: one for each core).")
    ] = None,
    plots: Annotated[
        Path | None, typer.Option(help="Folder for pictures; needs the extra 'plot'.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Only JSON on standard output.")] = False,
    missing: Annotated[
        bool, typer.Option("--missing", help="Make what no installed aircraft has yet, quietly.")
    ] = False,
) -> None:
    """Simulate an aircraft's landings and say at which sink rate each reaches a limit."""
    settings = get_settings()
    if missing:
        _make_missing(settings, landings)
        return
    try:
        name = aircraft or _only(settings)
        with progress_bars() as progress:
            found = build_envelope(
                settings.aircraft_folder / name,
                settings.cache_folder,
                landings,
                processes,
                progress,
            )
    except (SolverError, EnvelopeBusyError, OSError) as error:
        STANDARD_ERROR.print(str(error), style="red", markup=False)
        raise typer.Exit(2) from error
    if as_json:
        typer.echo(json.dumps(document(found), indent=1))
    else:
        show(found, Console())
    if plots is not None:
        _draw(found, plots)


def _make_missing(settings: Settings, landings: int) -> None:
    os.nice(_LOWEST_PRIORITY)
    registry = AircraftRegistry(settings.aircraft_folder)
    known = Envelopes(registry, settings.cache_folder)
    for aircraft in registry.all():
        name = aircraft.definition.name
        if known.get(name) is not None:
            continue
        try:
            build_envelope(aircraft.folder, settings.cache_folder, landings)
        except (SolverError, EnvelopeBusyError) as error:
            # The service runs without it, and the other aircraft should have theirs.
            typer.echo(f"no envelope of {name}: {error}", err=True)
        else:
            typer.echo(f"the envelope of {name} is made", err=True)


def _only(settings: Settings) -> str:
    folders = [p.parent.name for p in settings.aircraft_folder.glob("*/definition.toml")]
    if len(folders) != 1:
        names = ", ".join(sorted(folders)) or "none"
        STANDARD_ERROR.print(f"say which aircraft; installed: {names}", style="red", markup=False)
        raise typer.Exit(2)
    return folders[0]


def _draw(found: Envelope, folder: Path) -> None:
    try:
        from app.cli.envelope_plot import draw
    except ModuleNotFoundError as error:
        STANDARD_ERROR.print(f"pictures need the extra 'plot': {error}", style="red", markup=False)
        raise typer.Exit(2) from error
    folder.mkdir(parents=True, exist_ok=True)
    for path in draw(folder, found):
        STANDARD_ERROR.print(str(path), markup=False, highlight=False)


def masses_of(found: Envelope) -> list[tuple[str, float]]:
    """Masses [kg] that an operator knows by name, lightest first."""
    masses = found.mass_states.definition.masses
    light = 0.5 * (masses.operating_empty + masses.maximum_landing)
    named = [
        ("half way to landing", light),
        ("maximum landing", masses.maximum_landing),
        ("maximum take-off", masses.maximum_takeoff),
    ]
    return sorted(named, key=lambda pair: pair[1])


def _rows(found: Envelope) -> list[dict[str, Any]]:
    """Limits at the thresholds, for usual contacts in some masses and rolls."""
    rows: list[dict[str, Any]] = []
    thresholds = found.mass_states.definition.verdict
    for title, mass in masses_of(found):
        try:
            loading = loading_at(found, mass)
        except RecordError:
            continue  # its tanks and bays do not carry that much
        for roll in _ROLLS:
            if math.radians(roll) > thresholds.roll_limit * (1.0 + 1e-9):
                continue
            limits = {
                level: limit_at(found, loading, at, roll=math.radians(roll))
                for level, at in (("INSPECT", thresholds.inspect_utilisation), ("HARD", 1.0))
            }
            rows.append({"title": title, "mass": loading.mass, "roll": roll, **limits})
    return rows


def document(found: Envelope) -> dict[str, Any]:
    """Plain JSON values, units in the key names; null for beyond the envelope."""
    error, basis, contact = found.error, found.basis, usual_contact(found)

    def span(limit: LimitSinkRate) -> dict[str, float | None]:
        return {
            name: value if math.isfinite(value) else None
            for name, value in (("value", limit.value), ("low", limit.low), ("high", limit.high))
        }

    return {
        "aircraft": found.mass_states.definition.name,
        "content_hash": basis.content_hash,
        "program_version": basis.program_version,
        "landings": basis.landings,
        "failed_landings": basis.failed,
        "error": {
            "covered_share": COVERED_SHARE,
            "above": error.above,
            "below": error.below,
            "root_mean_square": error.root_mean_square,
            "landings_compared": error.landings,
        },
        "ranges_si": {
            name: [float(low), float(high)]
            for name, low, high in zip(
                COORDINATES, found.domain.low, found.domain.high, strict=True
            )
        },
        "pitch_deg": math.degrees(contact.pitch),
        "ground_speed_m_s": contact.ground_speed,
        "limit_sink_rates_m_s": [
            {
                "mass_kg": row["mass"],
                "roll_deg": row["roll"],
                "inspect": span(row["INSPECT"]),
                "hard": span(row["HARD"]),
            }
            for row in _rows(found)
        ],
        "advisory": ADVISORY,
    }


def _shown(limit: LimitSinkRate, hardest: float) -> str:
    def number(value: float) -> str:
        return f"{value:.2f}" if math.isfinite(value) else f"over {hardest:.1f}"

    feet = f", {limit.value / _FOOT:.1f} ft/s" if math.isfinite(limit.value) else ""
    return f"{number(limit.value)} ({number(limit.low)} to {number(limit.high)}){feet}"


def show(found: Envelope, console: Console) -> None:
    """Print what the envelope rests on and limits that an operator can use."""
    error, basis, contact = found.error, found.basis, usual_contact(found)
    name = found.mass_states.definition.name
    console.print(
        f"\n[bold]{name}[/]  {basis.landings} landings fitted, {error.landings} compared: "
        f"root mean square {error.root_mean_square:.1%}; {COVERED_SHARE:.1%} use at most "
        f"{error.above:.0%} more than expected, as many at most {error.below:.0%} less",
        highlight=False,
    )
    title = (
        f"Sink rate in m/s at which a limit is reached (with the error), pitch "
        f"{math.degrees(contact.pitch):.1f} deg, {contact.ground_speed:.0f} m/s, lift 1"
    )
    table = Table(title=title, title_justify="left")
    for heading in ("mass", "kg", "roll deg", "INSPECT", "HARD"):
        table.add_column(heading)
    hardest = float(found.domain.high[0])
    for row in _rows(found):
        table.add_row(
            row["title"],
            f"{row['mass']:,.0f}",
            f"{row['roll']:.0f}",
            _shown(row["INSPECT"], hardest),
            _shown(row["HARD"], hardest),
        )
    console.print(table)
    console.print(ADVISORY)
