"""The example aircraft landed three ways: rigid, as a stick, with the modes of its full model."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import radians

import numpy as np

from solver.arrays import Array, BoolArray
from solver.fe.inertia import Inertia
from solver.flexible_landing.full_airframe import modes_of_loading
from solver.flexible_landing.modes import FlexibleAirframe, residual_basis
from solver.flexible_landing.simulate import FlexibleLanding, simulate_flexible_landing
from solver.flexible_landing.stick import Stick, build_stick, stick_modes
from solver.inertia_relief.free_body import FreeBody, free_body
from solver.inertia_relief.loading import ReducedLoading, assemble
from solver.inertia_relief.static import inertia_relief
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact
from solver.landing.history import GearHistory, LandingHistory
from solver.landing.simulate import SimulationOptions, simulate_landing
from verification.flexible_airframe.layout import example_stations
from verification.run import Run

#: Modes kept beside the residual vectors of the fittings.
FULL_MODES, STICK_MODES = 200, 80
#: A gear whose strut force stays below this share of the landing's largest says nothing.
LOADED = 0.2
RIGID, STICK, FULL = "rigid", "stick", "full model"


@dataclass(frozen=True, slots=True)
class Approach:
    """A landing at maximum landing mass."""

    name: str
    title: str
    contact: Contact


APPROACHES = (
    Approach("symmetric", "symmetric, 10 ft/s", Contact(3.048, 55.0, pitch=radians(1.0))),
    Approach(
        "asymmetric",
        "asymmetric, 8 ft/s, 3 degrees of roll",
        Contact(2.438, 55.0, pitch=radians(1.0), roll=radians(3.0)),
    ),
    Approach(
        "gentle",
        "gentle, 0.5 m/s, 3 degrees of roll and pitch",
        Contact(0.5, 50.0, pitch=radians(3.0), roll=radians(3.0)),
    ),
    Approach("nose-first", "nose first, 8 ft/s", Contact(2.438, 60.0, pitch=radians(-2.5))),
)


@dataclass(frozen=True, slots=True)
class Models:
    """One aircraft at one loading, as a rigid body and with two sets of modes."""

    aircraft: LandingAircraft
    inertia: Inertia
    body: FreeBody
    loading: ReducedLoading
    stick: Stick
    all_full: FlexibleAirframe  #: every mode of the reduced model
    all_stick: FlexibleAirframe  #: every mode of the stick
    full: FlexibleAirframe
    short_stick: FlexibleAirframe


@dataclass(frozen=True, slots=True)
class Landed:
    """One approach, landed three ways."""

    approach: Approach
    rigid: LandingHistory
    stick: FlexibleLanding
    full: FlexibleLanding

    @property
    def histories(self) -> Mapping[str, LandingHistory]:
        """By the name of the airframe."""
        return {RIGID: self.rigid, STICK: self.stick.history, FULL: self.full.history}

    def loaded_gears(self) -> list[int]:
        """Gears whose struts carry a good part of the largest strut force."""
        peaks = [peak(gear) for gear in self.rigid.gears]
        return [index for index, value in enumerate(peaks) if value > LOADED * max(peaks)]


def peak(gear: GearHistory) -> float:
    """Largest strut force [N]."""
    return float(gear.strut_force.max())


def truncated(flexible: FlexibleAirframe, modes: int, models: ReducedLoading) -> FlexibleAirframe:
    """Lowest modes with the static residual vectors of the fittings."""
    return flexible.transformed(residual_basis(flexible, modes), models.model.damping)


def build_models(run: Run) -> Models:
    """Everything at maximum landing mass and reference loading."""
    airframe = run.airframe
    factors = airframe.loading_for(mass=airframe.definition.masses.maximum_landing).factors
    aircraft, inertia = airframe.landing_aircraft(factors), airframe.inertia(factors)
    loading = assemble(run.reduced, factors)
    body = free_body(airframe.structure, inertia)
    stations, branches = example_stations(airframe, aircraft)
    run.progress("identifying the stick model", 0.0)
    stick = build_stick(
        airframe.structure,
        inertia,
        inertia_relief(body),
        airframe.air_shapes,
        aircraft,
        stations,
        branches,
    )
    run.progress("identifying the stick model", 1.0)
    all_stick = stick_modes(stick, aircraft, run.reduced.damping)
    all_full = modes_of_loading(loading, aircraft)
    return Models(
        aircraft,
        inertia,
        body,
        loading,
        stick,
        all_full,
        all_stick,
        truncated(all_full, FULL_MODES, loading),
        truncated(all_stick, STICK_MODES, loading),
    )


def land(models: Models, approach: Approach, duration: float) -> Landed:
    """Land three ways."""
    options = SimulationOptions(time_limit=duration, stop_when_settled=False)
    aircraft, contact = models.aircraft, approach.contact
    return Landed(
        approach,
        simulate_landing(aircraft, contact, options),
        simulate_flexible_landing(aircraft, models.short_stick, contact, options),
        simulate_flexible_landing(aircraft, models.full, contact, options),
    )


def land_with(
    models: Models, flexible: FlexibleAirframe, approach: Approach, duration: float
) -> FlexibleLanding:
    """Land with other modes of the same aircraft."""
    options = SimulationOptions(time_limit=duration, stop_when_settled=False)
    return simulate_flexible_landing(models.aircraft, flexible, approach.contact, options)


def on_ground(one: LandingHistory, other: LandingHistory) -> BoolArray:
    """Instants (n_gears, nt) at which a gear's tyre carries in either landing."""
    forces = [
        np.stack([gear.ground_force[:, 2] for gear in history.gears]) for history in (one, other)
    ]
    return np.asarray(np.minimum(*forces) < 0.0)


def strut_forces(history: LandingHistory) -> Array:
    """All strut forces (n_gears, nt) [N]."""
    return np.stack([gear.strut_force for gear in history.gears])


def fitting_flexibility(flexible: FlexibleAirframe) -> Array:
    """Own static flexibility (n_gears, 6) of the fittings, three forces and three moments."""
    shapes = flexible.fittings / flexible.circular_frequency
    return np.asarray(np.einsum("gim,gim->gi", shapes, shapes))


def mirrored(landed: Landed) -> tuple[str, str]:
    """Names of the two main gears, port and starboard."""
    sides = sorted(
        (gear for gear in landed.rigid.gears if gear.reference_point[1] != 0.0),
        key=lambda gear: float(gear.reference_point[1]),
    )
    return sides[0].name, sides[1].name
