"""Whether the nose wheel was on the ground as the main wheels came back from a hop."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.stats import norm

from solver.flight_data.geometry import Geometry
from solver.flight_data.lever import rise
from solver.flight_data.touchdown import Estimate, TouchdownState
from solver.frames import body_structural
from solver.gear.place import Place
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS

#: A nose wheel touches along with the main wheels if it does so no longer before them [s].
_TOGETHER = 0.15

#: A wheel may be on the ground if its height is less than so many standard deviations.
_MAY_BE_DOWN = 2.0

_PITCH = CONTACT_COMPONENTS.index("pitch")


def nose_wheel_is_down(
    state: TouchdownState, time: float, touched: Sequence[float], geometry: Geometry
) -> bool:
    """Whether to take the nose wheel for one that had been down before a bounce.

    Where it may be, it is: in a simulation its height follows from the attitude, and one that is in
    the air stays there.  One that came down along with the main wheels has yet to be stopped by its
    own strut, from the ground on.

    Parameters
    ----------
    state : TouchdownState
        At the bounce.
    time : float
        Of the bounce [s].
    touched : sequence of float
        Times at which a nose wheel touched [s].
    geometry : Geometry
    """
    if not geometry.of(Place.NOSE) or any(0.0 <= time - each < _TOGETHER for each in touched):
        return False
    return _height(state, geometry) < _MAY_BE_DOWN * _wheel_base(geometry) * state.pitch.sd


def within_travel(state: TouchdownState, geometry: Geometry) -> TouchdownState:
    """State at a bounce, given that the nose wheel is no deeper than its strut can close.

    Mean and covariance are those of the Gaussian cut off there.

    Parameters
    ----------
    state : TouchdownState
    geometry : Geometry

    Notes
    -----
    D. Simon, Optimal State Estimation (2006), sec. 7.5.4 (truncated probability density).
    """
    base = _wheel_base(geometry)
    deviation = base * state.pitch.sd
    bound = (-geometry.nose_travel - _height(state, geometry)) / deviation
    # Moments of a standard normal above `bound`.
    mean = float(np.exp(norm.logpdf(bound) - norm.logsf(bound)))
    lost = mean * (mean - bound)
    slope = base * state.covariance[:, _PITCH] / deviation
    covariance = state.covariance - lost * np.outer(slope, slope)
    values: dict[str, Any] = {
        name: Estimate(getattr(state, name).value + mean * float(change), float(np.sqrt(variance)))
        for name, change, variance in zip(
            CONTACT_COMPONENTS, slope, np.diag(covariance), strict=True
        )
    }
    return replace(state, covariance=covariance, **values)


def _height(state: TouchdownState, geometry: Geometry) -> float:
    """Height of the extended nose wheel, the lowest main wheel being on the ground [m]."""
    heights = {
        wheel.gear: rise(
            body_structural(wheel.position - geometry.centre_of_gravity),
            state.pitch.value,
            state.roll.value,
        )
        for wheel in geometry.wheels
    }
    lowest = min(float(heights[wheel.gear]) for wheel in geometry.mains)
    return min(float(heights[wheel.gear]) for wheel in geometry.of(Place.NOSE)) - lowest


def _wheel_base(geometry: Geometry) -> float:
    """How much higher each rad of pitch lifts the nose wheel than the main wheels [m]."""
    nose = min(float(wheel.position[0]) for wheel in geometry.of(Place.NOSE))
    return max(float(wheel.position[0]) for wheel in geometry.mains) - nose
