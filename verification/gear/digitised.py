"""Curves digitised from NACA Report 1154; ``verification/digitised/README.md`` describes them."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from solver.arrays import Array
from verification.gear.naca1154 import FOOT, POUND_FORCE
from verification.run import ROOT

FOLDER = ROOT / "verification" / "digitised"

#: Column names and their factor to SI units, for each curve.
COLUMNS = {
    "force": {"ground_force_n": 1.0, "ground_force_lb": POUND_FORCE},
    "stroke": {"stroke_m": 1.0, "stroke_in": FOOT / 12, "stroke_ft": FOOT},
}


@dataclass(frozen=True, slots=True)
class DigitisedCurve:
    """Points read off a figure, SI units."""

    quantity: str  #: "force" or "stroke"
    time: Array  #: (n,) ascending [s]
    value: Array  #: (n,) [N] or [m]

    def difference(self, time: Array, value: Array) -> float:
        """Root mean square of the distance from a computed curve, over the points' largest."""
        inside = (self.time >= time[0]) & (self.time <= time[-1])
        computed = np.interp(self.time[inside], time, value)
        distance = computed - self.value[inside]
        return float(np.sqrt(np.mean(distance**2)) / np.max(np.abs(self.value)))


def digitised_curves(folder: Path = FOLDER) -> tuple[DigitisedCurve, ...]:
    """Curves whose files are there.

    Raises
    ------
    ValueError
        A file has other columns than the description asks for, no two points, or times that do
        not ascend.
    """
    paths = ((quantity, folder / f"naca1154-{quantity}.csv") for quantity in COLUMNS)
    return tuple(_read(quantity, path) for quantity, path in paths if path.exists())


def _read(quantity: str, path: Path) -> DigitisedCurve:
    lines = [line for line in path.read_text().splitlines() if line and line[0] != "#"]
    rows = list(csv.reader(lines))
    header = [name.strip() for name in rows[0]] if rows else []
    factors = COLUMNS[quantity]
    if len(header) != 2 or header[0] != "time_s" or header[1] not in factors:
        raise ValueError(
            f"{path}: the columns must be time_s and one of {', '.join(factors)}, got {header}"
        )
    points = np.array([[float(cell) for cell in row] for row in rows[1:]])
    if len(points) < 2 or np.any(np.diff(points[:, 0]) <= 0):
        raise ValueError(f"{path}: two points or more with ascending times are needed")
    return DigitisedCurve(quantity, points[:, 0], points[:, 1] * factors[header[1]])
