"""What each term of a turning frame was worth: the same landing with it left out.

Eq (15) has the frame's rotation on both sides: W terms of the elastic motion u (Coriolis with the
gyroscopic moments, Euler, centrifugal), and those of the undeformed position r as loads (Euler,
centrifugal with w x J w).  Terms are left out of the coefficients of the reduced model alone; the
loads and the rigid motion stay those of the landing.
"""

from dataclasses import dataclass, replace

import numpy as np

from solver.arrays import Array
from solver.inertia_relief.loading import ReducedLoading
from solver.inertia_relief.loads import LandingLoads
from solver.inertia_relief.peaks import StressPeaks, find_peaks
from solver.inertia_relief.response import landing_response

#: Sweeps of the W terms go on until what they change is far below what the terms are worth.
TOLERANCE = 1e-6
#: Rows of the rate coefficients, and columns of the inertia loads, that belong to each term.
CORIOLIS, EULER, CENTRIFUGAL = slice(0, 3), slice(3, 6), slice(6, 12)


@dataclass(frozen=True, slots=True)
class Omission:
    """Terms that are left out."""

    name: str
    of_u: tuple[slice, ...] = ()
    of_r: tuple[slice, ...] = ()


OMISSIONS = (
    Omission("u: Coriolis and gyroscopic, 2 M W u'", of_u=(CORIOLIS,)),
    Omission("u: Euler, M W' u", of_u=(EULER,)),
    Omission("u: centrifugal, M W W u", of_u=(CENTRIFUGAL,)),
    Omission("u: all", of_u=(CORIOLIS, EULER, CENTRIFUGAL)),
    Omission("r: Euler, M W' r", of_r=(EULER,)),
    Omission("r: centrifugal, M W W r and w × J w", of_r=(CENTRIFUGAL,)),
    Omission("all", of_u=(CORIOLIS, EULER, CENTRIFUGAL), of_r=(EULER, CENTRIFUGAL)),
)


@dataclass(frozen=True, slots=True)
class Worth:
    """Changes by an omission."""

    name: str
    largest: float  #: of the peak of any element above 20 % of the global peak, relative
    everywhere: float  #: of any element's peak, relative to the global peak
    peak: float  #: of the global peak, relative, with its sign
    unbalanced: float  #: largest resultant left without its reaction, relative to the weight


def without(loading: ReducedLoading, omission: Omission) -> ReducedLoading:
    """Leave the terms out of the elastic equations of a loading.

    The rigid rows stay, so that the landing remains balanced; what they would put on the elastic
    modes through the mean axes is taken out with the rest.
    """
    model = loading.model
    operators, norms = np.array(model.rate_operators), np.array(model.rate_norms)
    for rows in omission.of_u:
        operators[:, rows] = 0.0
        norms[:, rows] = 0.0
    inertia, bounds = np.array(loading.inertia), np.array(loading.rate_norms)
    follow = loading.modes_with_rigid[:6] @ loading.modes.T
    for columns in omission.of_r:
        inertia[6:, columns] = -follow.T @ inertia[:6, columns]
    for rows in omission.of_u:
        bounds[rows] = 0.0
    return replace(
        loading,
        model=replace(model, rate_operators=operators, rate_norms=norms),
        inertia=inertia,
        rate_norms=bounds,
    )


def peaks_of(loading: ReducedLoading, loads: LandingLoads) -> StressPeaks:
    """Peaks with the W terms iterated to `TOLERANCE`."""
    return find_peaks(loading.model, landing_response(loading, loads, TOLERANCE))


def worth(loading: ReducedLoading, loads: LandingLoads, complete: StressPeaks) -> list[Worth]:
    """Measure every omission in one landing."""
    reference = complete.stress
    top = reference.max()
    stressed = reference > 0.2 * top
    found = []
    for omission in OMISSIONS:
        stress = peaks_of(without(loading, omission), loads).stress
        change = np.abs(stress - reference)
        found.append(
            Worth(
                omission.name,
                float((change / reference)[stressed].max()),
                float(change.max() / top),
                float(stress.max() / top - 1),
                float(unbalanced_wrench(loading, loads, omission).max(initial=0.0)),
            )
        )
    return found


def unbalanced_wrench(loading: ReducedLoading, loads: LandingLoads, omission: Omission) -> Array:
    """Resultant (nt,) of the omitted loads of r about the centre of gravity, over the weight."""
    motion = loads.motion.at(loading.model.origin)
    amplitudes = motion.inertia_amplitudes()
    left_out = np.zeros_like(amplitudes)
    for columns in omission.of_r:
        left_out[:, columns] = amplitudes[:, columns]
    wrench = left_out @ (loading.rigid_transfer @ loading.inertia[:6]).T
    wrench[:, 3:] /= loading.gyration_radius
    weight = loading.mass * np.linalg.norm(motion.gravity, axis=1)
    size: Array = np.linalg.norm(wrench, axis=1) / weight
    return size
