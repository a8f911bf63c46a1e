"""The reduced airframe: projected once, stored as plain arrays, assembled for any loading.

Coordinates are amplitudes of a K-orthonormal basis, so the stiffness is the identity and twice the
strain energy is the sum of their squares.  Six rigid modes stand before them in every inertia
matrix; they keep the frame the mean-axis frame of whatever loading is assembled.
"""

from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from solver.array_folder import map_array, read_head, write_array_folder
from solver.arrays import Array, Single
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.reduced_stress import ReducedStress, no_stress

#: Changes whenever the stored arrays change their meaning.
FORMAT = 8


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
    stress: ReducedStress

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
        return self.stress.element_count

    def turned(self, axes: Array) -> "ReducedModel":
        """Return the model without stress in coordinates along orthonormal ``axes`` (m, k)."""
        turn = np.zeros((6 + self.size, 6 + axes.shape[1]))
        turn[:6, :6], turn[6:, 6:] = np.eye(6), axes
        single = turn.astype(np.float32)
        operators = np.stack([single.T @ part @ single for part in self.rate_operators])
        return replace(
            self,
            mass=turn.T @ self.mass @ turn,
            rate_operators=operators,
            rate_norms=rate_norms(operators),
            applied=turn.T @ self.applied,
            inertia=turn.T @ self.inertia,
            stress=no_stress(axes.shape[1]),
        )

    def save(self, folder: Path) -> None:
        """Write the model as ``folder``, see `write_array_folder`."""
        arrays = {
            field.name: value
            for part in (self, self.stress)
            for field in fields(part)
            if isinstance(value := getattr(part, field.name), np.ndarray)
        }
        damping = {field.name: getattr(self.damping, field.name) for field in fields(self.damping)}
        write_array_folder(folder, {"format": FORMAT, "key": self.key, "damping": damping}, arrays)


def load_reduced_model(folder: Path, key: str | None = None) -> ReducedModel | None:
    """Map a stored model into memory; None if it is absent, of another format or another key."""
    head = read_head(folder)
    if head is None or head["format"] != FORMAT or (key is not None and head["key"] != key):
        return None

    def arrays(kind: type, *others: str) -> dict[str, Any]:
        names = [field.name for field in fields(kind) if field.name not in others]
        return {name: map_array(folder, name) for name in names}

    return ReducedModel(
        key=head["key"],
        damping=RayleighDamping(**head["damping"]),
        stress=ReducedStress(**arrays(ReducedStress)),
        **arrays(ReducedModel, "key", "damping", "stress"),
    )


def rate_norms(operators: Single) -> Array:
    """Norms (1 + g, 12, M) of the elastic loads that unit coordinates cause."""
    norms: Array = np.linalg.norm(operators[..., 6:], axis=3).astype(np.float64)
    return norms
