"""Standard normal samples: scrambled Sobol points, the same for the same seed.

Owen's scrambling (Owen, "Scrambling Sobol' and Niederreiter-Xing points", Journal of Complexity 14,
1998, as in `scipy.stats.qmc`) keeps every replicate unbiased and independent of the others, so that
their spread tells the error of their mean.
"""

import hashlib

import numpy as np
from scipy.special import ndtri
from scipy.stats import qmc

from solver.arrays import Array


def seed_of(content: str) -> int:
    """Seed that belongs to a text: the same record is always sampled alike."""
    return int.from_bytes(hashlib.sha256(content.encode()).digest()[:8], "big")


def sobol_normals(variables: int, replicates: int, size: int, seed: int) -> Array:
    """Replicates of scrambled Sobol points through the inverse normal distribution.

    Parameters
    ----------
    variables : int
        Standard normal variables; the first ones are spread best.
    replicates : int
        Independent scrambles.
    size : int
        Points of each, a power of two.
    seed : int

    Returns
    -------
    (replicates, size, variables) array
    """
    streams = np.random.SeedSequence(seed).spawn(replicates)
    points = [
        qmc.Sobol(variables, scramble=True, rng=np.random.default_rng(stream)).random(size)
        for stream in streams
    ]
    # A scrambled point may be zero to the last of its 30 bits, which has no finite normal.
    smallest = 2.0**-32
    normals: Array = ndtri(np.clip(np.stack(points), smallest, 1.0 - smallest))
    return normals
