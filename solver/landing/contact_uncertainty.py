"""How well the state at a contact is known: standard deviations and their correlations."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array

#: Order of every covariance of a contact's state; names are those of `Contact`.
CONTACT_COMPONENTS = (
    "sink_rate",
    "pitch",
    "roll",
    "drift",
    "ground_speed",
    "pitch_rate",
    "roll_rate",
    "yaw_rate",
    "lift_fraction",
)


@dataclass(frozen=True, slots=True)
class ContactUncertainty:
    """Covariance of one contact's state about the values that its `Contact` holds.

    Plain rows of numbers, because it is stored and compared with the record it belongs to.
    """

    covariance: tuple[tuple[float, ...], ...]  #: (9, 9) in the order of `CONTACT_COMPONENTS`, SI
    #: Standard deviations of the lift's decay start [s], decay time (relative) and residual
    #: fraction; None: as much as landings scatter.
    lift_course: tuple[float | None, float | None, float | None] = (None, None, None)

    @classmethod
    def from_matrix(cls, covariance: Array) -> "ContactUncertainty":
        """Take a (9, 9) array.

        Raises
        ------
        ValueError
            It is no covariance: not (9, 9), not symmetric, or a variance is negative.
        """
        matrix = np.asarray(covariance, dtype=np.float64)
        size = len(CONTACT_COMPONENTS)
        if matrix.shape != (size, size):
            raise ValueError(f"the covariance of a contact is ({size}, {size}): {matrix.shape}")
        rounding = 1e-9 * np.sqrt(np.abs(np.outer(np.diag(matrix), np.diag(matrix))))
        if np.any(np.abs(matrix - matrix.T) > rounding) or np.any(np.diag(matrix) < 0.0):
            raise ValueError("the covariance of a contact is not symmetric or has a negative entry")
        return cls(tuple(tuple(row) for row in matrix.tolist()))

    @classmethod
    def independent(cls, **standard_deviations: float) -> "ContactUncertainty":
        """Components by name with their standard deviations; those not named are exact."""
        unknown = sorted(set(standard_deviations) - set(CONTACT_COMPONENTS))
        if unknown:
            raise ValueError(f"no such component of a contact: {', '.join(unknown)}")
        sds = [standard_deviations.get(name, 0.0) for name in CONTACT_COMPONENTS]
        return cls.from_matrix(np.diag(np.square(sds)))

    @property
    def matrix(self) -> Array:
        """The (9, 9) covariance."""
        return np.array(self.covariance)
