"""What is uncertain about a landing, as independent standard normal variables.

A contact's state is its value plus a root of its covariance times standard normals, so that its
correlations hold.  Factors of gears, friction and damping are lognormal with median one.  What
physics forbids is moved to the nearest value it allows:

* a sink rate below `SOFTEST`: no aircraft lands upwards, and no softer landing can be the one that
  exceeds a limit;
* a lift above the weight, or above what the record says if that is more: with it the simulated
  aircraft flies away after the contact and drops when the lift decays, but an aircraft that did so
  has another contact in its record;
* a negative lift, and attitudes beyond what the simulation takes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from solver.aircraft.assessed_airframe import AssessedAirframe
from solver.aircraft.definition import AircraftDefinition
from solver.arrays import Array
from solver.assessment import TouchdownRecord
from solver.errors import RecordError
from solver.gear.parameters import Gear
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift, LiftModel
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS
from solver.landing.initial import RANGES
from solver.probability.loadings import CENTRE, LoadingPoints

#: Least sink rate of a sample [m/s].
SOFTEST = 0.1
#: What lift tends to, share of the weight.
_RESIDUAL_RANGE = (0.0, 1.0)
_STATES = len(CONTACT_COMPONENTS)


@dataclass(frozen=True, slots=True)
class Sample:
    """One way the landing may have been."""

    contacts: tuple[Contact, ...]
    point: int  #: which of the `LoadingPoints`
    gears: Array  #: (n_gears, 3) factors of gas pressure, strut damping and tyre stiffness
    friction: float  #: factor
    structural_damping: float  #: factor
    zone_strength: Array  #: (n_zones,) true allowable over the stated one

    @classmethod
    def as_recorded(cls, contacts: tuple[Contact, ...], definition: AircraftDefinition) -> "Sample":
        """Take the landing as its record says, on the aircraft as it is defined."""
        gears, zones = len(definition.gears), len(definition.zones)
        return cls(contacts, CENTRE, np.ones((gears, 3)), 1.0, 1.0, np.ones(zones))

    def aircraft(self, nominal: LandingAircraft) -> LandingAircraft:
        """Aircraft of this sample; ``nominal`` has its loading."""
        gears = (
            _scattered(gear, pressure, damping, stiffness, self.friction)
            for gear, (pressure, damping, stiffness) in zip(
                nominal.gears, self.gears.tolist(), strict=True
            )
        )
        return replace(nominal, gears=tuple(gears))


class LandingVariables:
    """Map from standard normal variables to samples of one landing.

    Raises
    ------
    RecordError
        The record has uncertainties, but not one for each contact.
    """

    def __init__(self, airframe: AssessedAirframe, record: TouchdownRecord) -> None:
        if len(record.uncertainties) != len(record.contacts):
            raise RecordError(
                f"uncertainties are those of {len(record.uncertainties)} contacts, the record has "
                f"{len(record.contacts)}"
            )
        definition = airframe.definition
        self._contacts = record.contacts
        self._decay_starts = _decay_starts(record.contacts)
        self._scatter = scatter = definition.scatter
        usual = (scatter.lift_decay_start, scatter.lift_decay_time, scatter.residual_lift_fraction)
        self._lift_course = [
            tuple(
                general if known is None else known
                for known, general in zip(uncertainty.lift_course, usual, strict=True)
            )
            for uncertainty in record.uncertainties
        ]
        self._friction = scatter.tyre_friction
        if record.runway_friction is not None:
            self._friction = record.runway_friction_deviation / record.runway_friction
        self._gears = len(definition.gears)
        self._zones = len(definition.zones)
        self._roots = [_root(uncertainty.matrix) for uncertainty in record.uncertainties]
        widths = [root.shape[1] for root in self._roots]
        lengths = {
            **{f"contact {number}": width for number, width in enumerate(widths)},
            "friction": 1,
            "lift": 3,
            "gears": 3 * self._gears,
            "loading": 1,
            "structural_damping": 1,
            "strength": self._zones if self._scatter.allowable > 0.0 else 0,
        }
        ends = np.cumsum(list(lengths.values())).tolist()
        starts = [0, *ends[:-1]]
        self._places = {
            name: slice(start, end) for name, start, end in zip(lengths, starts, ends, strict=True)
        }
        #: Number of variables.
        self.count = int(ends[-1])

    def sample(self, normals: Array) -> Sample:
        """Landing that belongs to standard normal variables (count,)."""
        scatter = self._scatter
        part = {name: normals[place] for name, place in self._places.items()}
        strength = np.ones(self._zones)
        if scatter.allowable > 0.0:
            above = scatter.allowable_basis.deviations_below_mean
            strength = _strength(part["strength"], scatter.allowable, above)
        deviations = np.array([scatter.gas_pressure, scatter.strut_damping, scatter.tyre_stiffness])
        contacts = tuple(
            self._contact(number, part[f"contact {number}"], part["lift"])
            for number in range(len(self._contacts))
        )
        return Sample(
            contacts=contacts,
            point=LoadingPoints.point_of(float(part["loading"][0])),
            gears=_factor(part["gears"].reshape(self._gears, 3), deviations),
            friction=float(_factor(part["friction"][0], self._friction)),
            structural_damping=float(
                _factor(part["structural_damping"][0], scatter.structural_damping)
            ),
            zone_strength=strength,
        )

    def slopes(self, number: int, sensitivity: "Sensitivity") -> Array:
        """Slopes (count,) of a utilisation that has these sensitivities to contact ``number``.

        Zones' strengths all have the slope of one: they fail one at a time.
        """
        scatter = self._scatter
        slopes = np.zeros(self.count)
        slopes[self._places[f"contact {number}"]] = self._roots[number].T @ sensitivity.contact
        slopes[self._places["friction"]] = sensitivity.friction * self._friction
        slopes[self._places["lift"]] = sensitivity.lift_course * self._lift_course[number]
        gear = (scatter.gas_pressure, scatter.strut_damping, scatter.tyre_stiffness)
        slopes[self._places["gears"]] = np.tile(sensitivity.gear * gear, self._gears)
        slopes[self._places["structural_damping"]] = (
            sensitivity.structural_damping * scatter.structural_damping
        )
        slopes[self._places["strength"]] = -scatter.allowable
        return slopes

    def _contact(self, number: int, normals: Array, lift: Array) -> Contact:
        nominal = self._contacts[number]
        change = dict(zip(CONTACT_COMPONENTS, self._roots[number] @ normals, strict=True))
        state: dict[str, Any] = {
            name: float(np.clip(getattr(nominal, name) + change[name], *RANGES[name]))
            for name in CONTACT_COMPONENTS
            if name != "lift_fraction"
        }
        state["sink_rate"] = max(state["sink_rate"], SOFTEST)
        return replace(nominal, **state, lift=self._lift(number, change["lift_fraction"], lift))

    def _lift(self, number: int, change: float, normals: Array) -> Lift:
        nominal = self._contacts[number].lift
        start_sd, time_deviation, residual_sd = self._lift_course[number]
        start = self._decay_starts[number] + start_sd * float(normals[0])
        residual = nominal.residual_fraction + residual_sd * float(normals[2])
        lift = replace(
            nominal,
            decay_start=max(0.0, start),
            decay_time=nominal.decay_time * float(_factor(normals[1], time_deviation)),
            residual_fraction=float(np.clip(residual, *_RESIDUAL_RANGE)),
        )
        recorded = nominal.recorded_normal_acceleration
        if nominal.model is LiftModel.TRIMMED and recorded is not None:
            trimmed = float(np.clip(recorded + change, 0.0, max(1.0, recorded)))
            return replace(lift, recorded_normal_acceleration=trimmed)
        most = max(1.0, nominal.fraction)
        return replace(lift, fraction=float(np.clip(nominal.fraction + change, 0.0, most)))


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """How fast a utilisation rises with what is uncertain; relative changes for factors."""

    contact: Array  #: (9,) per unit of `CONTACT_COMPONENTS`
    friction: float
    lift_course: Array  #: (3,) decay start [1/s], decay time, residual fraction
    gear: Array  #: (3,) gas pressure, strut damping, tyre stiffness
    structural_damping: float


def _decay_starts(contacts: Sequence[Contact]) -> list[float]:
    """When the lift begins to decay, after each contact; negative: so long before it [s].

    A later contact by which the spoilers are out says only that its lift decays from its beginning.
    """
    starts = [contact.lift.decay_start for contact in contacts]
    if not contacts:
        return starts
    out = contacts[0].time + starts[0]
    return [
        start if start > 0.0 else min(out - contact.time, 0.0)
        for contact, start in zip(contacts, starts, strict=True)
    ]


def _root(covariance: Array) -> Array:
    """Return the (9, r) root of a covariance, columns of no variance left out.

    By eigenvectors of the correlations, since a posterior may be singular; the widest comes first.
    """
    deviations = np.sqrt(np.diag(covariance))
    safe = np.where(deviations > 0.0, deviations, 1.0)
    values, vectors = np.linalg.eigh(covariance / np.outer(safe, safe))
    kept = values > 1e-9 * max(1.0, float(values[-1]))
    columns = deviations[:, None] * vectors[:, kept] * np.sqrt(values[kept])
    return np.asarray(columns[:, ::-1])


def _factor(normals: Array, deviation: Array | float) -> Array:
    """Lognormal factors with median one and this relative standard deviation."""
    return np.asarray(np.exp(np.sqrt(np.log1p(np.square(deviation))) * normals))


def _strength(normals: Array, deviation: float, above: float) -> Array:
    """Return true strength over the stated value, ``above`` deviations below the mean."""
    mean = 1.0 / (1.0 - above * deviation)
    return np.asarray(np.maximum(mean * (1.0 + deviation * normals), 0.1))


def _scattered(
    gear: Gear, pressure: float, damping: float, stiffness: float, friction: float
) -> Gear:
    strut, tyre = gear.strut, gear.tyre
    return replace(
        gear,
        strut=replace(
            strut,
            initial_gas_pressure=pressure * strut.initial_gas_pressure,
            compression_coefficient=damping * strut.compression_coefficient,
            rebound_coefficient=damping * strut.rebound_coefficient,
            seal_friction=damping * strut.seal_friction,
        ),
        tyre=replace(
            tyre,
            vertical_coefficient=stiffness * tyre.vertical_coefficient,
            maximum_friction=friction * tyre.maximum_friction,
            minimum_friction=friction * tyre.minimum_friction,
        ),
    )
