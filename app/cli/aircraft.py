"""`hardlanding aircraft`: build the example aircraft, check any aircraft folder."""

import json
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.table import Table

from app.cli.demo import EXAMPLE_AIRCRAFT
from app.cli.progress import STANDARD_ERROR, progress_bars
from app.config import get_settings
from solver.aircraft.airframe import load_airframe
from solver.aircraft.check import AirframeCheck, check_airframe
from solver.errors import SolverError
from solver.verdict.makers_rule_reader import load_makers_rule

aircraft = typer.Typer(no_args_is_help=True)


@aircraft.command()
def build(
    folder: Annotated[
        Path | None, typer.Argument(help="Target folder (default: the example's own).")
    ] = None,
) -> None:
    """Generate the example business jet: definition.toml and its bulk data."""
    from solver.aircraft.bizjet import build_bizjet

    target = folder or get_settings().aircraft_folder / EXAMPLE_AIRCRAFT
    try:
        with progress_bars() as progress:
            build_bizjet(target, progress=progress)
    except (SolverError, OSError) as error:
        STANDARD_ERROR.print(str(error), style="red", markup=False)
        raise typer.Exit(2) from error
    typer.echo(str(target))


@aircraft.command()
def check(
    folder: Annotated[Path, typer.Argument(help="Folder with definition.toml and bulk data.")],
    as_json: Annotated[bool, typer.Option("--json", help="Only JSON on standard output.")] = False,
) -> None:
    """Read and assemble an aircraft, weigh it, and prove that it moves rigidly without stress."""
    try:
        with progress_bars() as progress:
            airframe = load_airframe(folder, progress)
            rule = load_makers_rule(folder, airframe.definition.makers_rule)
            found = check_airframe(airframe, progress)
    except (SolverError, OSError) as error:
        STANDARD_ERROR.print(str(error), style="red", markup=False)
        raise typer.Exit(2) from error
    if as_json:
        name = None if rule is None else rule.name
        typer.echo(json.dumps(document(found) | {"makers_rule": name}, indent=1))
    else:
        title = "none" if rule is None else rule.title
        Console().print(f"maker's rule: {title}", markup=False)
        show(found, Console())
    if not found.is_sound:
        raise typer.Exit(1)


def document(found: AirframeCheck) -> dict[str, Any]:
    """Plain JSON values of a check, units in the key names."""
    body = found.rigid_body
    return {
        "name": found.name,
        "content_hash": found.content_hash,
        "is_sound": found.is_sound,
        "counts": found.counts,
        "empty_mass_kg": found.empty_mass,
        "default_loading": {
            "mass_kg": found.loaded_mass,
            "centre_of_gravity_m": found.loaded_centre.tolist(),
            "chord_fraction": found.loaded_chord_fraction,
            "airframe_mass_kg": body.mass,
            "airframe_centre_of_gravity_m": body.centre_of_gravity.tolist(),
            "airframe_inertia_kg_m2": body.inertia.tolist(),
        },
        "rigid_energy_share": found.rigid_energy,
        "rigid_modes": found.rigid_modes,
        "elastic_frequencies_hz": list(found.elastic_frequencies),
        "zones": [
            {
                "name": zone.name,
                "elements": zone.elements,
                "lowest_allowable_pa": zone.lowest_allowable,
                "highest_allowable_pa": zone.highest_allowable,
            }
            for zone in found.zones
        ],
        "warnings": list(found.warnings),
    }


def show(found: AirframeCheck, console: Console) -> None:
    """Print a check for a reader."""
    console.print(f"[bold]{found.name}[/bold]  {found.content_hash[:16]}")
    console.print(", ".join(f"{count:,} {name}" for name, count in found.counts.items()))
    x, y, z = found.loaded_centre
    console.print(
        f"empty {found.empty_mass:,.0f} kg; default loading {found.loaded_mass:,.0f} kg, centre of "
        f"gravity {x:.3f} {y:+.3f} {z:.3f} m ({100 * found.loaded_chord_fraction:.1f} % MAC)"
    )
    roll, pitch, yaw = found.rigid_body.inertia.diagonal()
    console.print(f"inertia roll {roll:,.0f}, pitch {pitch:,.0f}, yaw {yaw:,.0f} kg m2")
    frequencies = ", ".join(f"{frequency:.2f}" for frequency in found.elastic_frequencies)
    console.print(
        f"{found.rigid_modes} rigid modes, strain energy share {found.rigid_energy:.1e}; elastic "
        f"modes from {frequencies} Hz"
    )
    table = Table("zone", "elements", "limit allowable [MPa]")
    for zone in found.zones:
        low, high = zone.lowest_allowable / 1e6, zone.highest_allowable / 1e6
        span = f"{low:.0f}" if low == high else f"{low:.0f} to {high:.0f}"
        table.add_row(zone.name, f"{zone.elements:,}", span)
    console.print(table)
    for warning in found.warnings:
        console.print(f"warning: {warning}", style="yellow", markup=False)
    colour, verdict = ("green", "sound") if found.is_sound else ("red", "not usable")
    console.print(f"model is {verdict}", style=colour)
