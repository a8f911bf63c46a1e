"""A window as a file in long form, which `read_window` takes back."""

import csv
import io

from solver.flight_data.parameter import KINDS
from solver.flight_data.window import Window
from solver.units import Dimension

_UNITS = {
    Dimension.LOAD_FACTOR: "g",
    Dimension.LENGTH: "m",
    Dimension.SPEED: "m/s",
    Dimension.ANGLE: "rad",
    Dimension.MASS: "kg",
    None: "1",
}


def long_form(window: Window) -> str:
    """Comma-separated text: time, parameter, value and unit of every sample at its native rate."""
    rows = [
        (time, _name(channel.parameter, channel.source), value, unit)
        for channel in window.channels
        for unit in (_UNITS[KINDS[channel.parameter].dimension],)
        for time, value in zip(channel.time.tolist(), channel.value.tolist(), strict=True)
    ]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("t_s", "param", "value", "unit"))
    writer.writerows((f"{t:.6f}", name, f"{v:.9g}", unit) for t, name, v, unit in sorted(rows))
    return text.getvalue()


def _name(parameter: str, source: str) -> str:
    # Our own names carry our own signs, which some of the trade's names do not.
    return f"hl_{parameter} ({source})" if source else f"hl_{parameter}"
