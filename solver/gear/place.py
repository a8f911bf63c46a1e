"""Where a gear sits on the aircraft, by its pivot."""

from collections.abc import Sequence
from enum import StrEnum

from solver.gear.parameters import Gear

#: A gear nearer to the plane of symmetry is on it [m].
_MIDDLE = 0.2


class Place(StrEnum):
    """Where a gear sits."""

    LEFT = "left"
    RIGHT = "right"
    NOSE = "nose"


def place_of(gear: Gear, gears: Sequence[Gear]) -> Place:
    """Place of one of an aircraft's gears; the nose's is the foremost and in the middle."""
    foremost = min(float(each.pivot[0]) for each in gears)
    if abs(gear.pivot[1]) < _MIDDLE and gear.pivot[0] == foremost:
        return Place.NOSE
    return Place.LEFT if gear.pivot[1] < 0 else Place.RIGHT
