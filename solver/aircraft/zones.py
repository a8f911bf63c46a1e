"""Zones: which piece of the airframe an element belongs to, and what it may carry at limit load."""

import numpy as np

from solver.aircraft.definition import AircraftDefinition
from solver.arrays import Array, IntArray
from solver.errors import ModelError
from solver.fe.model import FiniteElementModel


def element_zones(model: FiniteElementModel, definition: AircraftDefinition) -> IntArray:
    """Index into ``definition.zones`` for every stressed element (ne,), in the solver's order.

    Raises
    ------
    ModelError
        An element belongs to no zone or to two, or a zone holds no element.
    """
    properties = model.element_properties
    zones = np.full(len(properties), -1, dtype=np.int64)
    for index, zone in enumerate(definition.zones):
        inside = zone.properties.contains(properties)
        if not np.any(inside):
            raise ModelError(f"zone {zone.name!r}: no element has a property in {zone.properties}")
        taken = inside & (zones >= 0)
        if np.any(taken):
            first = int(np.argmax(taken))
            raise ModelError(
                f"element {model.element_identifiers[first]} (property {properties[first]}) "
                f"belongs to zones {definition.zones[zones[first]].name!r} and {zone.name!r}"
            )
        zones[inside] = index
    outside = zones < 0
    if np.any(outside):
        listed = ", ".join(str(identifier) for identifier in np.unique(properties[outside])[:10])
        raise ModelError(
            f"{int(np.sum(outside))} elements belong to no zone; their properties: {listed}"
        )
    return zones


def element_allowables(
    model: FiniteElementModel, definition: AircraftDefinition, zones: IntArray
) -> Array:
    """Limit allowable of every stressed element (ne,) [Pa]: its zone's, else its material's.

    Raises
    ------
    ModelError
        An element has neither.
    """
    materials = {material.identifier: material for material in definition.materials}
    shells = len(model.quads.identifiers) + len(model.triangles.identifiers)
    properties = model.element_properties
    allowables = np.empty(len(properties))
    is_beam = np.arange(len(properties)) >= shells
    keys = np.stack([zones, properties, is_beam.astype(np.int64)], axis=1)
    for zone_index, property_identifier, beam in np.unique(keys, axis=0).tolist():
        zone = definition.zones[zone_index]
        value = zone.beam_limit_allowable if beam else zone.shell_limit_allowable
        if value is None:
            known = model.beam_properties if beam else model.shell_properties
            material = known[property_identifier].material
            if material not in materials:
                raise ModelError(
                    f"zone {zone.name!r}: property {property_identifier} is of MAT1 {material}, "
                    "for which neither [[materials]] nor the zone gives a limit allowable"
                )
            value = materials[material].limit_allowable
        allowables[np.all(keys == (zone_index, property_identifier, beam), axis=1)] = value
    return allowables


def element_centroids(model: FiniteElementModel) -> Array:
    """Mean corner position of every stressed element (ne, 3) [m]; beams with their offsets."""
    at = model.coordinates
    return np.concatenate(
        [
            at[model.quads.nodes].mean(axis=1).reshape(-1, 3),
            at[model.triangles.nodes].mean(axis=1).reshape(-1, 3),
            (at[model.beams.nodes] + model.beams.offsets).mean(axis=1).reshape(-1, 3),
        ]
    )
