"""Compress basis and stress rows for the motions that landings cause.

The basis is made for any load at every place.  Of what it spans, directions in which no landing
moves more than a trace are left out (`principal_axes`).

The rows of a block of elements are factored (`compressed`): the factors are their leading singular
vectors, every element alike, the coordinates weighed by how far landings move them.  Here the
landings decide only how narrow the bounds of the peak search are; its answers do not rest on them.

Source: Eckart and Young, "The approximation of one matrix by another of lower rank", 1936.
"""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from solver.arrays import Array, Single
from solver.inertia_relief.reduced_stress import (
    BLOCK,
    COORDINATE_GROUP,
    PATTERN_GROUP,
    ReducedStress,
    group_edges,
)
from solver.inertia_relief.rounded_rows import rounded
from solver.inertia_relief.stress_rows import StressRows, measure_squares

#: Root mean square of what is dropped over a block's elements, relative to each one's own rows.
DROPPED = 3e-3
#: The same beyond the leading patterns.
BEYOND_LEADING = 1.2e-2
#: Share of the motion in landings that the directions left out may carry, as it is measured.
UNMOVED = 8e-5
#: Power of the spread by which coordinates are divided; 0 keeps them, 1 makes them alike.
SCALING = 0.5
#: A coordinate counts as moved by at least this share of the most moved one.
_LEAST_SPREAD = 3e-5
#: Numbers of patterns are multiples of this, so that sums over them fill vector registers.
_LANES = 16


def principal_axes(
    histories: Sequence[Single], size: int, measure: Callable[[Array], Array] | None = None
) -> tuple[Array, Array]:
    """Find the directions in which landings move the coordinates, how far, and which matter.

    Directions in which they hardly move are left out: those that carry, together, less than
    `UNMOVED` of the root mean square of the motion.

    Parameters
    ----------
    histories : sequence of (m, nt) arrays
        Coordinates over some landings; each counts alike, by its largest norm.  None at all
        leaves the coordinates as they are.
    measure : callable
        Gives the matrix N (m, m) in whose norm ``z' N z`` motion is measured from its covariance.
        By default that is the strain energy.

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
    lower = np.eye(size) if measure is None else np.linalg.cholesky(measure(covariance))
    squares, directions = np.linalg.eigh(lower.T @ covariance @ lower)
    squares = np.maximum(squares, 0.0)
    first = int(np.searchsorted(np.cumsum(squares), UNMOVED**2 * squares.sum()))
    kept = np.linalg.qr(np.linalg.solve(lower.T, directions[:, first:]))[0]
    squares, axes = np.linalg.eigh(kept.T @ covariance @ kept)
    squares, axes = np.maximum(squares, 0.0), kept @ axes
    return axes, np.sqrt(np.maximum(squares, _LEAST_SPREAD**2 * squares[-1]))


def compressed(rows: StressRows, spread: Array) -> ReducedStress:
    """Compress all rows, the coordinates weighed by ``spread`` (m,), least moved first."""
    scale = ((spread / spread.max()) ** SCALING).astype(np.float32)
    shells, beams = rounded(rows.shells * scale), rounded(rows.beams * scale)
    spread = spread / scale
    no_points = np.zeros((len(rows.shells), 0, 5), dtype=np.float32)
    patterns, shares, shapes, rests = [], [], [], []
    parts: list[tuple[Array, Single]] = []
    for kind, points in ((shells, no_points), (beams, rows.points)):
        for start in range(0, len(kind), BLOCK):
            part = slice(start, start + BLOCK)
            exact = kind[part].exact().astype(np.float64)
            kept, leading = _leading(exact * spread, points[part])
            known = len(kept)
            share = (exact[:, :, -known:] * spread[-known:]).reshape(-1, known) @ kept
            pattern = kept.T / spread[-known:]
            factored = np.zeros(exact.shape)
            factored[:, :, -known:] = (share @ pattern).reshape(len(exact), 6, known)
            # groups count from the most moved coordinate, the last one
            rests.append(
                np.hstack(
                    [
                        group_norms(field[:, :, ::-1], points[part], COORDINATE_GROUP)
                        for field in (exact - factored, factored)
                    ]
                )
            )
            patterns.append(pattern.ravel())
            shares.append(share.ravel())
            shapes.append((*pattern.shape, leading))
            parts.append((share.reshape(len(exact), 6, -1), points[part]))
    widest = max((len(group_edges(count, PATTERN_GROUP)) - 1 for count, *_ in shapes), default=0)
    return ReducedStress(
        scale=scale,
        shell_numbers=shells.numbers,
        shell_step=shells.step,
        beam_numbers=beams.numbers,
        beam_step=beams.step,
        beam_points=rows.points,
        pattern_shapes=np.array(shapes, dtype=np.int64).reshape(-1, 3),
        patterns=_joined(patterns, (0,)),
        shares=_joined(shares, (0,)),
        pattern_norms=_joined(
            [_padded(group_norms(*part, PATTERN_GROUP), widest) for part in parts], (0, widest)
        ),
        rest_norms=_joined(rests, (0, 2 * (len(group_edges(len(spread))) - 1))),
    )


def group_norms(rows: NDArray[Any], points: Single, group: int) -> Array:
    """Largest stress (n, groups) for unit norm of each group of the columns of rows (n, 6, k)."""
    edges = group_edges(rows.shape[2], group)
    norms: Array = np.stack(
        [
            np.sqrt(measure_squares(rows[:, :, first:last], points).max(axis=1))
            for first, last in pairwise(edges)
        ],
        axis=1,
    )
    return norms


def _leading(weighed: Array, points: Single) -> tuple[Array, int]:
    """Orthonormal directions (h, r) that carry a block's rows (n, 6, m), every element alike.

    They are combinations of the last h coordinates, leading ones first; the number is of those
    that suffice for an estimate.  What the other coordinates carry and what is not along the
    directions are together `DROPPED`.
    """
    norms = np.sqrt(measure_squares(weighed, points).max(axis=1))
    alike = (weighed / np.where(norms > 0.0, norms, 1.0)[:, None, None]).reshape(
        -1, weighed.shape[2]
    )
    limit = DROPPED**2 * len(weighed) / 2
    known = _lanes(np.square(alike).sum(axis=0), limit)
    alike = alike[:, -known:]
    values, directions = np.linalg.eigh(alike.T @ alike)
    values = np.maximum(values, 0.0)
    kept: Array = directions[:, ::-1][:, : _lanes(values, limit)]
    return kept, _lanes(values, BEYOND_LEADING**2 * len(weighed))


def _lanes(squares: Array, limit: float) -> int:
    """How many of the last ``squares`` leave no more than ``limit`` out, in whole `_LANES`."""
    count = len(squares) - int(np.searchsorted(np.cumsum(squares), limit))
    return min(len(squares), -(-max(1, count) // _LANES) * _LANES)


def _padded(norms: Array, width: int) -> Array:
    return np.pad(norms, ((0, 0), (0, width - norms.shape[1])))


def _joined(parts: list[Array], empty: tuple[int, ...]) -> Single:
    joined = np.concatenate(parts) if parts else np.zeros(empty)
    return np.ascontiguousarray(joined, dtype=np.float32)
