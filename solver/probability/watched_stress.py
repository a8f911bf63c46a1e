"""Peak stress of some elements in many landings of one loading.

With the modes of the loading, stress is ``S q = S p + S (q - p)``: p is what the loads would cause
if they were applied slowly, a product with the load amplitudes themselves, and q - p the departure
from it, which only slow modes show.  Modes whose departures do not matter for the watched elements
follow their loads at once (the mode-acceleration method; Williams, "Dynamic loads in aeroplanes
under given impulsive loads", ARC R&M 2221, 1945).  Watched elements are neighbours and follow the
same motion: their rows factor into a few patterns of amplitudes and departures.  The W terms of
eq (15) of Lee et al. are left out.  What all that and coarser steps cost is measured against the
full path in every landing that is sampled, and taken off, see `solver.probability.exceedance`.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array, IntArray, Single
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.loading import ReducedLoading
from solver.inertia_relief.loads import LandingLoads
from solver.inertia_relief.modal_recursion import step_coefficients
from solver.inertia_relief.reduced import ReducedModel
from solver.probability.watched_kernels import fill_departures, fill_peaks

#: Share of the largest stress that the modes which follow their loads may leave out together.
NEGLIGIBLE = 0.03
#: Share of the largest stress that the patterns may leave out of any element's.
LEFT_OUT = 0.008
#: Elements whose rows are held at once.
_ELEMENTS_AT_ONCE = 32


@dataclass(frozen=True, slots=True)
class WatchedRows:
    """Stress rows of n watched elements in the model's coordinates, shells first."""

    elements: IntArray  #: (n,) ascending, in the solver's element order
    shells: int  #: how many of them
    rows: Single  #: (6 n, m) [Pa]
    points: Single  #: (n - shells, 8, 5)


@dataclass(frozen=True, slots=True)
class WatchedStress:
    """The watched elements under one loading; d modes depart from their loads, r patterns."""

    watched: WatchedRows
    origin: Array  #: (3,) where the motion is taken [m]
    damping: RayleighDamping
    shapes: Array  #: (k, d) modal loads of unit load amplitudes
    patterns: Single  #: (k + d, r) of load amplitudes, then of departures
    shares: Single  #: (6 n, r) stress of unit patterns
    circular_frequency: Array  #: (d,) [rad/s]

    def peaks(self, loads: LandingLoads, damping_factor: float = 1.0) -> Array:
        """Peak von Mises stress (n,) [Pa] of a landing, the damping ``damping_factor`` fold."""
        amplitudes = load_amplitudes(loads, self.origin)
        motion = np.empty((len(amplitudes), len(self.patterns)), dtype=np.float32)
        kept = amplitudes.shape[1]
        motion[:, :kept] = amplitudes
        _depart(
            self.circular_frequency,
            damping_factor * self.damping.modal_ratio(self.circular_frequency),
            loads,
            amplitudes @ self.shapes,
            motion[:, kept:],
        )
        history = np.ascontiguousarray((motion @ self.patterns).T)
        count, shells = len(self.watched.elements), self.watched.shells
        peaks, room = np.empty(count), np.empty(len(amplitudes))
        rows = np.empty((6 * _ELEMENTS_AT_ONCE, len(amplitudes)), dtype=np.float32)
        for first in range(0, count, _ELEMENTS_AT_ONCE):
            last = min(count, first + _ELEMENTS_AT_ONCE)
            some = rows[: 6 * (last - first)]
            np.matmul(self.shares[6 * first : 6 * last], history, out=some)
            plates = min(max(shells - first, 0), last - first)
            beams = self.watched.points[max(first - shells, 0) : max(last - shells, 0)]
            fill_peaks(some, beams, plates, room, peaks[first:last])
        return peaks


def watch(model: ReducedModel, elements: IntArray) -> WatchedRows:
    """Gather the rows of elements (n,), whatever their order."""
    stress = model.stress
    elements = np.unique(elements)
    boundary = len(stress.shell_step)
    shells = int(np.searchsorted(elements, boundary))
    beams = elements[shells:] - boundary
    rows = np.concatenate(
        [stress.shell_rows[elements[:shells]].exact(), stress.beam_rows[beams].exact()]
    )
    return WatchedRows(
        elements=elements,
        shells=shells,
        rows=(rows / stress.scale).reshape(6 * len(elements), -1).astype(np.float32, copy=False),
        points=np.ascontiguousarray(stress.beam_points[beams]),
    )


