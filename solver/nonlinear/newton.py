"""Modified Newton iteration of one step, with Anderson's mixing of its corrections.

D. G. Anderson, Iterative procedures for nonlinear integral equations, J. ACM 12, 1965, 547-560:
the last few corrections are mixed so that their remainder is least, here in the energy norm of the
iteration matrix, ``c' r``, which weighs displacements and rotations alike.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.errors import SimulationDivergedError
from solver.nonlinear.correction import Corrector
from solver.nonlinear.midpoint import MidpointStep, StepTrial

MAXIMUM_ITERATIONS = 60
#: Corrections that are mixed.
_MEMORY = 4
#: Corrections below this share of the structure's size, and turns below it, are rounding.
_ROUNDING = 1e-13


@dataclass(frozen=True, slots=True)
class SolvedStep:
    """A step whose residual is within the tolerance."""

    trial: StepTrial
    increments: Array  #: (nf, 6)
    iterations: int  #: evaluations of the residual
    error: float  #: energy norm of the correction not made, relative to the strain energy's root


def solve_step(
    step: MidpointStep, corrector: Corrector, guess: Array, tolerance: float, size: float
) -> SolvedStep:
    """Find the increments of a step from a guess (nf, 6).

    Parameters
    ----------
    tolerance : float
        Largest energy norm of the last correction, relative to that of the deformation.
    size : float
        Extent of the structure, against which rounding is judged [m].

    Raises
    ------
    SimulationDivergedError
        The corrections do not become small.
    """
    increments = guess
    steps: list[Array] = []  # changes of the increments from one iteration to the next
    mixed: list[tuple[Array, Array]] = []  # changes of correction and residual
    last: tuple[Array, Array] | None = None
    for iteration in range(1, MAXIMUM_ITERATIONS + 1):
        trial = step.trial(increments)
        residual = trial.residual
        correction = corrector.correction(trial)
        square = abs(float(np.vdot(correction, residual)))
        error = np.sqrt(square / (2.0 * trial.strain_energy)) if trial.strain_energy else np.inf
        if error <= tolerance or _is_rounding(correction, size):
            return SolvedStep(trial, increments, iteration, float(error))
        if not np.isfinite(square):
            break
        if last is not None:
            mixed = [*mixed, (correction - last[0], residual - last[1])][-_MEMORY:]
        last = correction, residual
        change = correction - _mixture(correction, steps, mixed)
        steps = [*steps, change][-_MEMORY:]
        increments = increments + change
    raise SimulationDivergedError(
        f"a step of the nonlinear analysis does not converge: error {error:.3g} of the deformation "
        f"after {iteration} iterations, tolerance {tolerance:.3g}"
    )


def _mixture(correction: Array, steps: list[Array], mixed: list[tuple[Array, Array]]) -> Array:
    """Find what to take from a correction: the changes that best explain it, in the energy norm."""
    if not mixed:
        return np.zeros_like(correction)
    gram = np.array([[np.vdot(c, r) for _, r in mixed] for c, _ in mixed])
    right = np.array([np.vdot(correction, r) for _, r in mixed])
    gram = 0.5 * (gram + gram.T)
    shares = np.linalg.lstsq(gram, right, rcond=1e-10)[0]
    total = np.zeros_like(correction)
    for share, change, (change_of_correction, _) in zip(shares, steps, mixed, strict=True):
        total += share * (change + change_of_correction)
    return total


def _is_rounding(correction: Array, size: float) -> bool:
    moved, turned = np.abs(correction[:, :3]).max(), np.abs(correction[:, 3:]).max()
    return bool(moved <= _ROUNDING * size and turned <= _ROUNDING)
