"""What other hypotheses that remain possible add to the deviations of the likeliest one."""

from collections.abc import Sequence

import numpy as np

from solver.arrays import Array
from solver.flight_data.touchdown import Estimate, TouchdownState
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS


def widened(estimate: Estimate, others: Sequence[tuple[float, Estimate]]) -> Estimate:
    """Keep a value and give it the deviation of a mixture about it.

    Parameters
    ----------
    estimate : Estimate
        Of the likeliest hypothesis.
    others : sequence of (chance, Estimate)
        Of the others; what their chances leave to one is that of the likeliest.

    Returns
    -------
    Estimate

    Notes
    -----
    Second moment of a mixture (Y. Bar-Shalom, X. R. Li, T. Kirubarajan, Estimation with
    Applications to Tracking and Navigation (2001), eq. 1.4.16-9), about the likeliest value instead
    of the mean, which may lie where no hypothesis does.
    """
    variance = (1.0 - sum(chance for chance, _ in others)) * estimate.sd**2
    for chance, other in others:
        variance += chance * (other.sd**2 + (other.value - estimate.value) ** 2)
    return Estimate(estimate.value, float(np.sqrt(variance)))


def widened_state(
    state: TouchdownState, others: Sequence[tuple[float, TouchdownState]]
) -> TouchdownState:
    """Keep the values of a state and give it the covariance of a mixture about them, as `widened`.

    Parameters
    ----------
    state : TouchdownState
    others : sequence of (chance, TouchdownState)
    """

    def values(each: TouchdownState) -> Array:
        return np.array([getattr(each, name).value for name in CONTACT_COMPONENTS])

    covariance = (1.0 - sum(chance for chance, _ in others)) * state.covariance
    for chance, other in others:
        apart = values(other) - values(state)
        covariance = covariance + chance * (other.covariance + np.outer(apart, apart))
    gears = {
        gear: widened(estimate, [(p, other.gear_sink_rates[gear]) for p, other in others])
        for gear, estimate in state.gear_sink_rates.items()
    }

    def component(name: str) -> Estimate:
        return widened(getattr(state, name), [(p, getattr(other, name)) for p, other in others])

    return TouchdownState(
        sink_rate=component("sink_rate"),
        gear_sink_rates=gears,
        pitch=component("pitch"),
        roll=component("roll"),
        drift=component("drift"),
        ground_speed=component("ground_speed"),
        pitch_rate=component("pitch_rate"),
        roll_rate=component("roll_rate"),
        yaw_rate=component("yaw_rate"),
        lift_fraction=component("lift_fraction"),
        covariance=covariance,
        assumed=state.assumed,
    )
