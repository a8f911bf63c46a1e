"""`hardlanding simulate`: the landing simulation alone, without the airframe's stresses."""

import csv as csv_format
import json as json_format
from dataclasses import fields
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from app.cli.input_file import read_input, refuse
from app.cli.landing_file import LandingFile
from app.cli.progress import progress_bars
from app.config import get_settings
from solver.errors import RecordError, SolverError
from solver.landing.aircraft import LandingAircraft
from solver.landing.compilation import compile_kernels
from solver.landing.history import LandingHistory
from solver.landing.peaks import GearPeaks, gear_peaks, refined_peak
from solver.landing.simulate import simulate_landing
from solver.progress import Progress

UNITS = {
    "vertical_force": "n",
    "drag_force": "n",
    "forward_force": "n",
    "side_force": "n",
    "strut_force": "n",
    "pivot_drag_force": "n",
    "pivot_forward_force": "n",
    "stroke": "m",
    "tyre_deflection": "m",
    "wheel_speed": "rad_s",
}


def simulate(
    landing: Annotated[Path, typer.Argument(help="JSON file with contact, lift and aircraft.")],
    json: Annotated[bool, typer.Option("--json", help="Only JSON on standard output.")] = False,
    csv: Annotated[Path | None, typer.Option("--csv", help="Write the histories here.")] = None,
) -> None:
    """Simulate one landing and print gear loads, contacts and energy."""
    given = read_input(landing, LandingFile)
    try:
        with progress_bars() as progress:
            aircraft = landing_aircraft(given, progress)
            progress("compiling the kernels", 0.0)  # takes a while once on every machine
            compile_kernels()
            progress("compiling the kernels", 1.0)
        history = simulate_landing(aircraft, given.landing_contact(), given.options.options())
        if csv is not None:
            write_histories(csv, history)
    except (SolverError, OSError) as error:
        refuse(str(error), error)
    if json:
        typer.echo(json_format.dumps(document(aircraft, history), indent=1))
    else:
        show(history, Console())


def landing_aircraft(given: LandingFile, progress: Progress) -> LandingAircraft:
    """Aircraft of the file, or of the folder it names."""
    if given.aircraft_description is not None:
        return given.aircraft_description.aircraft()
    from solver.aircraft.airframe import load_airframe

    folder = get_settings().aircraft_folder
    if not (folder / given.aircraft).is_dir():
        known = sorted(path.name for path in folder.iterdir()) if folder.is_dir() else []
        raise RecordError(f"aircraft: unknown {given.aircraft!r}; known: {', '.join(known) or '-'}")
    airframe = load_airframe(folder / given.aircraft, progress)
    loading = airframe.loading_for(mass=given.mass, fuel=given.fuel, payload=given.payload)
    return airframe.landing_aircraft(loading.factors)


def document(aircraft: LandingAircraft, history: LandingHistory) -> dict[str, Any]:
    """Plain JSON values, units in the key names."""
    energy = history.energy
    factor_time, factor = refined_peak(history.time, history.normal_load_factor)
    final = {
        f"{field.name}_j": float(getattr(energy, field.name)[-1] - getattr(energy, field.name)[0])
        for field in fields(energy)
        if field.name not in ("impact_energy", "closure_error")
    }
    return {
        "outcome": str(history.outcome),
        "duration_s": float(history.time[-1]),
        "mass_kg": aircraft.total_mass,
        "gears": {peaks.gear: _peaks(peaks) for peaks in gear_peaks(history)},
        "peak_normal_load_factor_g": factor,
        "peak_normal_load_factor_time_s": factor_time,
        "largest_pitch_acceleration_rad_s2": float(np.max(history.rate_derivative[:, 1])),
        "smallest_pitch_acceleration_rad_s2": float(np.min(history.rate_derivative[:, 1])),
        "largest_roll_acceleration_rad_s2": float(np.max(np.abs(history.rate_derivative[:, 0]))),
        "contacts": [
            {
                "gear": contact.gear,
                "start_s": contact.start,
                "end_s": contact.end,
                "peak_ground_force_n": contact.peak_ground_force,
                "peak_time_s": contact.peak_time,
                "peak_strut_force_n": contact.peak_strut_force,
                "peak_stroke_m": contact.peak_stroke,
                "closure_speed_m_s": contact.closure_speed,
            }
            for contact in history.contacts
        ],
        "energy": {
            "impact_energy_j": energy.impact_energy,
            "closure_error": energy.closure_error,
            "change_over_the_run": final,
        },
    }


def _peaks(peaks: GearPeaks) -> dict[str, float]:
    values = {}
    for name, unit in UNITS.items():
        peak = getattr(peaks, name)
        values[f"peak_{name}_{unit}"] = peak.value
        values[f"peak_{name}_time_s"] = peak.time
    return values


def write_histories(path: Path, history: LandingHistory) -> None:
    """Histories as comma-separated values, one row per instant."""
    columns: dict[str, Any] = {"time_s": history.time}
    for index, axis in enumerate("xyz"):
        columns[f"acceleration_{axis}_m_s2"] = history.acceleration[:, index]
        columns[f"rate_{axis}_rad_s"] = history.rate[:, index]
    columns["normal_load_factor_g"] = history.normal_load_factor
    for gear in history.gears:
        for index, axis in enumerate("xyz"):
            columns[f"{gear.name}_ground_force_{axis}_n"] = gear.ground_force[:, index]
        columns[f"{gear.name}_strut_force_n"] = gear.strut_force
        columns[f"{gear.name}_stroke_m"] = gear.stroke
        columns[f"{gear.name}_tyre_deflection_m"] = gear.tyre_deflection
        columns[f"{gear.name}_wheel_speed_rad_s"] = gear.wheel_speed
        columns[f"{gear.name}_bending_angle_rad"] = gear.bending_angle
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv_format.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*(column.tolist() for column in columns.values()), strict=True))


def show(history: LandingHistory, console: Console) -> None:
    """Print the peaks for a reader."""
    table = Table(title="Gear loads", title_justify="left")
    for heading in ("gear", "vertical kN", "at s", "drag kN", "side kN", "strut kN", "stroke mm"):
        table.add_column(heading)
    for peaks in gear_peaks(history):
        table.add_row(
            peaks.gear,
            f"{peaks.vertical_force.value / 1e3:.2f}",
            f"{peaks.vertical_force.time:.4f}",
            f"{peaks.drag_force.value / 1e3:.2f}",
            f"{peaks.side_force.value / 1e3:.2f}",
            f"{peaks.strut_force.value / 1e3:.2f}",
            f"{peaks.stroke.value * 1e3:.1f}",
        )
    console.print(table)
    contacts = Table(title="Contacts", title_justify="left")
    for heading in ("gear", "from s", "to s", "closing m/s", "vertical kN", "stroke mm"):
        contacts.add_column(heading)
    for contact in history.contacts:
        contacts.add_row(
            contact.gear,
            f"{contact.start:.4f}",
            "-" if contact.end is None else f"{contact.end:.4f}",
            f"{contact.closure_speed:.2f}",
            f"{contact.peak_ground_force / 1e3:.2f}",
            f"{contact.peak_stroke * 1e3:.1f}",
        )
    console.print(contacts)
    console.print(
        f"{history.outcome} after {history.time[-1]:.2f} s; normal load factor up to "
        f"{np.max(history.normal_load_factor):.2f} g; energy closes to "
        f"{history.energy.closure_error:.1e} of the impact energy"
    )
