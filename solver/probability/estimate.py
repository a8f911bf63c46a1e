"""A probability from samples, with its own sampling error.

The interval is Jeffreys' for a binomial share, the 2.5 and 97.5 % quantiles of a beta distribution
with parameters x + 1/2 and n - x + 1/2 (Brown, Cai and DasGupta, "Interval estimation for a
binomial proportion", Statistical Science 16, 2001), its lower end zero at x = 0 and its upper end
one at x = n.  Sobol points scatter less than the independent ones it supposes, so it is on the safe
side.  The standard error is that of the mean of the replicates, which knows about the points, but
never less than what one sample more or less would change: at x = 0 no spread is seen and none is
proved.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import betaincinv

from solver.arrays import BoolArray

#: Probability that the interval holds the true value.
CONFIDENCE = 0.95


@dataclass(frozen=True, slots=True)
class Estimate:
    """Share of samples in which something happened."""

    probability: float
    standard_error: float
    lower: float
    upper: float


def estimate(happened: BoolArray) -> Estimate:
    """Estimate from replicates.

    Parameters
    ----------
    happened : (replicates, size) array
        Whether it did in each sample.

    Raises
    ------
    ValueError
        There is no sample, or only one replicate, whose spread would be unknown.
    """
    replicates, size = happened.shape
    if replicates < 2 or size < 1:
        raise ValueError(f"replicates and samples: {happened.shape}, needed are 2 and 1 at least")
    count, total = int(happened.sum()), happened.size
    spread = float(np.std(happened.mean(axis=1), ddof=1)) / math.sqrt(replicates)
    tail = (1.0 - CONFIDENCE) / 2.0
    below, above = count + 0.5, total - count + 0.5
    return Estimate(
        probability=count / total,
        standard_error=max(spread, 1.0 / total),
        lower=0.0 if count == 0 else float(betaincinv(below, above, tail)),
        upper=1.0 if count == total else float(betaincinv(below, above, 1.0 - tail)),
    )
