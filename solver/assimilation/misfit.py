"""Whether what was recorded can be explained by the simulation and the stated uncertainties."""

from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2

from solver.arrays import Array
from solver.assimilation.samples import Response
from solver.assimilation.update import Update
from solver.flight_data.parameter import Parameter

#: Probability of a misfit as large, the uncertainties being right, below which it is unexplained.
UNEXPLAINED = 1e-3

#: Pull of a single parameter above which it is, too: a gain that is 20 % off bends all samples a
#: little the same way, which the sum of squares hardly sees.  Forty parameters pass 4.5 by chance
#: once in 4,000 landings.
MOST_PULL = 4.5

#: A parameter of whose variance the samples take less than this share says nothing.
_LEAST_TAKEN = 0.02


@dataclass(frozen=True, slots=True)
class ComparedPeak:
    """Largest recorded normal acceleration of a contact, and the simulation's as recorded."""

    recorded: float  #: datum taken out [g]
    prior: float  #: simulated from the state before the update, filtered and sampled [g]
    posterior: float  #: from that after it [g]
    rate: float  #: samples per second [Hz]


@dataclass(frozen=True, slots=True)
class ChannelMisfit:
    """Residuals of one channel over their standard deviation, root mean square."""

    parameter: Parameter
    samples: int
    prior: float
    posterior: float


@dataclass(frozen=True, slots=True)
class ParameterUpdate:
    """One parameter before and after."""

    name: str
    unit: str  #: SI, accelerations in g, ``ln`` for the logarithm of a factor
    prior: float
    prior_sd: float
    posterior: float
    posterior_sd: float
    pull: float  #: by how much it moved over the scatter that such a move should have


@dataclass(frozen=True, slots=True)
class Misfit:
    """What is left between recording and simulation, together with what the parameters moved."""

    chi_square: float
    measurements: int  #: degrees of freedom
    effective_parameters: float  #: how many measurements the update took up
    probability: float  #: of a value as large, if the stated uncertainties hold
    channels: tuple[ChannelMisfit, ...]
    peak: ComparedPeak
    strongest: ParameterUpdate  #: the parameter that was pulled most

    @property
    def is_explained(self) -> bool:
        """Whether the stated uncertainties can explain it."""
        return self.probability >= UNEXPLAINED and abs(self.strongest.pull) <= MOST_PULL

    @property
    def text(self) -> str:
        """One sentence for a reader."""
        peak = self.peak
        return (
            f"normal acceleration peaked at {peak.recorded:.2f} g where the simulation, sampled as "
            f"recorded, has {peak.prior:.2f} g, and {peak.posterior:.2f} g after the update; "
            f"chi-square {self.chi_square:.0f} for {self.measurements} samples; most strained: "
            f"{self.strongest.name.replace('_', ' ')} ({self.strongest.pull:+.1f} standard "
            "deviations)"
        )


def pull(moved: float, prior_sd: float, taken: float) -> float:
    """Standardised move of a parameter, 0 where the samples hardly speak of it.

    Parameters
    ----------
    moved : float
        From its prior value.
    prior_sd : float
    taken : float
        Prior less posterior variance, which is the variance of the move.

    Notes
    -----
    The pull of a kinematic fit: L. Demortier, L. Lyons, Everything you always wanted to know about
    pulls, CDF/ANAL/PUBLIC/5776 (2002), sec. 3.
    """
    if taken <= _LEAST_TAKEN * prior_sd**2:
        return 0.0
    return float(moved / np.sqrt(taken))


def misfit_of(
    response: Response,
    update: Update,
    parameters: tuple[ParameterUpdate, ...],
    prior: list[Array],
    posterior: list[Array],
) -> Misfit:
    """Misfit of an update; ``prior`` and ``posterior`` are the samples that either predicts."""
    channels = tuple(
        ChannelMisfit(
            channel.parameter,
            len(channel.time),
            *(
                float(np.sqrt(np.mean((channel.whiten @ (channel.value - predicted)) ** 2)))
                for predicted in (before, after)
            ),
        )
        for channel, before, after in zip(response.channels, prior, posterior, strict=True)
    )
    normal = response.channels[0]
    count = len(response.measured)
    return Misfit(
        chi_square=update.chi_square,
        measurements=count,
        effective_parameters=update.effective,
        probability=float(chi2.sf(update.chi_square, count)),
        channels=channels,
        peak=ComparedPeak(
            recorded=float(normal.value.max()),
            prior=float(prior[0].max()),
            posterior=float(posterior[0].max()),
            rate=normal.rate,
        ),
        strongest=max(parameters, key=lambda parameter: abs(parameter.pull)),
    )