def watched_stress(
    loading: ReducedLoading,
    watched: WatchedRows,
    allowables: Array,
    examples: list[LandingLoads],
    largest: float,
) -> WatchedStress:
    """Choose the modes that matter in ``examples`` and gather what they cause.

    A mode's part is the largest departure in any example times the utilisation that a unit of it
    causes anywhere; parts of modes that know nothing of each other add up like noise.

    Parameters
    ----------
    allowables : (n,) array
        Of the watched elements [Pa].
    examples : list of LandingLoads
        Landings like those to come; what does not move in any of them is not seen later.
    largest : float
        Utilisation of the most used element, of which shares may be left out.
    """
    model = loading.model
    shapes = np.hstack([model.applied, loading.inertia]).T @ loading.modes_with_rigid
    stress = watched.rows @ loading.modes.astype(np.float32)
    weights = np.linalg.norm(stress.reshape(len(allowables), 6, -1), axis=1)
    weights = (weights / allowables[:, None]).max(axis=0)
    frequency = loading.circular_frequency
    farthest, highest = np.zeros(model.size), np.zeros(len(shapes))
    for loads in examples:
        amplitudes = load_amplitudes(loads, model.origin)
        highest = np.maximum(highest, np.abs(amplitudes).max(axis=0))
        modal = amplitudes @ shapes
        departure = np.empty(modal.shape, dtype=np.float32)
        _depart(frequency, model.damping.modal_ratio(frequency), loads, modal, departure)
        farthest = np.maximum(farthest, np.abs(departure).max(axis=0))
    parts = weights * farthest
    order = np.argsort(parts)
    left_out = np.sqrt(np.cumsum(parts[order] ** 2))
    kept = np.sort(order[np.searchsorted(left_out, NEGLIGIBLE * largest) :])
    patterns, shares = _factored(
        np.hstack([stress @ shapes.T.astype(np.float32), stress[:, kept]]),
        np.concatenate([highest, farthest[kept]]),
        allowables,
        LEFT_OUT * largest,
    )
    return WatchedStress(
        watched=watched,
        origin=model.origin,
        damping=model.damping,
        shapes=np.ascontiguousarray(shapes[:, kept]),
        patterns=patterns,
        shares=shares,
        circular_frequency=frequency[kept],
    )


def _factored(
    rows: Single, largest: Array, allowables: Array, left_out: float
) -> tuple[Single, Single]:
    """Factor rows (6 n, f) into patterns (f, r) and shares (6 n, r).

    Features as large as they get, ``largest`` (f,), cause utilisations; the eigenvectors of their
    Gram matrix are the patterns, as many as it takes until no element misses more than
    ``left_out`` in the root of the sum of squares of what its features would cause.
    """
    size = np.maximum(largest, 1e-9 * largest.max())
    scaled = rows * size / np.repeat(allowables, 6)[:, None]
    vectors = np.linalg.eigh(scaled.T @ scaled)[1][:, ::-1]
    held = np.square(scaled @ vectors).reshape(len(allowables), 6, -1).sum(axis=1)
    missing = held[:, ::-1].cumsum(axis=1)[:, ::-1].max(axis=0)
    count = max(1, int(np.count_nonzero(missing > left_out**2)))
    patterns, shares = vectors[:, :count] / size[:, None], (rows * size) @ vectors[:, :count]
    return patterns.astype(np.float32), shares.astype(np.float32)


def load_amplitudes(loads: LandingLoads, origin: Array) -> Array:
    """Amplitudes (nt, k) of pins, air loads and inertia loads about ``origin``."""
    return np.hstack([loads.applied_amplitudes(), loads.motion.at(origin).inertia_amplitudes()])


def _depart(frequency: Array, ratio: Array, loads: LandingLoads, modal: Array, out: Single) -> None:
    step = step_coefficients(frequency, ratio, float(loads.time[1] - loads.time[0]))
    fill_departures(
        np.ascontiguousarray(step.displacement.T),
        np.ascontiguousarray(step.velocity.T),
        modal,
        out,
    )
