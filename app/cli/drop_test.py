"""`hardlanding drop-test`: the two-phase drop test of NACA Report 1154 from a parameter file."""

import csv as csv_format
import json as json_format
from pathlib import Path
from typing import Annotated

import typer
from pydantic import BaseModel, ConfigDict, Field
from rich.console import Console
from rich.table import Table

from app.cli.input_file import read_input, refuse
from solver.errors import SolverError
from solver.gear.drop_test import DropTestHistory, DropTestParameters, DropTestResult
from solver.gear.drop_test import drop_test as run_drop_test

#: Field of the solver and unit in the answer's key, in the answer's order.
ANSWER = {
    "breakout_time_s": "breakout_time",
    "peak_ground_force_n": "peak_ground_force",
    "peak_ground_force_time_s": "peak_ground_force_time",
    "maximum_stroke_m": "maximum_stroke",
    "maximum_stroke_time_s": "maximum_stroke_time",
    "peak_tyre_deflection_m": "peak_tyre_deflection",
    "maximum_closure_speed_m_s": "maximum_closure_speed",
    "peak_upper_acceleration_m_s2": "peak_upper_acceleration",
    "energy_error": "energy_error",
}

#: Columns of the history.
COLUMNS = {
    "time_s": "time",
    "upper_displacement_m": "upper_displacement",
    "tyre_deflection_m": "tyre_deflection",
    "stroke_m": "stroke",
    "closure_speed_m_s": "closure_speed",
    "ground_force_n": "ground_force",
    "strut_force_n": "strut_force",
    "upper_acceleration_m_s2": "upper_acceleration",
}


class DropTestFile(BaseModel):
    """Parameters of a drop test; the keys are those of the file."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)

    upper_mass_kg: Annotated[float, Field(gt=0, le=1e6)]
    lower_mass_kg: Annotated[float, Field(gt=0, le=1e5)]
    pneumatic_area_m2: Annotated[float, Field(gt=0, le=10)]
    hydraulic_area_m2: Annotated[float, Field(gt=0, le=10)]
    orifice_area_m2: Annotated[float, Field(gt=0, le=10)]
    discharge_coefficient: Annotated[float, Field(gt=0, le=2)]
    fluid_density_kg_m3: Annotated[float, Field(gt=0, le=1e4)]
    initial_gas_pressure_pa: Annotated[float, Field(gt=0, le=1e9)]
    initial_gas_volume_m3: Annotated[float, Field(gt=0, le=10)]
    polytropic_exponent: Annotated[float, Field(ge=0, le=3)]
    tyre_coefficient_n_per_m_r: Annotated[float, Field(gt=0, le=1e13)]
    tyre_exponent: Annotated[float, Field(ge=1, le=4)]
    lift_ratio: Annotated[float, Field(ge=0, le=3)]
    contact_speed_m_s: Annotated[float, Field(gt=0, le=50)]

    def parameters(self) -> DropTestParameters:
        """Parameters as the solver takes them."""
        return DropTestParameters(
            upper_mass=self.upper_mass_kg,
            lower_mass=self.lower_mass_kg,
            pneumatic_area=self.pneumatic_area_m2,
            hydraulic_area=self.hydraulic_area_m2,
            orifice_area=self.orifice_area_m2,
            discharge_coefficient=self.discharge_coefficient,
            fluid_density=self.fluid_density_kg_m3,
            initial_gas_pressure=self.initial_gas_pressure_pa,
            initial_gas_volume=self.initial_gas_volume_m3,
            polytropic_exponent=self.polytropic_exponent,
            tyre_coefficient=self.tyre_coefficient_n_per_m_r,
            tyre_exponent=self.tyre_exponent,
            lift_ratio=self.lift_ratio,
            contact_speed=self.contact_speed_m_s,
        )


def drop_test(
    parameters: Annotated[Path, typer.Argument(help="JSON file with the test's parameters.")],
    json: Annotated[bool, typer.Option("--json", help="Only JSON on standard output.")] = False,
    csv: Annotated[Path | None, typer.Option("--csv", help="Write the history here.")] = None,
) -> None:
    """Drop a landing gear and print its peaks."""
    given = read_input(parameters, DropTestFile).parameters()
    try:
        result = run_drop_test(given)
        if csv is not None:
            write_history(csv, result.history)
    except (SolverError, OSError) as error:
        refuse(str(error), error)
    if json:
        typer.echo(json_format.dumps(document(result), indent=1))
    else:
        show(given, result, Console())


def document(result: DropTestResult) -> dict[str, float | None]:
    """Plain values under the answer's keys; a time that never comes is null."""
    return {key: getattr(result, name) for key, name in ANSWER.items()}


def write_history(path: Path, history: DropTestHistory) -> None:
    """History as comma-separated values, one row per instant."""
    columns = [getattr(history, name) for name in COLUMNS.values()]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv_format.writer(file)
        writer.writerow(COLUMNS)
        writer.writerows(zip(*(column.tolist() for column in columns), strict=True))


def show(parameters: DropTestParameters, result: DropTestResult, console: Console) -> None:
    """Print the peaks for a reader."""

    def moment(time: float | None) -> str:
        return "-" if time is None else f"{time * 1e3:.2f} ms"

    broke_out = result.breakout_time is not None
    table = Table("", "peak", "at", title="Drop test", title_justify="left")
    table.add_row(
        "ground force",
        f"{result.peak_ground_force / 1e3:.3f} kN",
        moment(result.peak_ground_force_time),
    )
    table.add_row("tyre deflection", f"{result.peak_tyre_deflection * 1e3:.2f} mm", "")
    table.add_row(
        "stroke", f"{result.maximum_stroke * 1e3:.2f} mm", moment(result.maximum_stroke_time)
    )
    table.add_row("closure speed", f"{result.maximum_closure_speed:.4f} m/s", "")
    table.add_row("upper mass, upward", f"{result.peak_upper_acceleration:.3f} m/s2", "")
    console.print(table)
    if broke_out:
        console.print(f"strut breaks out at {moment(result.breakout_time)}")
    else:
        console.print("the strut's preload is never exceeded: it stays rigid")
    share = result.maximum_stroke / parameters.stroke_limit
    if share > 0.95:
        console.print(
            f"stroke uses {share:.1%} of the gas volume's {parameters.stroke_limit * 1e3:.1f} mm; "
            "a real strut would meet its stop",
            style="yellow",
        )
    console.print(f"energy closes to {result.energy_error:.1e} of the energy at contact")
