"""Loadings that stand for an uncertain mass and centre of gravity.

Every loading has its own mass matrix and modes, so that it is drawn from five points: the loading
as stated with 1/3, and sqrt(3) deviations of each variable to either side with 1/6 (Julier, Uhlmann
and Durrant-Whyte, "A new method for the nonlinear transformation of means and covariances", IEEE
Transactions on Automatic Control 45, 2000, with n + kappa = 3).  Means, variances, third moments
and each variable's fourth are those of the normal distribution.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import ndtr

from solver.aircraft.airframe import Airframe
from solver.aircraft.loading import Loading, balance, spread
from solver.arrays import Array
from solver.assessment import TouchdownRecord

#: Standard deviation of a gross mass that is stated without one, and of one that is not stated.
STATED_MASS, UNSTATED_MASS = 0.01, 0.05
#: Of the centre of gravity where none is given, share of the mean aerodynamic chord.
CENTRE_OF_GRAVITY = 0.02
#: Upper ends of the shares of a uniform variable: light, forward, as stated, aft, heavy.
_ENDS = np.array([1.0, 2.0, 4.0, 5.0]) / 6.0
#: The point of the loading as stated.
CENTRE = 2


@dataclass(frozen=True, slots=True)
class LoadingPoints:
    """Fill factors of the five points: light, forward, as stated, aft, heavy."""

    factors: tuple[Array, ...]

    @staticmethod
    def point_of(normal: float) -> int:
        """Which point a standard normal variable draws."""
        return int(np.searchsorted(_ENDS, ndtr(normal), side="right"))


def loading_points(airframe: Airframe, record: TouchdownRecord, loading: Loading) -> LoadingPoints:
    """Spread the loading of a record by the deviations of its mass and centre of gravity.

    What tanks and bays cannot take up is left out: no aircraft flies with more or less than fits.
    """
    states = airframe.mass_states
    if not states.groups:
        return LoadingPoints((loading.factors,) * 5)
    capacities = states.capacities
    masses = loading.factors * capacities
    everywhere = np.ones(len(masses), dtype=bool)
    share = UNSTATED_MASS if record.mass is None else STATED_MASS
    mass = record.mass_deviation
    mass = share * loading.mass if mass is None else mass
    chord = airframe.definition.reference.mean_chord
    station = record.centre_of_gravity_deviation
    station = CENTRE_OF_GRAVITY * chord if station is None else station
    stations = np.array([group.moments.first[0] for group in states.groups]) / capacities
    step = np.sqrt(3.0)

    def heavier(change: float) -> Array:
        return spread(change, masses, capacities, everywhere)[0] / capacities

    def further_aft(change: float) -> Array:
        moved = balance(masses, capacities, stations, everywhere, change * loading.mass)
        return moved / capacities

    return LoadingPoints(
        (
            heavier(-step * mass),
            further_aft(-step * station),
            loading.factors,
            further_aft(step * station),
            heavier(step * mass),
        )
    )
