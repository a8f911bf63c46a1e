"""Compress basis and stress rows for the motions that landings cause.

The basis is made for any load at every place.  Of what it spans, directions in which no landing
moves more than a trace are left out (`principal_axes`).

The rows of a block of elements are factored (`compressed`): the factors are their leading singular
vectors, every element alike, the coordinates weighed by how far landings move them.  Here the
landings decide only how narrow the bounds of the peak search are; its answers do not rest on them.

Source: Eckart and Young, "The approximation of one matrix by another of lower rank", 1936.
"""

from collections.abc import Sequence

import numpy as np

from solver.arrays import Array, Single
from solver.inertia_relief.reduced_stress import BLOCK, ReducedStress
from solver.inertia_relief.stress_rows import StressRows, measure_squares

#: Root mean square of what is dropped over a block's elements, relative to each one's own rows.
DROPPED = 5e-4
#: Share of the motion in landings that the directions left out may carry.
UNMOVED = 2e-5
#: Power of the spread by which coordinates are divided; 0 keeps them, 1 makes them alike.
SCALING = 0.3
#: A coordinate counts as moved by at least this share of the most moved one.
_LEAST_SPREAD = 3e-5


def principal_axes(histories: Sequence[Single], size: int) -> tuple[Array, Array]:
    """Find the directions in which landings move the coordinates, how far, and which matter.

    Directions in which they hardly move are left out: those that carry, together, less than
    `UNMOVED` of the root mean square of the motion.

    Parameters
    ----------
    histories : sequence of (m, nt) arrays
        Coordinates over some landings; each counts alike, by its largest norm.  None at all
        leaves the coordinates as they are.

    Returns
    -------
    (m, k) array, (k,) array
        Orthonormal columns, least moved first, and the root mean square along each, positive.
    """
    if not histories:
        return np.eye(size), np.ones(size)
    covariance = np.zeros((size, size))
    for history in histories:
        scaled = history.astype(np.float64) / np.linalg.norm(history, axis=0).max()
        covariance += scaled @ scaled.T / (scaled.shape[1] * len(histories))
    squares, axes = np.linalg.eigh(covariance)
    squares = np.maximum(squares, 0.0)
    first = int(np.searchsorted(np.cumsum(squares), UNMOVED**2 * squares.sum()))
    squares, axes = squares[first:], axes[:, first:]
    return axes, np.sqrt(np.maximum(squares, _LEAST_SPREAD**2 * squares[-1]))


def compressed(rows: StressRows, spread: Array) -> ReducedStress:
    """Compress all rows, the coordinates weighed by ``spread`` (m,)."""
    scale = ((spread / spread.max()) ** SCALING).astype(np.float32)
    rows = StressRows(rows.shells * scale, rows.beams * scale, rows.points)
    spread = spread / scale
    no_points = np.zeros((len(rows.shells), 0, 5), dtype=np.float32)
    patterns, shares, counts, dropped = [], [], [], []
    squares: list[list[Array]] = [[], []]
    for kind, (exact, points) in enumerate(((rows.shells, no_points), (rows.beams, rows.points))):
        for start in range(0, len(exact), BLOCK):
            part = slice(start, start + BLOCK)
            weighed = exact[part].astype(np.float64) * spread
            kept = _leading(weighed, points[part])
            share = weighed.reshape(-1, len(spread)) @ kept
            rest = weighed - (share @ kept.T).reshape(weighed.shape)
            pattern = kept.T / spread
            patterns.append(pattern)
            shares.append(share.ravel())
            counts.append(len(pattern))
            dropped.append(np.sqrt(measure_squares(rest, points[part]).max(axis=1)))
            factored = (share @ pattern).reshape(weighed.shape)
            squares[kind].append(measure_squares(factored, points[part]))
    return ReducedStress(
        scale=scale,
        spread=spread,
        shell_rows=rows.shells,
        beam_rows=rows.beams,
        beam_points=rows.points,
        pattern_counts=np.array(counts, dtype=np.int64),
        patterns=_joined(patterns, (0, len(spread))),
        shares=_joined(shares, (0,)),
        shell_squares=_joined(squares[0], (0, 2)),
        beam_squares=_joined(squares[1], (0, 8)),
        dropped=_joined(dropped, (0,)),
    )


def _leading(weighed: Array, points: Single) -> Array:
    """Orthonormal directions (m, r) that carry a block's rows (n, 6, m), every element alike."""
    norms = np.sqrt(measure_squares(weighed, points).max(axis=1))
    alike = weighed / np.where(norms > 0.0, norms, 1.0)[:, None, None]
    flat = alike.reshape(-1, weighed.shape[2])
    values, directions = np.linalg.eigh(flat.T @ flat)
    left = np.cumsum(np.maximum(values, 0.0))
    leading: Array = directions[:, np.searchsorted(left, DROPPED**2 * len(weighed)) :]
    return leading


def _joined(parts: list[Array], empty: tuple[int, ...]) -> Single:
    joined = np.concatenate(parts) if parts else np.zeros(empty)
    return np.ascontiguousarray(joined, dtype=np.float32)
