"""`hardlanding flight-data`: what is understood of a recorder window, without a server."""

import json
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from app.cli.flight_data_response import response_document, show_responses
from app.cli.input_file import refuse
from app.cli.progress import progress_bars
from app.config import get_settings
from app.flight_data.intake import recorded_mass
from app.landings.quantities import RunwayFriction
from solver.assimilation.assimilate import Assimilation, assimilate, uncorrected
from solver.assimilation.parameters import ServiceScatter
from solver.errors import FlightDataError, RecordError, SolverError
from solver.flight_data.frame import RecorderFrame
from solver.flight_data.frame_file import packaged_frame, read_frame
from solver.flight_data.geometry import aircraft_geometry, point_geometry
from solver.flight_data.reading import read_window
from solver.flight_data.reconstruction import FoundContact, Reconstruction, reconstruct
from solver.flight_data.touchdown import Estimate
from solver.flight_data.window import Window
from solver.landing.aircraft import LandingAircraft

#: Unit of each component of a state, as its key says it.
UNITS = {
    "sink_rate": "m_s",
    "pitch": "rad",
    "roll": "rad",
    "drift": "rad",
    "ground_speed": "m_s",
    "pitch_rate": "rad_s",
    "roll_rate": "rad_s",
    "yaw_rate": "rad_s",
    "lift_fraction": "1",
}


def flight_data(
    file: Annotated[Path, typer.Argument(help="Recorder window: CSV, or Parquet with its extra.")],
    as_json: Annotated[bool, typer.Option("--json", help="Only JSON on standard output.")] = False,
    plot: Annotated[
        Path | None, typer.Option(help="Draw the window and what was found (SVG, PNG or PDF).")
    ] = None,
    frame: Annotated[
        str | None, typer.Option(help="Recorder frame: a packaged name, or a TOML file.")
    ] = None,
    aircraft: Annotated[
        str | None, typer.Option(help="Aircraft folder's name, for heights and gears.")
    ] = None,
    runway_friction: Annotated[
        float | None, typer.Option(min=0.05, max=1.2, help="Largest coefficient, as measured.")
    ] = None,
    runway_friction_sd: Annotated[
        float, typer.Option(min=0.0, max=0.5, help="Its standard deviation.")
    ] = RunwayFriction.default_sd,
) -> None:
    """Show what a recorder window holds: channels, contacts, states, or why it cannot tell."""
    try:
        window = read_window(file, _frame(frame))
        simulated = _aircraft(aircraft, window)
    except FlightDataError as error:
        refuse(f"{file}: {error}", error)
    except (SolverError, OSError) as error:
        refuse(str(error), error)
    if simulated is not None and runway_friction is not None:
        real, scatter = simulated
        simulated = (
            real.on_runway(runway_friction),
            scatter.on_runway(runway_friction, runway_friction_sd),
        )
    geometry = point_geometry() if simulated is None else aircraft_geometry(simulated[0])
    found = reconstruct(window, geometry)
    responses = (
        uncorrected(found, "no --aircraft to simulate")
        if simulated is None
        else assimilate(window, found, simulated[0], geometry, scatter=simulated[1])
    )
    if plot is not None:
        _draw(plot, window, found)
    if as_json:
        typer.echo(json.dumps(document(window, found, aircraft, responses), indent=1))
    else:
        console = Console()
        show(window, found, aircraft, console)
        show_responses(responses, console)


def _frame(name: str | None) -> RecorderFrame | None:
    if name is None:
        return None
    path = Path(name)
    return read_frame(path) if path.suffix == ".toml" else packaged_frame(name)


def _aircraft(
    aircraft: str | None, window: Window
) -> tuple[LandingAircraft, ServiceScatter] | None:
    """Aircraft in the loading of the window, and how much one in service may differ from it."""
    if aircraft is None:
        return None
    from solver.aircraft.airframe import load_airframe

    folder = get_settings().aircraft_folder / aircraft
    if not folder.is_dir():
        raise RecordError(f"no aircraft {aircraft!r} in {folder.parent}")
    with progress_bars() as progress:
        airframe = load_airframe(folder, progress)
    loading = airframe.loading_for(mass=recorded_mass(window), fuel={}, payload={})
    scatter = ServiceScatter.stated(airframe.definition.scatter)
    return airframe.landing_aircraft(loading.factors), scatter


def _draw(path: Path, window: Window, found: Reconstruction) -> None:
    try:
        from app.cli.flight_data_plot import draw
    except ImportError as error:
        refuse("--plot needs matplotlib: pip install 'hardlanding[plot]'", error)
    try:
        draw(path, window, found)
    except (OSError, ValueError) as error:
        refuse(f"{path}: {error}", error)


