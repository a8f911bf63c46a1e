"""A flexible airframe in the form that the compiled equations read."""

from typing import NamedTuple

import numpy as np

from solver.arrays import Array
from solver.flexible_landing.modes import FlexibleAirframe
from solver.landing.records import Records


class Modes(NamedTuple):
    """Arrays of a `FlexibleAirframe`; m modes, n gears."""

    stiffness: Array  #: (m,) squares of the circular frequencies
    damping: Array  #: (m,)
    fittings: Array  #: (6 n, m)
    mobility: Array  #: (6 n, 6 n) accelerations of all fittings to unit wrenches on each
    air: Array  #: (6, m)
    products: Array  #: (6, m)
    rates: Array  #: (9 m, m) Euler, then centrifugal; without rows if left out
    pivots: Array  #: (n, 3) of the undeformed airframe [m]


def compiled_modes(flexible: FlexibleAirframe, gears: Records) -> tuple[Modes, Records]:
    """Modes for the kernels, and the gears' records about their own pivots."""
    size = flexible.size
    fittings = np.ascontiguousarray(flexible.fittings.reshape(-1, size))
    local = gears.copy()
    local["pivot"] = 0.0
    rates = np.concatenate([flexible.euler, flexible.centrifugal]).reshape(-1, size)
    modes = Modes(
        flexible.circular_frequency**2,
        np.ascontiguousarray(flexible.damping),
        fittings,
        fittings @ fittings.T,
        np.ascontiguousarray(flexible.air),
        np.ascontiguousarray(flexible.products),
        np.ascontiguousarray(rates),
        np.array(gears["pivot"]),
    )
    return modes, local
