"""Published landings scaled to an aircraft's own limit sink rate, and judged contact by contact.

The accidents happened to other types, so no stress of theirs can be compared.  What carries over is
how far each contact went beyond what its aircraft was made for:

- a sink rate, as its share of the 10 ft/s that transport aircraft are designed to at the landing
  mass (14 CFR 25.473(a)), times the limit sink rate of the aircraft here;
- a normal load factor, by its increment as a share of the increment at the type's published limit:
  the sink rate at which a recorder of 8 samples a second shows the same share of the increment
  that it shows at the limit sink rate (symmetrical simulated landings of the aircraft here);
- an energy of a gear, by the root of its ratio to the certificated one, times the limit sink rate.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from solver.arrays import Array
from solver.assess import AssessmentModel, assess_landing
from solver.assessment import Assessment, TouchdownRecord
from solver.landing.contact import Contact
from solver.landing.history import LandingHistory
from solver.landing.simulate import simulate_landing
from solver.verdict.judge import SEVERITY
from verification.judging.accident_file import PublishedCase, PublishedContact

FOOT = 0.3048

#: 14 CFR 25.473(a)(2): limit descent velocity at the design landing weight [m/s].
DESIGN_SINK_RATE = 10.0 * FOOT

#: Attitude of the landings that define the limit sink rate [rad], and their speed [m/s].
_PITCH, _SPEED = math.radians(3.0), 60.0

#: Normal acceleration is recorded at least so often (14 CFR 121, appendix M) [Hz].
RECORDER_RATE = 8.0

#: To which the limit sink rate is found [m/s].
_LIMIT_TOLERANCE = 0.005

#: Sink rates of the simulated relation between sink rate and recorded peak [m/s].
_SINK_RATES = np.array([0.05, 0.3, 0.6, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 7.5, 9.0])


@dataclass(frozen=True, slots=True)
class Scale:
    """What published figures are scaled to."""

    limit_sink_rate: float  #: largest use of an allowable is 1 there [m/s]
    sink_rates: Array  #: (n,) [m/s]
    increments: Array  #: (n,) recorded peak over that at the limit sink rate, both less 1 g

    def sink_rate(self, case: PublishedCase, contact: PublishedContact) -> float:
        """Sink rate of a contact here [m/s].

        Raises
        ------
        ValueError
            A load factor stands there without the type's limit.
        """
        if not case.scaled:
            return contact.value * FOOT / 60.0
        if contact.basis == "normal_load_factor":
            if case.type_limit is None:
                raise ValueError(f"{case.name}: a load factor says nothing without type_limit")
            share = (contact.value - 1.0) / (case.type_limit.value - 1.0)
            return float(np.interp(share, self.increments, self.sink_rates))
        share = {
            "sink_rate": contact.value * FOOT / 60.0 / DESIGN_SINK_RATE,
            "energy": math.sqrt(contact.value),
            "share": contact.value,
        }[contact.basis]
        return share * self.limit_sink_rate


@dataclass(frozen=True, slots=True)
class JudgedCase:
    """A published landing, flown here."""

    case: PublishedCase
    record: TouchdownRecord
    assessment: Assessment

    @property
    def is_milder(self) -> bool:
        """Whether the verdict is milder than what the case calls for."""
        return SEVERITY[self.assessment.verdict] < SEVERITY[self.case.expected]

    @property
    def utilisation(self) -> float:
        """Largest use of an allowable or a gear's limit load."""
        return largest_utilisation(self.assessment)


def largest_utilisation(assessment: Assessment) -> float:
    """Largest use of a limit, airframe or gear: above 1 the verdict is HARD."""
    gears = [load.utilisation for load in assessment.gear_loads]
    return max(assessment.worst_utilisation, *gears)


def recorded_peak(history: LandingHistory, rate: float) -> float:
    """Largest sample of the normal load factor, averaged over where the samples fall [g]."""
    every = max(round(1.0 / rate / (history.time[1] - history.time[0])), 1)
    load_factor = history.normal_load_factor
    return float(np.mean([load_factor[phase::every].max() for phase in range(every)]))


def scale_of(model: AssessmentModel) -> Scale:
    """Limit sink rate of an aircraft at its landing mass, and the peaks that go with sink rates."""
    airframe = model.airframe
    mass = airframe.definition.masses.maximum_landing

    def utilisation(sink_rate: float) -> float:
        contact = Contact(sink_rate=sink_rate, ground_speed=_SPEED, pitch=_PITCH)
        record = TouchdownRecord(model.name, (contact,), mass=mass)
        return largest_utilisation(assess_landing(model, record))

    limit = float(
        brentq(lambda v: utilisation(v) - 1.0, 0.9 * DESIGN_SINK_RATE, 1.2 * DESIGN_SINK_RATE,
               xtol=_LIMIT_TOLERANCE)
    )  # fmt: skip
    aircraft = airframe.landing_aircraft(airframe.loading_for(mass).factors)
    sink_rates = np.sort(np.append(_SINK_RATES, limit))
    peaks = np.array(
        [
            recorded_peak(
                simulate_landing(aircraft, Contact(v, ground_speed=_SPEED, pitch=_PITCH)),
                RECORDER_RATE,
            )
            for v in sink_rates
        ]
    )
    at_limit = peaks[np.searchsorted(sink_rates, limit)]
    # The softest landings peak when lift is gone, whatever their sink rate.
    rising = np.concatenate([[True], np.diff(np.maximum.accumulate(peaks)) > 0])
    return Scale(limit, sink_rates[rising], (peaks[rising] - 1.0) / (at_limit - 1.0))


def fly_case(model: AssessmentModel, scale: Scale, case: PublishedCase) -> JudgedCase:
    """Assess a published landing on an aircraft."""
    contacts = tuple(
        Contact(
            sink_rate=scale.sink_rate(case, contact),
            ground_speed=case.ground_speed_m_s,
            pitch=math.radians(contact.pitch_deg),
            roll=math.radians(contact.roll_deg),
            drift=math.radians(contact.drift_deg),
            pitch_rate=math.radians(contact.pitch_rate_deg_s),
        )
        for contact in case.contact
    )
    mass = case.mass_share * model.airframe.definition.masses.maximum_landing
    record = TouchdownRecord(model.name, contacts, mass=mass)
    return JudgedCase(case, record, assess_landing(model, record))
