"""An envelope on disk: one file beside the reduced models, named by what it rests on."""

import hashlib
import json
import os
import tempfile
from dataclasses import asdict
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from solver import __version__
from solver.aircraft.definition import AircraftDefinition
from solver.aircraft.mass_states import LoadedGroup, MassMoments, MassStates
from solver.envelope.domain import COORDINATES, Domain
from solver.envelope.envelope import Basis, Envelope, SurfaceError
from solver.envelope.surface import Surface

#: Changes whenever the file, or which landings an envelope is made of, changes its meaning.
FORMAT = 1


def envelope_path(cache: Path, content_hash: str) -> Path:
    """File of an aircraft's envelope by this program; another version looks for another one."""
    identity = f"{content_hash} {__version__} {FORMAT} {COORDINATES}"
    return cache / f"envelope-{hashlib.sha256(identity.encode()).hexdigest()[:16]}.npz"


def save_envelope(path: Path, envelope: Envelope) -> None:
    """Write an envelope in one step: readers see all of it or nothing."""
    states = envelope.mass_states
    head = {
        "basis": asdict(envelope.basis),
        "error": asdict(envelope.error),
        "half_span": envelope.domain.half_span,
    }
    moments = [states.empty, *(group.moments for group in states.groups)]
    surface = envelope.surface
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, draft = tempfile.mkstemp(prefix=".envelope-", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as stream:
            np.savez_compressed(
                stream,
                head=np.array(json.dumps(head)),
                low=envelope.domain.low,
                high=envelope.domain.high,
                stretch=surface.stretch,
                places=surface.places,
                utilisations=surface.utilisations,
                stops=surface.stops,
                held_out=envelope.held_out,
                masses=np.array([part.mass for part in moments]),
                first_moments=np.array([part.first for part in moments]),
                second_moments=np.array([part.second for part in moments]),
            )
        os.replace(draft, path)
    except BaseException:
        os.unlink(draft)
        raise


def load_envelope(path: Path, definition: AircraftDefinition) -> Envelope | None:
    """Envelope from its file; None if there is none.

    Parameters
    ----------
    path : Path
        See `envelope_path`.
    definition : AircraftDefinition
        Of the aircraft that the path was made for.
    """
    try:
        with path.open("rb") as stream, np.load(stream, allow_pickle=False) as stored:
            arrays = dict(stored)
    except (OSError, ValueError, BadZipFile):
        return None  # absent, or no file that `save_envelope` wrote
    head: dict[str, Any] = json.loads(str(arrays["head"]))
    moments = [
        MassMoments(float(mass), first, second)
        for mass, first, second in zip(
            arrays["masses"], arrays["first_moments"], arrays["second_moments"], strict=True
        )
    ]
    return Envelope(
        basis=Basis(**head["basis"]),
        domain=Domain(arrays["low"], arrays["high"], head["half_span"]),
        surface=Surface(
            arrays["stretch"], arrays["places"], arrays["utilisations"], arrays["stops"]
        ),
        error=SurfaceError(**head["error"]),
        held_out=arrays["held_out"],
        mass_states=MassStates(
            definition,
            moments[0],
            tuple(
                LoadedGroup(group, part)
                for group, part in zip(definition.groups, moments[1:], strict=True)
            ),
        ),
    )
