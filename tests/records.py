"""Touchdown records for the tests."""

import copy
from typing import Any


def record(sink_rate: float = 6.0, **fields: Any) -> dict[str, Any]:
    """A complete record of one symmetrical contact; sink rate in ft/s."""
    return {
        "aircraft": {"model_id": "mini", "tail_token": "T-0142"},
        "mass": {
            "gross_weight": {"value": 25_000, "unit": "lb", "sd": 250},
            "cg": {"value": 24.0, "unit": "%MAC", "sd": 2.0},
        },
        "contacts": [contact(sink_rate)],
        **fields,
    }


def contact(sink_rate: float = 6.0, **fields: Any) -> dict[str, Any]:
    return {
        "sink_rate": {"value": sink_rate, "unit": "ft/s", "sd": 1.0},
        "ground_speed": {"value": 120.0, "unit": "kt"},
        "pitch": {"value": 3.0, "unit": "deg"},
        "roll": {"value": 0.0, "unit": "deg"},
        **fields,
    }


def changed(path: str, value: Any) -> dict[str, Any]:
    """A good record with one place changed: ``contacts.0.pitch.value``."""
    document = copy.deepcopy(record())
    *parents, last = path.split(".")
    place: Any = document
    for name in parents:
        place = place[int(name)] if isinstance(place, list) else place.setdefault(name, {})
    if isinstance(place, list):
        place[int(last)] = value
    else:
        place[last] = value
    return document
