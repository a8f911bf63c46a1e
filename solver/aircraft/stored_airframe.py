"""The assessed airframe stored once and mapped by every process.

Reading the bulk data and assembling the structure takes seconds, on a large airframe tens of
seconds and gigabytes; an assessment needs neither once the reduced model is there.  What it needs
is stored under the hash of the aircraft's files and of the format, so that a changed file or a
changed program never finds another's arrays.
"""

import hashlib
from dataclasses import fields
from pathlib import Path

import numpy as np

from solver.aircraft.assessed_airframe import AssessedAirframe
from solver.aircraft.definition import AircraftDefinition
from solver.aircraft.definition_reader import content_hash, load_definition
from solver.aircraft.mass_states import LoadedGroup, MassMoments, MassStates
from solver.array_folder import map_array, read_head, write_array_folder
from solver.arrays import Array
from solver.errors import ModelError

#: Changes whenever the stored arrays change their meaning.
FORMAT = 1
_NOT_ARRAYS = ("definition", "content_hash", "mass_states")
_ARRAYS = tuple(field.name for field in fields(AssessedAirframe) if field.name not in _NOT_ARRAYS)


def load_stored_airframe(folder: Path, cache: Path) -> AssessedAirframe | None:
    """Map what `store_airframe` left of the aircraft in ``folder``; None if there is nothing.

    Raises
    ------
    ModelError
        The definition cannot be used; says where and why.
    """
    definition = load_definition(folder)
    try:
        identity = content_hash(folder, *definition.files)
    except OSError:  # reading the whole aircraft will say which file is missing
        return None
    return _mapped(cache, definition, identity)


def store_airframe(airframe: AssessedAirframe, cache: Path) -> AssessedAirframe:
    """Store what assessments need of an airframe below ``cache``; returns it mapped from there."""
    stored = _mapped(cache, airframe.definition, airframe.content_hash)
    if stored is not None:
        return stored
    moments = [airframe.mass_states.empty, *(group.moments for group in airframe.groups)]
    write_array_folder(
        _folder(cache, airframe.content_hash),
        {"format": FORMAT, "content_hash": airframe.content_hash},
        {name: getattr(airframe, name) for name in _ARRAYS}
        | {"mass_moments": np.stack([_row(each) for each in moments])},
    )
    stored = _mapped(cache, airframe.definition, airframe.content_hash)
    if stored is None:
        raise ModelError(f"{cache}: the airframe written there cannot be read back")
    return stored


def _mapped(cache: Path, definition: AircraftDefinition, identity: str) -> AssessedAirframe | None:
    folder = _folder(cache, identity)
    if read_head(folder) != {"format": FORMAT, "content_hash": identity}:
        return None
    empty, *full = (_moments(row) for row in map_array(folder, "mass_moments"))
    groups = tuple(
        LoadedGroup(group, moments) for group, moments in zip(definition.groups, full, strict=True)
    )
    return AssessedAirframe(
        definition=definition,
        content_hash=identity,
        mass_states=MassStates(definition, empty, groups),
        **{name: map_array(folder, name) for name in _ARRAYS},
    )


def _folder(cache: Path, identity: str) -> Path:
    key = hashlib.sha256(f"{identity} {FORMAT}".encode()).hexdigest()
    return cache / f"airframe-{key[:16]}"


def _row(moments: MassMoments) -> Array:
    return np.concatenate([[moments.mass], moments.first, moments.second.ravel()])


def _moments(row: Array) -> MassMoments:
    return MassMoments(float(row[0]), np.array(row[1:4]), np.array(row[4:]).reshape(3, 3))
