"""The reduced airframe: projected once, stored as plain arrays, assembled for any loading.

Coordinates are amplitudes of a K-orthonormal basis, so the stiffness is the identity and twice the
strain energy is the sum of their squares.  Six rigid modes stand before them in every inertia
matrix; they keep the frame the mean-axis frame of whatever loading is assembled.
"""

import json
import os
import shutil
import tempfile
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Array
from solver.inertia_relief.damping import RayleighDamping

#: Changes whenever the stored arrays change their meaning.
FORMAT = 4

Single = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class ReducedModel:
    """Projected matrices of an airframe; g mass groups, m elastic coordinates, M = 6 + m."""

    key: str  #: hash of airframe, settings and format
    damping: RayleighDamping
    origin: Array  #: (3,) where the inertia loads and the rigid modes are taken [m]
    mass: Array  #: (1 + g, M, M) base and full groups
    rate_operators: Single  #: (1 + g, 12, M, M) gyroscopic, Euler, centrifugal terms, transposed
    rate_norms: Array  #: (1 + g, 12, M) norms of the elastic loads of unit coordinates
    applied: Array  #: (M, k) unit pin components, then unit air resultants
    inertia: Array  #: (1 + g, M, 12) unit motions, see `Inertia.rigid_load_shapes`
    shell_stress: Single  #: (n_shells, 6, m) rows whose squares sum to von Mises, two faces
    beam_stress: Single  #: (n_beams, 6, m) five rows of normal stress, sqrt(3) times the shear
    beam_points: Single  #: (n_beams, 8, 5) normal stress of the points from the five rows
    shell_squares: Single  #: (n_shells, 2) sum of the squares of each face's rows
    beam_squares: Single  #: (n_beams, 8) sum of the squares of each point's normal stress and shear

    @property
    def size(self) -> int:
        """Number of elastic coordinates."""
        return int(self.applied.shape[0]) - 6

    @property
    def group_count(self) -> int:
        """Number of mass groups."""
        return len(self.mass) - 1

    @property
    def element_count(self) -> int:
        """Number of elements with stress, shells first."""
        return len(self.shell_stress) + len(self.beam_stress)

    def save(self, folder: Path) -> None:
        """Write the model as ``folder`` in one step: readers see all of it or nothing."""
        folder.parent.mkdir(parents=True, exist_ok=True)
        draft = Path(tempfile.mkdtemp(prefix=".reduced-", dir=folder.parent))
        try:
            for field in fields(self):
                value = getattr(self, field.name)
                if isinstance(value, np.ndarray):
                    np.save(draft / f"{field.name}.npy", value)
            damping = {
                field.name: getattr(self.damping, field.name) for field in fields(self.damping)
            }
            head = {"format": FORMAT, "key": self.key, "damping": damping}
            (draft / "model.json").write_text(json.dumps(head, indent=1))
            if folder.exists():
                shutil.rmtree(folder)
            os.replace(draft, folder)
        finally:
            shutil.rmtree(draft, ignore_errors=True)


def load_reduced_model(folder: Path, key: str | None = None) -> ReducedModel | None:
    """Map a stored model into memory; None if it is absent, of another format or another key."""
    try:
        head = json.loads((folder / "model.json").read_text())
    except FileNotFoundError:
        return None
    if head["format"] != FORMAT or (key is not None and head["key"] != key):
        return None
    arrays = {
        field.name: np.load(folder / f"{field.name}.npy", mmap_mode="r")
        for field in fields(ReducedModel)
        if field.name not in ("key", "damping")
    }
    return ReducedModel(key=head["key"], damping=RayleighDamping(**head["damping"]), **arrays)
