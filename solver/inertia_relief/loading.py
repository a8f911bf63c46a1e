"""One loading of a reduced airframe: its modes, its rate operators, its share of the loads."""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh

from solver.arrays import Array, Single
from solver.errors import ModelError
from solver.frames import skew
from solver.inertia_relief.modal_recursion import StepCoefficients, step_coefficients
from solver.inertia_relief.reduced import ReducedModel


@dataclass(frozen=True, slots=True)
class ReducedLoading:
    """A reduced model with the mass of one loading; m elastic coordinates."""

    model: ReducedModel
    circular_frequency: Array  #: (m,) descending [rad/s]
    weights: Array  #: (1 + g,) one for the base, then the fill factors
    modes_with_rigid: Single  #: (6 + m, m) see `modes`, made mean-axis for this loading
    rate_norms: Array  #: (12, 6 + m) modal loads of unit coordinates are at most this
    inertia: Array  #: (6 + m, 12)
    centre_of_gravity: Array  #: (3,) [m]
    mass: float  #: [kg]
    gyration_radius: float  #: [m]
    rigid_transfer: Array  #: (6, 6) resultants about the origin to those about the cg

    @property
    def modes(self) -> Single:
        """Modes in the model's coordinates, the orthogonal columns of (m, m)."""
        modes: Single = self.modes_with_rigid[6:]
        return modes

    def coefficients(self, time_step: float) -> StepCoefficients:
        """Exact recursion of every mode over ``time_step`` [s], with the model's damping."""
        frequency = self.circular_frequency
        return step_coefficients(frequency, self.model.damping.modal_ratio(frequency), time_step)


def assemble(model: ReducedModel, factors: Array) -> ReducedLoading:
    """Assemble ``M(f) = M_0 + sum f_j M_j`` and find its elastic modes.

    Parameters
    ----------
    factors : (g,) array
        Fill of every mass group, 0 to 1.

    Raises
    ------
    ModelError
        Wrong number of factors, or a mass matrix that is not positive definite.
    """
    if np.shape(factors) != (model.group_count,):
        raise ModelError(
            f"{model.group_count} mass groups need as many fill factors, got {np.shape(factors)}"
        )
    weights = np.concatenate([[1.0], factors])
    total = np.tensordot(weights, model.mass, axes=1)
    rigid, coupling = total[:6, :6], total[:6, 6:]
    follow = -np.linalg.solve(rigid, coupling)
    elastic = total[6:, 6:] + coupling.T @ follow
    # K is the identity: M phi = mu phi with mu = 1 / w^2, and orthogonal modes
    # In single precision: what it costs in the fastest modes, which follow their loads at once,
    # is nothing beside what it saves.
    single = ((elastic + elastic.T) / 2).astype(np.float32)
    squares, vectors = eigh(single, driver="evd", overwrite_a=True, check_finite=False)
    rounding = float(np.finfo(np.float32).eps) * float(squares[-1])
    if not squares[0] > -len(squares) * rounding:
        raise ModelError(f"reduced mass is not positive definite at factors {factors.tolist()}")
    squared_period = np.maximum(squares.astype(np.float64), rounding)
    modes = np.empty((6 + len(vectors), len(vectors)), dtype=np.float32)
    np.matmul(follow.astype(np.float32), vectors, out=modes[:6])
    modes[6:] = vectors
    mass = float(rigid[0, 0])
    lever = rigid[:3, 3:] / mass  # equals -skew(centre of gravity from the origin)
    centre = np.array([lever[1, 2], lever[2, 0], lever[0, 1]])
    transfer = np.eye(6)
    transfer[3:, :3] = -skew(centre)
    central = transfer @ rigid @ transfer.T
    return ReducedLoading(
        model=model,
        circular_frequency=1.0 / np.sqrt(squared_period),
        modes_with_rigid=modes,
        weights=weights,
        rate_norms=np.tensordot(weights, model.rate_norms, axes=1)
        + np.tensordot(weights, _through_rigid(model, follow), axes=1),
        inertia=np.tensordot(weights, model.inertia, axes=1),
        centre_of_gravity=model.origin + centre,
        mass=mass,
        gyration_radius=float(np.sqrt(np.trace(central[3:, 3:]) / (2 * mass))),
        rigid_transfer=transfer,
    )


def _through_rigid(model: ReducedModel, follow: Array) -> Array:
    """Bounds (1 + g, 12, 6 + m) of elastic loads that come through the rigid modes.

    Loads on the rigid modes reach the elastic ones only through the little that these follow.
    """
    rigid = np.abs(model.rate_operators[:, :, :, :6])
    bounds: Array = rigid @ np.linalg.norm(follow, axis=1)
    return bounds
