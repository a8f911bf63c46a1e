"""`hardlanding assess`: the whole chain on one record, without a server."""

import json
import math
from dataclasses import fields, replace
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.table import Table

from app.cli.progress import STANDARD_ERROR, progress_bars
from app.config import get_settings
from app.landings.field_errors import InvalidRecordError
from app.landings.intake import read_record_file
from solver.assess import assess_landing, load_assessment_model
from solver.assessment import Assessment, RuleDifference, RuleStatus, RuleVerdict, Verdict
from solver.errors import SolverError

COLOURS = {
    Verdict.NORMAL: "green",
    Verdict.FIRM: "cyan",
    Verdict.INSPECT: "yellow",
    Verdict.HARD: "red",
    Verdict.UNDETERMINED: "magenta",
}

#: Arrays that have commands and endpoints of their own.
_LEFT_OUT = ("peak_field", "histories")


def assess(
    record: Annotated[Path, typer.Argument(help="Touchdown record, as it would be posted.")],
    as_json: Annotated[bool, typer.Option("--json", help="Only JSON on standard output.")] = False,
    aircraft_dir: Annotated[
        Path | None, typer.Option(help="Folder of aircraft folders (default: HL_AIRCRAFT_DIR).")
    ] = None,
) -> None:
    """Assess one landing from its record."""
    settings = get_settings()
    folder = aircraft_dir or settings.aircraft_folder
    try:
        intake = read_record_file(record, folder)
        with progress_bars() as progress:
            model = load_assessment_model(
                folder / intake.record.aircraft, settings.cache_folder, progress
            )
            landing = intake.record
            if not settings.propagate_uncertainty:
                landing = replace(landing, uncertainties=())
            assessment = assess_landing(model, landing, progress)
    except (InvalidRecordError, SolverError, OSError) as error:
        STANDARD_ERROR.print(str(error), style="red", markup=False)
        raise typer.Exit(2) from error
    if as_json:
        typer.echo(json.dumps(document(assessment), indent=1))
    else:
        show(assessment, Console())


def document(assessment: Assessment) -> dict[str, Any]:
    """Turn an assessment without its arrays into plain JSON values."""
    named = {
        field.name: _plain(getattr(assessment, field.name))
        for field in fields(assessment)
        if field.name not in _LEFT_OUT
    }
    return named | {"probability_limit_exceeded": assessment.probability_limit_exceeded}


def _plain(value: Any) -> Any:
    if hasattr(value, "__dataclass_fields__"):
        return {field.name: _plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value


#: How the two verdicts stand to each other, in words for the action line.
_DIFFERENCES = {
    RuleDifference.AGREE: "stress verdict and maker's rule agree",
    RuleDifference.STRESS_STRICTER: "the stress verdict is stricter than the maker's rule",
    RuleDifference.RULE_STRICTER: "the maker's rule is stricter than the stress verdict",
    RuleDifference.RULE_CANNOT_TELL: "the maker's rule cannot tell; the stress verdict is alone",
    RuleDifference.NO_RULE: "the aircraft's definition names no maker's rule",
}

_STATUS_WORDS = {
    RuleStatus.PASSED: "passed",
    RuleStatus.EXCEEDED: "exceeded",
    RuleStatus.CANNOT_TELL: "cannot tell",
}


def _show_action(assessment: Assessment, console: Console) -> None:
    colour = COLOURS[assessment.action]
    difference = _DIFFERENCES[assessment.rule_difference]
    console.print(f"action [bold {colour}]{assessment.action}[/]: {difference}")
    rule: RuleVerdict | None = assessment.makers_rule
    if rule is not None:
        console.print(f"maker's rule, {rule.title}: {_STATUS_WORDS[rule.status]}", markup=False)
        for finding in rule.findings:
            status = _STATUS_WORDS[finding.status]
            console.print(f"  {status}: {finding.text}", markup=False)


def show(assessment: Assessment, console: Console) -> None:
    """Print what an engineer wants first: verdict, reasons, where to look, gear loads."""
    colour = COLOURS[assessment.verdict]
    console.print(f"\n[bold {colour}]{assessment.verdict}[/]", end="  ")
    console.print(
        f"worst utilisation {assessment.worst_utilisation:.0%}, "
        f"normal load factor {assessment.peak_normal_load_factor:.2f} g"
    )
    for reason in assessment.reasons:
        console.print(f"  {reason.verdict}: {reason.text}", markup=False)
    _show_action(assessment, console)
    spots = Table(title="Where to look", title_justify="left")
    for heading in ("zone", "side", "element", "stress MPa", "used", "P", "time s", "ATA"):
        spots.add_column(heading)
    for spot in assessment.hot_spots:
        spots.add_row(
            f"{spot.component}: {spot.zone}",
            spot.side,
            f"{spot.element_kind} {spot.element}",
            f"{spot.peak_stress / 1e6:.0f}",
            f"{spot.utilisation:.0%}",
            ""
            if spot.probability_limit_exceeded is None
            else f"{spot.probability_limit_exceeded:.0%}",
            f"{spot.time:.3f}",
            spot.ata_chapter,
        )
    console.print(spots)
    gears = Table(title="Gear loads", title_justify="left")
    for heading in ("gear", "contact", "vertical kN", "drag kN", "side kN", "stroke mm", "used"):
        gears.add_column(heading)
    for load in assessment.gear_loads:
        gears.add_row(
            load.gear,
            str(load.contact + 1),
            f"{load.vertical_force / 1e3:.1f}",
            f"{load.drag_force / 1e3:.1f}",
            f"{load.side_force / 1e3:.1f}",
            f"{load.stroke * 1e3:.0f}",
            f"{load.utilisation:.0%}",
        )
    console.print(gears)
    for note in assessment.notes:
        console.print(f"note: {note}", markup=False)
    timing = assessment.timing
    console.print(
        f"energy closes to {assessment.energy_error:.1e}, loads balance to "
        f"{assessment.equilibrium_residual:.1e}; simulation {timing.simulation * 1e3:.0f} ms, "
        f"airframe {timing.reduced_solution * 1e3:.0f} ms, peaks {timing.peak_search * 1e3:.0f} ms"
    )
    console.print(
        f"model {assessment.model_hash[:12]}, program {assessment.program_version}", markup=False
    )
    console.print(assessment.advisory)
