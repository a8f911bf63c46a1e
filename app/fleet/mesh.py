"""The mesh of an airframe for pictures: read from the bulk data, nothing is assembled."""

from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from app.artefacts.container import Container, NamedArray, pack, unpack
from app.fleet.registry import RegisteredAircraft
from solver.aircraft.definition import Zone
from solver.aircraft.nastran import read_bulk_data
from solver.fe.model import FiniteElementModel


def mesh_bytes(aircraft: RegisteredAircraft) -> bytes:
    """Packed mesh; the same hash is always the same bytes."""
    return _mesh_bytes(aircraft.content_hash, aircraft.bulk_data, aircraft.definition.zones)


@lru_cache(maxsize=8)
def _mesh_bytes(content_hash: str, bulk_data: Path, zones: tuple[Zone, ...]) -> bytes:
    model = read_bulk_data(bulk_data).model
    return pack(
        [
            NamedArray("node", model.node_identifiers.astype(np.int32)),
            NamedArray("coordinates", model.coordinates.astype(np.float32), "m"),
            NamedArray("quads", model.quads.nodes.astype(np.int32).reshape(-1, 4)),
            NamedArray("triangles", model.triangles.nodes.astype(np.int32).reshape(-1, 3)),
            NamedArray("beams", model.beams.nodes.astype(np.int32).reshape(-1, 2)),
            NamedArray("element", model.element_identifiers.astype(np.int32)),
            NamedArray("zone", _zone_rows(model, zones)),
        ],
        {"model_hash": content_hash, "zones": [zone.name for zone in zones]},
    )


def mesh(aircraft: RegisteredAircraft) -> Container:
    return unpack(mesh_bytes(aircraft))


def _zone_rows(model: FiniteElementModel, zones: tuple[Zone, ...]) -> NDArray[np.int16]:
    rows = np.full(len(model.element_properties), -1, dtype=np.int16)
    for row, zone in enumerate(zones):
        rows[zone.properties.contains(model.element_properties)] = row
    return rows
