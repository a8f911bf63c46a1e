"""Stress operators in rows whose squares sum to von Mises stress.

For a shell face ``sx^2 - sx sy + sy^2 + 3 t^2 = (sx - sy / 2)^2 + (3/4) sy^2 + 3 t^2``; for a beam
point ``s^2 + 3 t^2``.  Every peak is then the largest Euclidean norm of a few linear rows, which is
what the bounds of the peak search rest on.
"""

from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Array
from solver.inertia_relief.reduced import Single

if TYPE_CHECKING:
    from solver.fe.stress import StressRecovery

_ROOT_3 = np.sqrt(3.0)


def reduced_stress_rows(recovery: "StressRecovery", basis: Array) -> tuple[Single, Single]:
    """Rows of every element per unit coordinate of ``basis`` (n, m).

    Returns
    -------
    (n_shells, 6, m) array, (n_beams, 9, m) array
        Shells: three rows of the bottom face, three of the top.  Beams: eight normal stresses,
        then sqrt(3) times the torsional shear [Pa].
    """
    size = basis.shape[1]
    shells = np.asarray(recovery.shell_operator @ basis).reshape(-1, 2, 3, size)
    shells[:, :, 0] -= shells[:, :, 1] / 2
    shells[:, :, 1] *= _ROOT_3 / 2
    shells[:, :, 2] *= _ROOT_3
    beams = np.asarray(recovery.beam_operator @ basis).reshape(-1, 9, size)
    beams[:, 8] *= _ROOT_3
    return (
        np.ascontiguousarray(shells.reshape(-1, 6, size), dtype=np.float32),
        np.ascontiguousarray(beams, dtype=np.float32),
    )
