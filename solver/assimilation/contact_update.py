"""One contact corrected by the response that was recorded after it."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.assimilation.forward import LandingPrediction
from solver.assimilation.misfit import Misfit, misfit_of
from solver.assimilation.samples import Response
from solver.assimilation.state import INSTANT, Believed, Prior, prior, simulated
from solver.assimilation.update import Update, gauss_newton, mixed, widened
from solver.landing.contact import Contact
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS, ContactUncertainty

#: Where the instant is tried first, in its standard deviations: no simulation is needed for that,
#: and a wrong one puts the samples onto another flank of the shock.
_INSTANTS = np.linspace(-2.5, 2.5, 11)

#: The other way of touching is tried if its roll is no further off, in standard deviations.
_PLAUSIBLE = 3.5

#: With less roll than this both ways are one, in standard deviations.
_LEVEL = 0.3

_STATE = len(CONTACT_COMPONENTS)
_ROLL = CONTACT_COMPONENTS.index("roll")


@dataclass(frozen=True, slots=True)
class ParameterUpdate:
    """One parameter before and after."""

    name: str
    prior: float
    prior_sd: float
    posterior: float
    posterior_sd: float


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
    return CorrectedContact(
        contact=simulated(start, start.named(update.parameters))[1],
        uncertainty=_uncertainty(start.covariance(update.covariance)),
        parameters=_parameters(start, update),
        misfit=misfit_of(response, update, before, after),
    )


def _found(start: Prior, prediction: LandingPrediction, response: Response) -> Update | None:
    """Posterior, with the other wheel first as well where that may have been."""
    measured, whiten = response.measured, response.whiten
    begin = _best_instant(start, prediction, measured, whiten)
    found = None if begin is None else gauss_newton(prediction, measured, whiten, begin)
    if found is None:
        return None
    found = widened(prediction, whiten, found)
    # Accelerations show how long after the first wheel the second came, but hardly which it was.
    scale = start.root[_ROLL, _ROLL]
    roll = start.named(found.parameters)["roll"]
    mirrored = found.parameters.copy()
    mirrored[_ROLL] -= 2.0 * roll / scale
    if abs(roll) < _LEVEL * scale or abs(mirrored[_ROLL]) > _PLAUSIBLE:
        return found
    other = gauss_newton(prediction, measured, whiten, mirrored)
    return found if other is None else mixed(found, widened(prediction, whiten, other))


def _best_instant(
    start: Prior, prediction: LandingPrediction, measured: Array, whiten: Array
) -> Array | None:
    best, least = None, np.inf
    for guess in _INSTANTS:
        trial = np.zeros(len(start.names))
        trial[start.names.index(INSTANT)] = guess
        predicted = prediction(trial)
        if predicted is None:
            return None
        residual = whiten @ (measured - predicted)
        if (cost := float(residual @ residual) + guess**2) < least:
            best, least = trial, cost
    return best


def _uncertainty(covariance: Array) -> ContactUncertainty:
    state = covariance[:_STATE, :_STATE]
    return ContactUncertainty.from_matrix((state + state.T) / 2.0)


def _parameters(start: Prior, update: Update) -> tuple[ParameterUpdate, ...]:
    before = np.sqrt(np.diag(start.covariance(np.eye(len(start.names)))))
    after = np.sqrt(np.diag(start.covariance(update.covariance)))
    values = start.named(update.parameters)
    return tuple(
        ParameterUpdate(name, float(mean), float(prior_sd), values[name], float(sd))
        for name, mean, prior_sd, sd in zip(start.names, start.mean, before, after, strict=True)
    )
