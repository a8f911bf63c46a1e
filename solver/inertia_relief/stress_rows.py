"""Stress operators in rows whose squares sum to von Mises stress.

For a shell face ``sx^2 - sx sy + sy^2 + 3 t^2 = (sx - sy / 2)^2 + (3/4) sy^2 + 3 t^2``; for a beam
point ``s^2 + 3 t^2``.  Every peak is then the largest Euclidean norm of a few linear rows, which is
what the bounds of the peak search rest on.  The eight normal stresses of a beam are combinations of
five numbers: the axial force, and two bending moments at each end.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Array, Single
from solver.errors import ModelError

if TYPE_CHECKING:
    from solver.fe.stress import StressRecovery

_ROOT_3 = np.sqrt(3.0)
#: Eigenvalues of the stresses' Gram matrix below this share are rounding.
_DEPENDENT = 1e-9
#: Elements whose rows are found at once: all in double precision would take gigabytes.
_TOGETHER = 1024


@dataclass(frozen=True, slots=True)
class StressRows:
    """Stress of every element for each unit coordinate of a basis of m vectors."""

    shells: Single  #: (n_shells, 6, m) three rows of the bottom face, three of the top [Pa]
    beams: Single  #: (n_beams, 6, m) five rows of normal stress, sqrt(3) times the shear [Pa]
    points: Single  #: (n_beams, 8, 5) normal stress of the eight points from the five rows


def measure_squares(rows: NDArray[Any], points: NDArray[Any]) -> Array:
    """Sum over the coordinates of the squares of each measure of stress.

    Parameters
    ----------
    rows : (n, 6, m) array
        Of shells or of beams.
    points : (n, 8, 5) array
        Of beams; (n, 0, 5) for shells.

    Returns
    -------
    (n, 2) or (n, 8) array
        For both faces of a shell, or the eight points of a beam: the largest square of its von
        Mises stress for unit norm of the coordinates is at most this.
    """
    squares = np.einsum("erk,erk->er", rows, rows)
    if points.shape[1] == 0:
        faces: Array = squares.reshape(-1, 2, 3).sum(axis=2)
        return faces
    normal = points @ rows[:, :5]
    total: Array = np.einsum("epk,epk->ep", normal, normal) + squares[:, 5:]
    return total


def reduced_stress_rows(recovery: "StressRecovery", basis: Array) -> StressRows:
    """Stress rows of every element for the columns of ``basis`` (n, m)."""
    size = basis.shape[1]
    shell_count = recovery.shell_operator.shape[0] // 6
    beam_count = recovery.beam_operator.shape[0] // 9
    rows = StressRows(
        np.empty((shell_count, 6, size), dtype=np.float32),
        np.empty((beam_count, 6, size), dtype=np.float32),
        np.empty((beam_count, 8, 5), dtype=np.float32),
    )
    for first in range(0, shell_count, _TOGETHER):
        operator = recovery.shell_operator[6 * first : 6 * (first + _TOGETHER)]
        shells = np.asarray(operator @ basis).reshape(-1, 2, 3, size)
        shells[:, :, 0] -= shells[:, :, 1] / 2
        shells[:, :, 1] *= _ROOT_3 / 2
        shells[:, :, 2] *= _ROOT_3
        rows.shells[first : first + _TOGETHER] = shells.reshape(-1, 6, size)
    for first in range(0, beam_count, _TOGETHER):
        part = slice(first, first + _TOGETHER)
        operator = recovery.beam_operator[9 * first : 9 * (first + _TOGETHER)]
        beams = np.asarray(operator @ basis).reshape(-1, 9, size)
        rows.points[part], rows.beams[part, :5] = independent_rows(beams[:, :8])
        rows.beams[part, 5] = _ROOT_3 * beams[:, 8]
    return rows


def independent_rows(normal: Array) -> tuple[Array, Array]:
    """Factor normal stresses (n, 8, m) into (n, 8, 5) orthonormal combinations of (n, 5, m).

    Raises
    ------
    ModelError
        A beam's eight stresses are not combinations of five.
    """
    gram = normal @ normal.transpose(0, 2, 1)
    values, vectors = np.linalg.eigh(gram)
    if np.any(values[:, 2] > _DEPENDENT * values[:, 7]):
        raise ModelError("normal stresses of a beam's eight points have more than five sources")
    points = vectors[:, :, 3:]
    return points, points.transpose(0, 2, 1) @ normal
