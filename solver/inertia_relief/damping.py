"""Structural damping: one named law that full order and reduced order apply alike.

Rayleigh damping ``D = alpha M + beta K`` fitted to one ratio at two frequencies.  The displacement
is kept M-orthogonal to the rigid modes, hence the mass-proportional part never brakes the
aircraft.  In modal coordinates every mode has the ratio ``alpha / (2 w) + beta w / 2``: the stated
ratio at both fitted frequencies, less between them (on the safe side), more outside.

Source: Clough and Penzien, Dynamics of Structures, section 12-5.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array


@dataclass(frozen=True, slots=True)
class RayleighDamping:
    """Mass- and stiffness-proportional damping from a ratio held at two frequencies."""

    ratio: float = 0.02  #: of critical damping at both frequencies
    lower_frequency: float = 3.0  #: [Hz]
    upper_frequency: float = 40.0  #: [Hz]

    @property
    def mass_coefficient(self) -> float:
        """The alpha of ``D = alpha M + beta K`` [1/s]."""
        lower, upper = 2 * np.pi * self.lower_frequency, 2 * np.pi * self.upper_frequency
        return float(2 * self.ratio * lower * upper / (lower + upper))

    @property
    def stiffness_coefficient(self) -> float:
        """The beta of ``D = alpha M + beta K`` [s]."""
        lower, upper = 2 * np.pi * self.lower_frequency, 2 * np.pi * self.upper_frequency
        return float(2 * self.ratio / (lower + upper))

    def modal_ratio(self, circular_frequency: Array) -> Array:
        """Ratio of critical damping of modes with ``circular_frequency`` [rad/s]."""
        return (
            self.mass_coefficient / circular_frequency
            + self.stiffness_coefficient * circular_frequency
        ) / 2