def document(
    window: Window, found: Reconstruction, aircraft: str | None, responses: Assimilation
) -> dict[str, Any]:
    """Plain JSON values, units in the key names."""
    return {
        "frame": None if window.frame is None else window.frame.name,
        "aircraft": aircraft,
        "channels": [
            {
                "parameter": str(channel.parameter),
                "source": channel.source,
                "samples": len(channel.time),
                "rate_hz": channel.rate,
                "start_s": float(channel.time[0]),
                "end_s": float(channel.time[-1]),
            }
            for channel in window.channels
        ],
        "notes": [{"code": note.code, "text": note.text} for note in window.notes],
        "can_tell": not found.cannot_tell,
        "cannot_tell": [
            {"code": each.code, "reason": each.reason, "settled_by": each.settled_by}
            for each in found.cannot_tell
        ],
        "normal_acceleration_offset_g": found.datum.offset if found.datum else None,
        "contacts": [_contact(contact) for contact in found.contacts],
        "responses": [response_document(update) for update in responses.updates],
    }


def _contact(contact: FoundContact) -> dict[str, Any]:
    state = contact.state
    return {
        "kind": str(contact.kind),
        "nose_wheel_down": contact.nose_wheel_down,
        "time_s": contact.time,
        "time_sd_s": contact.time_sd,
        "chance": contact.chance,
        "gear": contact.gear,
        "indicators": [
            {
                "name": ballot.name,
                "time_s": ballot.time,
                "sd_s": ballot.sd,
                "agrees": bool(ballot.agrees),
            }
            for ballot in contact.timing.vote.ballots
        ],
        "state": {
            f"{name}_{unit}" if unit != "1" else name: _estimate(getattr(state, name))
            for name, unit in UNITS.items()
        },
        "gear_sink_rates_m_s": {
            gear: _estimate(estimate) for gear, estimate in state.gear_sink_rates.items()
        },
        "assumed": list(state.assumed),
    }


def _estimate(estimate: Estimate) -> dict[str, float | None]:
    return {
        key: float(value) if np.isfinite(value) else None
        for key, value in (("value", estimate.value), ("sd", estimate.sd))
    }


def show(window: Window, found: Reconstruction, aircraft: str | None, console: Console) -> None:
    """Print for a reader what was understood."""
    channels = Table(title="Channels", title_justify="left")
    for heading in ("parameter", "source", "samples", "rate Hz", "from s", "to s"):
        channels.add_column(heading)
    for channel in window.channels:
        channels.add_row(
            channel.parameter.replace("_", " "),
            channel.source,
            str(len(channel.time)),
            f"{channel.rate:.3g}",
            f"{channel.time[0]:.2f}",
            f"{channel.time[-1]:.2f}",
        )
    console.print(channels)
    for note in window.notes:
        console.print(f"note: {note.text}", markup=False)
    for each in found.cannot_tell:
        console.print(
            f"cannot tell: {each.reason}; would be settled by {each.settled_by}", markup=False
        )
    if found.contacts:
        console.print(_contacts_table(found))
        where = f"the gears of {aircraft}" if aircraft else "the accelerometer (no --aircraft)"
        console.print(f"sink rates at {where}; every figure with its standard deviation")


def _contacts_table(found: Reconstruction) -> Table:
    table = Table(title="Contacts", title_justify="left")
    headings = ("contact", "time s", "gear", "sink m/s", "at gears m/s", "pitch deg", "roll deg")
    for heading in (*headings, "drift deg", "ground m/s", "lift"):
        table.add_column(heading)
    for contact in found.contacts:
        state = contact.state
        gears = ", ".join(
            f"{gear} {estimate.value:.2f}±{estimate.sd:.2f}"
            for gear, estimate in state.gear_sink_rates.items()
        )
        table.add_row(
            contact.kind.replace("_", " ") + (", nose down" if contact.nose_wheel_down else ""),
            f"{contact.time:.3f}±{contact.time_sd:.3f}",
            contact.gear,
            _shown(state.sink_rate),
            gears,
            _shown(state.pitch, np.rad2deg(1.0)),
            _shown(state.roll, np.rad2deg(1.0)),
            _shown(state.drift, np.rad2deg(1.0)),
            _shown(state.ground_speed),
            _shown(state.lift_fraction),
        )
    return table


def _shown(estimate: Estimate, factor: float = 1.0) -> str:
    return f"{estimate.value * factor:.2f}±{estimate.sd * factor:.2f}"
