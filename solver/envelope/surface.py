"""Interpolation of what landings use of their limits, over all of an envelope's coordinates.

Each part's utilisation is interpolated by itself, and the largest taken afterwards.  Logarithms are
interpolated, as utilisations span two decades and matter in proportion; thin-plate splines (Duchon
1977) in coordinates that are stretched so that landings left out are met best.
"""

from dataclasses import dataclass, field

import numpy as np
from scipy.interpolate import RBFInterpolator

from solver.arrays import Array

#: Utilisations above are all alike HARD; a gear that hits its stop would bend the surface for all.
CAP = 1.8
#: Added before the logarithm, so that what a zone hardly feels does not count.
_FLOOR = 0.05
#: Parts are kept that come as close to the largest in some landing.
_NEAR_LARGEST = 0.75
#: Where the error counts: about the thresholds of the verdict.
GRADED = (0.35, 1.3)

#: Of the spline: residuals that it may leave, as landings are no smooth function to the last digit.
_SMOOTHING = 0.03
#: Stretches are searched by these steps, up and down, on at most so many landings, in these folds.
_STEPS = (0.6, 1.6)
_SEARCHED = 360
_FOLDS = 4


@dataclass(frozen=True, slots=True)
class Surface:
    """Utilisation and stop ratio over places in an envelope's box."""

    stretch: Array  #: (d,) of each coordinate
    places: Array  #: (n, d) -1 to 1
    utilisations: Array  #: (n, k) of the parts that matter
    stops: Array  #: (n, m)
    _spline: RBFInterpolator = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        values = np.hstack([self.utilisations, self.stops])
        object.__setattr__(self, "_spline", _spline(self.places * self.stretch, values))

    def __call__(self, places: Array) -> tuple[Array, Array]:
        """Largest utilisation and largest stop ratio, each (q,), at places (q, d)."""
        values = _from_logarithm(self._spline(places * self.stretch))
        parts = self.utilisations.shape[1]
        return values[:, :parts].max(axis=1), values[:, parts:].max(axis=1)


def fit(places: Array, utilisations: Array, stops: Array, stretch: Array, sweeps: int) -> Surface:
    """Surface through landings.

    Parameters
    ----------
    places : (n, d) array
        Where in the box, -1 to 1.
    utilisations : (n, k) array
        Of every part.
    stops : (n, m) array
    stretch : (d,) array
        Where the search for the best stretches starts.
    sweeps : int
        How often the search goes through the coordinates.
    """
    kept = np.minimum(utilisations[:, worth_keeping(utilisations)], CAP)
    some = slice(max(0, len(places) - _SEARCHED), None)  # the latest lie best
    stretch = _best_stretch(places[some], kept[some], stretch, sweeps)
    return Surface(stretch, places, kept, stops)


def worth_keeping(utilisations: Array) -> Array:
    """Which parts (k,) ever come near the largest utilisation where it is graded."""
    largest = utilisations.max(axis=1, keepdims=True)
    graded = (largest[:, 0] > GRADED[0]) & (largest[:, 0] < GRADED[1])
    rows = graded if graded.any() else np.ones(len(utilisations), dtype=bool)
    near: Array = np.any(utilisations[rows] >= _NEAR_LARGEST * largest[rows], axis=0)
    return near


def _spline(points: Array, values: Array) -> RBFInterpolator:
    return RBFInterpolator(
        points,
        np.log(values + _FLOOR),
        kernel="thin_plate_spline",
        smoothing=_SMOOTHING,
        degree=1,
    )


def _from_logarithm(values: Array) -> Array:
    utilisations: Array = np.exp(values) - _FLOOR
    return utilisations


def _best_stretch(places: Array, utilisations: Array, stretch: Array, sweeps: int) -> Array:
    """Coordinate search for the stretches that meet left-out landings best."""
    best = _left_out_error(places, utilisations, stretch)
    for _ in range(sweeps):
        for column in range(len(stretch)):
            start = stretch
            for step in _STEPS:
                tried = start.copy()
                tried[column] *= step
                error = _left_out_error(places, utilisations, tried)
                if error < best:
                    best, stretch = error, tried
    return stretch


def _left_out_error(places: Array, utilisations: Array, stretch: Array) -> float:
    """Root mean square of the relative error at landings left out of the fit."""
    largest = utilisations.max(axis=1)
    fold = np.arange(len(places)) % _FOLDS
    found = np.empty(len(places))
    for number in range(_FOLDS):
        out = fold == number
        spline = _spline(places[~out] * stretch, utilisations[~out])
        found[out] = _from_logarithm(spline(places[out] * stretch)).max(axis=1)
    graded = (largest > GRADED[0]) & (largest < GRADED[1])
    if not graded.any():
        return float("inf")
    relative = found[graded] / largest[graded] - 1.0
    return float(np.sqrt(np.mean(relative**2)))
