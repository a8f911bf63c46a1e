"""Properties of the example aircraft: one for each bay and side of each family of parts.

Port and starboard bays have properties of their own, so that a zone has a side, but share one
gauge.  Gauges come from the sizing table where it has the bay, else from the family.
"""

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from solver.aircraft.bizjet.families import FAMILIES, FAMILY, MATERIALS, Family
from solver.aircraft.nastran_sections import section_property
from solver.arrays import Array
from solver.fe.model import BeamProperty, Material, ShellProperty

#: The result of `solver.sizing.iteration`.
SIZED = Path(__file__).with_name("sized.toml")

SIDES = ("centre", "port", "starboard")
#: Least depth squared over area of a section; at 2 its walls would be solid.
LEAST_HOLLOW = 2.6
_PER_FAMILY, _PER_SIDE = 10_000, 1_000


@dataclass(frozen=True, slots=True)
class Bay:
    """What port and starboard have in common: the unit of sizing."""

    family: str
    label: str

    def __str__(self) -> str:
        return f"{self.family} / {self.label}"


@dataclass
class Catalogue:
    """Allots property identifiers to bays and makes their cards."""

    gauges: Mapping[Bay, float] = field(default_factory=dict)
    labels: dict[str, dict[str, int]] = field(default_factory=dict)
    used: dict[int, Bay] = field(default_factory=dict)

    @property
    def materials(self) -> dict[int, Material]:
        """MAT1 cards."""
        return {material.identifier: material for _, material, _ in MATERIALS}

    def property(self, family: str, label: str, centre: Array) -> int:
        """Property identifier of a part whose element lies around ``centre`` (3,)."""
        bays = self.labels.setdefault(family, {})
        bay = bays.setdefault(label, len(bays) + 1)
        side = 0 if abs(centre[1]) < 1e-4 else (1 if centre[1] < 0 else 2)
        index = FAMILIES.index(FAMILY[family])
        identifier = (index + 1) * _PER_FAMILY + side * _PER_SIDE + bay
        self.used[identifier] = Bay(family, label)
        return identifier

    def gauge(self, bay: Bay) -> float:
        """Thickness [m] or area [m2] of a bay."""
        return self.gauges.get(bay, FAMILY[bay.family].gauge)

    def shell_properties(self) -> dict[int, ShellProperty]:
        """PSHELL cards of every bay made of shells."""
        return {
            number: ShellProperty(number, FAMILY[bay.family].material, self.gauge(bay))
            for number, bay in sorted(self.used.items())
            if not FAMILY[bay.family].is_beam
        }

    def beam_properties(self) -> dict[int, BeamProperty]:
        """PBAR cards of every bay made of beams."""
        return {
            number: beam_property(number, FAMILY[bay.family], self.gauge(bay))
            for number, bay in sorted(self.used.items())
            if FAMILY[bay.family].is_beam
        }

    def zone_ranges(self) -> dict[tuple[str, str], tuple[int, int]]:
        """Property identifiers, first and last, of each family and side that is used."""
        ranges: dict[tuple[str, str], tuple[int, int]] = {}
        for number, bay in sorted(self.used.items()):
            key = (bay.family, SIDES[number % _PER_FAMILY // _PER_SIDE])
            first, _ = ranges.get(key, (number, number))
            ranges[key] = (first, number)
        return ranges


def beam_property(identifier: int, family: Family, area: float) -> BeamProperty:
    """I section of a given area: the family's depth, flanges half as wide, one wall all round.

    Area grows by thicker walls.  A section that deepened with its area would draw more bending
    where the structure around it imposes a curvature, and sizing would chase itself; it deepens
    only where the walls would fill it.
    """
    depth = max(family.depth, math.sqrt(LEAST_HOLLOW * area))
    wall = (depth - math.sqrt(depth**2 - 2 * area)) / 2  # 2 wall (depth - wall) = area
    dimensions = (depth, depth / 2, depth / 2, wall, wall, wall)
    return section_property(
        identifier, family.material, "I", [round(value, 7) for value in dimensions]
    )


def read_gauges(path: Path = SIZED) -> dict[Bay, float]:
    """Gauges of the sizing table, thickness [m] or area [m2]; empty where there is no table."""
    if not path.exists():
        return {}
    table = tomllib.loads(path.read_text())
    gauges: dict[Bay, float] = {}
    for unit, scale in (("thickness_mm", 1e-3), ("area_mm2", 1e-6)):
        for family, bays in table.get(unit, {}).items():
            gauges |= {Bay(family, label): value * scale for label, value in bays.items()}
    return gauges


def write_gauges(gauges: Mapping[Bay, float], path: Path = SIZED) -> None:
    """Write the sizing table, in the order of the families and labels."""
    order = {family.name: k for k, family in enumerate(FAMILIES)}
    lines = [
        "# Gauges of the example aircraft EBJ-19, bay by bay; port and starboard are alike.",
        "# Written by `python -m solver.sizing`; docs/example-aircraft.md says how.",
    ]
    for unit, scale, beams in (("thickness_mm", 1e3, False), ("area_mm2", 1e6, True)):
        for name in order:
            bays = {bay.label: value for bay, value in gauges.items() if bay.family == name}
            if not bays or FAMILY[name].is_beam != beams:
                continue
            lines += ["", f'[{unit}."{name}"]']
            lines += [f'"{label}" = {bays[label] * scale:.3f}' for label in sorted(bays)]
    path.write_text("\n".join(lines) + "\n")
