"""The arrays of an assessment that are kept: every element's peak, and histories per contact."""

import numpy as np
from numpy.typing import NDArray

from app.artefacts.container import NamedArray, pack
from solver.arrays import Array
from solver.assessment import PeakField
from solver.landing.history import GearHistory, LandingHistory

PEAK_FIELD = "peak-field"

_AXES = ("x", "y", "z")


def history_kind(contact: int) -> str:
    return f"history-{contact}"


def _single(values: Array) -> NDArray[np.float32]:
    # Seven digits are more than any input has.
    return values.astype(np.float32)


def pack_peak_field(field: PeakField) -> bytes:
    return pack(
        [
            NamedArray("element", field.element_identifiers.astype(np.int32)),
            NamedArray("stress", _single(field.stress), "Pa"),
            NamedArray("utilisation", _single(field.utilisation)),
            NamedArray("time", _single(field.time), "s"),
            NamedArray("contact", field.contact.astype(np.int16)),
        ]
    )


def pack_history(history: LandingHistory) -> bytes:
    """Curves an engineer looks at; pin loads can be recomputed from the stored inputs."""
    arrays = [NamedArray("time", _single(history.time), "s")]
    arrays += _columns("acceleration", history.acceleration, "m/s2")
    arrays += _columns("rate", history.rate, "rad/s")
    arrays.append(NamedArray("normal_load_factor", _single(history.normal_load_factor), "g"))
    for gear in history.gears:
        arrays += _gear(gear)
    energy = history.energy
    arrays += [
        NamedArray(f"energy.{name}", _single(getattr(energy, name)), "J")
        for name in (
            "kinetic", "potential", "gas", "tyre", "strut_bending", "stops",
            "dissipated_hydraulic", "dissipated_tyre", "dissipated_other", "lift_work",
        )
    ]  # fmt: skip
    contacts = [
        {
            "gear": contact.gear,
            "start": contact.start,
            "end": contact.end,
            "peak_ground_force": contact.peak_ground_force,
            "peak_time": contact.peak_time,
            "peak_stroke": contact.peak_stroke,
            "closure_speed": contact.closure_speed,
        }
        for contact in history.contacts
    ]
    return pack(arrays, {"outcome": str(history.outcome), "ground_contacts": contacts})


def _gear(gear: GearHistory) -> list[NamedArray]:
    arrays = [
        NamedArray(f"{gear.name}.{name}", _single(getattr(gear, name)), unit)
        for name, unit in (
            ("strut_force", "N"),
            ("stroke", "m"),
            ("stroke_rate", "m/s"),
            ("tyre_deflection", "m"),
            ("wheel_speed", "rad/s"),
            ("bending_angle", "rad"),
        )
    ]
    return arrays + _columns(f"{gear.name}.ground_force", gear.ground_force, "N")


def _columns(name: str, values: Array, unit: str) -> list[NamedArray]:
    return [
        NamedArray(f"{name}.{axis}", _single(values[:, column]), unit)
        for column, axis in enumerate(_AXES)
    ]
