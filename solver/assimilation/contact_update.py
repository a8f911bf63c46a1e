"""One contact corrected by the response that was recorded after it."""

from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2

from solver.arrays import Array
from solver.assimilation.forward import LandingPrediction
from solver.assimilation.misfit import Misfit, ParameterUpdate, misfit_of, pull
from solver.assimilation.samples import Response
from solver.assimilation.state import INSTANT, Believed, Prior, prior, simulated, unit_of
from solver.assimilation.update import Update, gauss_newton, mixed, twice_cost, widened
from solver.landing.contact import Contact
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS, ContactUncertainty

#: Where the iteration may begin, in standard deviations: which wheel touches first, and when,
#: decides on which flank of the shock each sample lies.
_ROLLS = (0.0, -1.5, 1.5)
_INSTANTS = np.linspace(-2.5, 2.5, 11)

#: Probability of a misfit below which another beginning is tried, and chi-square over the number
#: of samples above which none would help.
_POOR = 0.05
_HOPELESS = 10.0

#: The other way of touching is tried if its roll is no further off, in standard deviations.
_PLAUSIBLE = 3.5

#: With less roll than this both ways are one, in standard deviations.
_LEVEL = 0.3

_STATE = len(CONTACT_COMPONENTS)
_ROLL = CONTACT_COMPONENTS.index("roll")


@dataclass(frozen=True, slots=True)
class CorrectedContact:
    """What the response makes of a contact."""

    contact: Contact
    uncertainty: ContactUncertainty
    parameters: tuple[ParameterUpdate, ...]  #: all that were estimated along with the state
    misfit: Misfit


def corrected(believed: Believed, response: Response, span: float) -> CorrectedContact | None:
    """Update what is believed of a contact.

    Parameters
    ----------
    believed : Believed
    response : Response
    span : float
        How long after the contact the samples reach [s].

    Returns
    -------
    CorrectedContact or None
        None if the contact cannot be simulated.
    """
    start = prior(believed, response.channels)
    # Samples are shown a little later if the contact was earlier than found.
    last = span + 3.0 * believed.instant_sd
    prediction = LandingPrediction(start, response.channels, last)
    update = _found(start, prediction, response)
    before = prediction.by_channel(np.zeros(len(start.names)))
    after = None if update is None else prediction.by_channel(update.parameters)
    if update is None or before is None or after is None:
        return None
    parameters = _parameters(start, update)
    return CorrectedContact(
        contact=simulated(start, start.named(update.parameters))[1],
        uncertainty=_uncertainty(start.covariance(update.covariance)),
        parameters=parameters,
        misfit=misfit_of(response, update, parameters, before, after),
    )


def _found(start: Prior, prediction: LandingPrediction, response: Response) -> Update | None:
    """Posterior, with the other wheel first as well where that may have been."""
    measured, whiten = response.measured, response.whiten
    found = None
    for begin in _beginnings(start, prediction, measured, whiten):
        other = gauss_newton(prediction, measured, whiten, begin)
        if found is None or (other is not None and other.chi_square < found.chi_square):
            found = other
        if found is None:
            continue
        is_good = chi2.sf(found.chi_square, len(measured)) > _POOR
        if is_good or found.chi_square > _HOPELESS * len(measured):
            break
    if found is None or found.chi_square > _HOPELESS * len(measured):
        return found
    found = widened(prediction, whiten, found)
    # Accelerations show how long after the first wheel the second came, but hardly which it was.
    scale = start.root[_ROLL, _ROLL]
    roll = start.named(found.parameters)["roll"]
    mirrored = found.parameters.copy()
    mirrored[_ROLL] -= 2.0 * roll / scale
    if abs(roll) < _LEVEL * scale or abs(mirrored[_ROLL]) > _PLAUSIBLE:
        return found
    other = gauss_newton(prediction, measured, whiten, mirrored)
    return found if other is None else mixed(found, other)


def _beginnings(
    start: Prior, prediction: LandingPrediction, measured: Array, whiten: Array
) -> list[Array]:
    """Best instant for each roll that is tried, the most promising roll first."""
    instant = start.names.index(INSTANT)
    found = []
    for roll in _ROLLS:
        trials = np.zeros((len(_INSTANTS), len(start.names)))
        trials[:, _ROLL], trials[:, instant] = roll, _INSTANTS
        costs = [_cost(prediction, measured, whiten, trial) for trial in trials]
        found.append((min(costs), trials[int(np.argmin(costs))]))
    return [trial for _, trial in sorted(found, key=lambda each: each[0])]


def _cost(prediction: LandingPrediction, measured: Array, whiten: Array, trial: Array) -> float:
    predicted = prediction(trial)
    return np.inf if predicted is None else twice_cost(trial, predicted, measured, whiten)


def _uncertainty(covariance: Array) -> ContactUncertainty:
    state = covariance[:_STATE, :_STATE]
    return ContactUncertainty.from_matrix((state + state.T) / 2.0)


def _parameters(start: Prior, update: Update) -> tuple[ParameterUpdate, ...]:
    identity = np.eye(len(start.names))
    before = np.sqrt(np.diag(start.covariance(identity)))
    after = np.sqrt(np.diag(start.covariance(update.covariance)))
    # A move scatters by what the samples took off the variance, and off no more than the tangent
    # says.
    taken = np.diag(start.covariance(identity - update.straight))
    values = start.named(update.parameters)
    return tuple(
        ParameterUpdate(
            name,
            unit_of(name),
            float(start.mean[index]),
            float(before[index]),
            values[name],
            float(after[index]),
            pull(values[name] - start.mean[index], before[index], taken[index]),
        )
        for index, name in enumerate(start.names)
    )
