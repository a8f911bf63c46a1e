"""Corrections of a step's increments: the linearised equations, factorised now and then.

An iteration matrix need not be the true tangent for the iteration to end at the right step, only
for it to end soon.
"""

from typing import Any

import numpy as np
from scipy.sparse import csc_array, csc_matrix, diags_array
from scipy.sparse.linalg import splu

from solver.arrays import Array
from solver.errors import SimulationDivergedError
from solver.inertia_relief.damping import RayleighDamping
from solver.nonlinear.configuration import Configuration
from solver.nonlinear.midpoint import StepTrial
from solver.nonlinear.structure import NonlinearStructure
from solver.nonlinear.tangent import free_tangent

#: A step that took more evaluations asks for a new factorisation before the next,
PATIENCE = 4
#: if it took that many more than the step right after the last factorisation.
WORSE = 2


class Corrector:
    """Gives the increments that about cancel a residual.

    The matrix ``(2 / h^2 + alpha / h) M + (1/2 + beta / h) K`` is factorised in each node's own
    axes: loads and increments are turned by what the node has turned.  A part of the structure that
    turns as a whole keeps its stiffness without error, however far it has gone, and the linear mass
    matrix serves for good.  K is the tangent where the factorisation was made; what it misses
    later are the changes of the stresses that stiffen or soften thin skins, which the linear
    stiffness of the unloaded structure misses altogether: with it the iteration of a loaded
    airframe does not converge unless mixed.  Single precision serves, as each correction is only a
    share of the last.

    Parameters
    ----------
    mass : (n_free, n_free) sparse array
        Of the linear model.
    """

    def __init__(
        self,
        structure: NonlinearStructure,
        mass: Any,
        step: float,
        damping: RayleighDamping,
    ) -> None:
        alpha, beta = damping.mass_coefficient, damping.stiffness_coefficient
        self._structure = structure
        self._heavy = csc_array(mass) * (2 / step**2 + alpha / step)
        self._stiff = 0.5 + beta / step
        self._is_due = True
        self._fresh = 0  # evaluations of the step right after the last factorisation
        self._factor: Any = None
        self._scale = np.empty(0)
        self.factorisations = 0

    def prepare(self, at: Configuration) -> None:
        """Learn where a step begins."""
        if self._is_due:
            self._factorise(at)

    def renew(self, at: Configuration) -> None:
        """Factorise whatever is due: the last matrix did not lead anywhere."""
        self._factorise(at)

    def judge(self, evaluations: int) -> None:
        """Learn how many evaluations of the residual the step took."""
        if self._fresh == 0:
            self._fresh = evaluations
        self._is_due = evaluations > max(PATIENCE, self._fresh + WORSE)

    def correction(self, trial: StepTrial) -> Array:
        """Give the increments (nf, 6) that about cancel a trial's residual.

        Forces act with the frames in the middle of the step, deformations are measured with those
        at its end.
        """
        nodes = self._structure.free_nodes
        # a row vector times R is R' acting on it
        turned = trial.residual.reshape(-1, 2, 3) @ trial.middle.rotations[nodes]
        right = (turned.ravel() * self._scale).astype(np.float32)
        solution = self._factor.solve(right).astype(np.float64) * self._scale
        ends = np.swapaxes(trial.motion.at.rotations[nodes], 1, 2)
        back: Array = solution.reshape(-1, 2, 3) @ ends
        return back.reshape(-1, 6)

    def _factorise(self, at: Configuration) -> None:
        matrix = self._heavy + self._stiff * free_tangent(self._structure, at)
        if not np.all(np.isfinite(matrix.data)):
            raise SimulationDivergedError("the nonlinear analysis left the finite numbers")
        self._scale = 1.0 / np.sqrt(matrix.diagonal())
        scaling = diags_array(self._scale)
        # settings as in `solver.inertia_relief.factor`, which works in double precision
        try:
            self._factor = splu(
                csc_matrix(scaling @ matrix @ scaling).astype(np.float32),
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError as error:
            raise SimulationDivergedError(
                "the equations of a step are singular: a part has neither stiffness nor inertia"
            ) from error
        self._fresh = 0
        self.factorisations += 1
