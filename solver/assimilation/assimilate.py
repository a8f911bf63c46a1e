"""The one public call: the recorded responses correct what was believed of the contacts."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest

import numpy as np

from solver.arrays import Array
from solver.assimilation.contact_update import CorrectedContact, corrected
from solver.assimilation.misfit import Misfit
from solver.assimilation.model_error import ModelError
from solver.assimilation.parameters import ServiceScatter, contact_with
from solver.assimilation.samples import response_after
from solver.assimilation.state import Believed
from solver.errors import SolverError
from solver.flight_data.contacts import ContactKind
from solver.flight_data.geometry import Geometry
from solver.flight_data.parameter import Parameter
from solver.flight_data.reconstruction import FoundContact, Reconstruction
from solver.flight_data.window import Window
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS, ContactUncertainty
from solver.landing.sequence import passage

#: How long after a contact its response is compared: the shock, and the first swing after it [s].
SPAN = 0.8

#: Before the next contact so soon nothing of a shock is in the samples [s].
_SHORTEST = 0.25

#: The simulation of the contact before brings these wheels down by itself.
FOLLOWING = (ContactKind.DEROTATION, ContactKind.MAINS, ContactKind.ONE_GEAR)


@dataclass(frozen=True, slots=True)
class ContactUpdate:
    """One contact before and after its response was looked at."""

    found: FoundContact
    prior: Contact
    prior_uncertainty: ContactUncertainty
    corrected: CorrectedContact | None  #: None: nothing could be compared
    unchanged_because: str  #: why the state stays as it was; "" if it was corrected

    @property
    def misfit(self) -> Misfit | None:
        """Of the response, None if nothing could be compared."""
        return None if self.corrected is None else self.corrected.misfit

    @property
    def is_corrected(self) -> bool:
        """Whether the state to go on with is the corrected one."""
        return self.corrected is not None and not self.unchanged_because

    @property
    def contact(self) -> Contact:
        """The state to go on with: corrected only by a response that can be explained."""
        return self.corrected.contact if self.corrected and self.is_corrected else self.prior

    @property
    def uncertainty(self) -> ContactUncertainty:
        """Of `contact`."""
        if self.corrected and self.is_corrected:
            return self.corrected.uncertainty
        return self.prior_uncertainty

    @property
    def deviations(self) -> dict[str, float]:
        """Standard deviation of each parameter by name, after the update; empty without one."""
        parameters = () if self.corrected is None else self.corrected.parameters
        return {parameter.name: parameter.posterior_sd for parameter in parameters}


@dataclass(frozen=True, slots=True)
class Assimilation:
    """All contacts of a window, each with what its response tells."""

    updates: tuple[ContactUpdate, ...]

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """State of each contact, in order."""
        return tuple(update.contact for update in self.updates)

    @property
    def uncertainties(self) -> tuple[ContactUncertainty, ...]:
        """Of each of `contacts`."""
        return tuple(update.uncertainty for update in self.updates)

    @property
    def misfit(self) -> Misfit | None:
        """The least probable one, None if nothing could be compared."""
        found = [update.misfit for update in self.updates if update.misfit is not None]
        return min(found, key=lambda misfit: misfit.probability, default=None)

    @property
    def unexplained(self) -> tuple[str, ...]:
        """One sentence for each response that the stated uncertainties cannot explain."""
        return tuple(
            f"contact {number}: {update.misfit.text}"
            for number, update in enumerate(self.updates, 1)
            if update.misfit is not None and not update.misfit.is_explained
        )


def assimilate(
    window: Window,
    reconstruction: Reconstruction,
    aircraft: LandingAircraft,
    geometry: Geometry,
    scatter: ServiceScatter | None = None,
    model_error: ModelError | None = None,
) -> Assimilation:
    """Correct the contacts of a window by the responses that were recorded after them.

    Parameters
    ----------
    window : Window
    reconstruction : Reconstruction
        Of that window: the contacts as they are known from before and around them.
    aircraft : LandingAircraft
        In the loading of the landing.
    geometry : Geometry
        As the reconstruction used it.
    scatter : ServiceScatter, optional
    model_error : ModelError, optional

    Returns
    -------
    Assimilation
        One update for each contact out of the air; the wheels that follow belong to it.  A later
        contact goes on with the wheels and the course of the lift that the one before leaves.
    """
    updates: list[ContactUpdate] = []
    scatter, model_error = scatter or ServiceScatter(), model_error or ModelError()
    untouched = uncorrected(reconstruction, "").updates
    for update, following in zip_longest(untouched, untouched[1:]):
        if updates:
            update = _with_lift_of(updates[-1], update)
        until = math.inf if following is None else following.found.time - update.found.time
        before = [each.contact for each in updates]
        try:
            believed = Believed(
                aircraft=aircraft,
                geometry=geometry,
                contact=update.prior,
                covariance=update.found.state.covariance,
                instant_sd=update.found.time_sd,
                scatter=scatter,
                wheel_speeds=_wheel_speeds(aircraft, [*before, update.prior]),
            )
        except SolverError as error:
            why = f"a contact before it cannot be simulated: {error}"
            updates.append(replace(update, unchanged_because=why))
            continue
        answer, why = _answer(
            window, reconstruction, update.found, believed, min(SPAN, until), model_error
        )
        if answer is not None:
            answer = _with_lift_course(answer, update.prior_uncertainty)
            if not answer.misfit.is_explained:
                why = "the stated uncertainties cannot explain the recorded response"
        updates.append(replace(update, corrected=answer, unchanged_because=why))
    return Assimilation(tuple(updates))


def _wheel_speeds(aircraft: LandingAircraft, contacts: Sequence[Contact]) -> Array | None:
    """Speeds with which the wheels come to the last of some contacts, (n_gears,) [rad/s]."""
    history = None
    for number, contact in enumerate(contacts[:-1]):
        history = passage(contacts, number, history).simulate(aircraft, contact)
    return passage(contacts, len(contacts) - 1, history).wheel_speeds


def _with_lift_of(before: ContactUpdate, later: ContactUpdate) -> ContactUpdate:
    """Later contact with the course of the lift that the response to the one before tells."""
    course = before.contact.lift.seen_from(later.prior.time - before.prior.time)
    lift = replace(course, fraction=later.prior.lift.fraction)
    known = before.uncertainty.lift_course
    return replace(
        later,
        prior=replace(later.prior, lift=lift),
        prior_uncertainty=replace(later.prior_uncertainty, lift_course=known),
    )


def _with_lift_course(answer: CorrectedContact, prior: ContactUncertainty) -> CorrectedContact:
    """Corrected contact that says how well the course of the lift is known by now."""
    sd = {parameter.name: parameter.posterior_sd for parameter in answer.parameters}
    start = answer.contact.lift.decay_start
    course = (
        # When the decay began before the contact, its response does not say.
        start * sd["decay_start"] if start > 0.0 else prior.lift_course[0],
        sd["decay_time"],
        sd["residual_lift"],
    )
    return replace(answer, uncertainty=replace(answer.uncertainty, lift_course=course))


def uncorrected(reconstruction: Reconstruction, why: str) -> Assimilation:
    """Contacts as they are known without their responses; ``why`` nothing was compared."""
    landed = [found for found in reconstruction.contacts if found.kind not in FOLLOWING]
    return Assimilation(
        tuple(
            ContactUpdate(
                found=found,
                prior=contact_of(found, landed[0].time),
                prior_uncertainty=ContactUncertainty.from_matrix(found.state.covariance),
                corrected=None,
                unchanged_because=why,
            )
            for found in landed
        )
    )


def contact_of(found: FoundContact, first_time: float) -> Contact:
    """Contact as reconstructed, within the range that a contact may have."""
    values = np.array([getattr(found.state, name).value for name in CONTACT_COMPONENTS])
    time = found.time - first_time
    contact = Contact(
        0.0,
        0.0,
        lift=Lift().seen_from(time),
        time=time,
        nose_wheel_down=found.nose_wheel_down,
    )
    return contact_with(contact, values)


def _answer(
    window: Window,
    reconstruction: Reconstruction,
    found: FoundContact,
    believed: Believed,
    span: float,
    model_error: ModelError,
) -> tuple[CorrectedContact | None, str]:
    """Corrected contact, or why there is none."""
    if not np.all(np.isfinite(found.state.covariance)):
        return None, "a part of its state is not known at all"
    if span < _SHORTEST:
        return None, f"the next contact follows after {span:.2f} s"
    normal = window.first(Parameter.NORMAL_ACCELERATION)
    interval = 1.0 / normal.rate if normal is not None and normal.rate > 0 else np.inf
    # In a hop lift goes and a nose wheel takes up load, which the simulation begins after.
    is_flown = believed.wheel_speeds is None
    response = response_after(
        window,
        found.time,
        interval + 2.0 * found.time_sd if is_flown else 0.0,
        span,
        reconstruction.datum,
        model_error,
    )
    if response is None:
        return None, "normal acceleration has no two samples after it"
    answer = corrected(believed, response, span)
    return answer, "" if answer is not None else "it cannot be simulated"
