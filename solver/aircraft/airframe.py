"""The airframe: definition and bulk data of one aircraft put together, ready for every landing."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from scipy.sparse import csr_array

from solver.aircraft.air_loads import air_load_shapes
from solver.aircraft.definition import AircraftDefinition
from solver.aircraft.definition_reader import content_hash, load_definition
from solver.aircraft.mass_states import (
    MASS_TOLERANCE,
    LoadedGroup,
    Loading,
    MassMoments,
    balance,
    spread,
    stated_masses,
)
from solver.aircraft.nastran import read_bulk_data
from solver.aircraft.zones import element_allowables, element_centroids, element_zones
from solver.arrays import Array, BoolArray, IntArray
from solver.errors import ModelError, RecordError
from solver.fe.inertia import Inertia, MassProperties, combine, point_mass_inertia
from solver.fe.model import FiniteElementModel, PointMasses
from solver.fe.stress import StressRecovery, build_stress_recovery
from solver.fe.structure import Structure, build_structure
from solver.landing.aircraft import Aerodynamics, LandingAircraft
from solver.progress import Progress, silent

#: A tank's or bay's CONM2 cards must add up to its capacity within this share.
CAPACITY_TOLERANCE = 1e-3
#: The airframe's mass must meet the defined operating empty mass within this share.
EMPTY_MASS_TOLERANCE = 0.01


@dataclass(frozen=True, slots=True)
class Airframe:
    """One aircraft: structure when empty, tanks and bays, load shapes, zones and allowables.

    ``structure.inertia`` is the operating empty airframe without the unsprung masses of the gears
    and without the CONM2 cards of tanks and bays; those are ``groups``.
    """

    definition: AircraftDefinition
    structure: Structure
    groups: tuple[LoadedGroup, ...]  #: tanks, then bays
    recovery: StressRecovery
    pin_rows: IntArray  #: (n_pins,) node rows, in the order of the gears and their pins
    pin_loads: csr_array  #: (n_free, 6 n_pins) unit forces and moments at the pins
    air_shapes: Array  #: (n_free, 6) unit wrenches about the structural origin
    element_zone: IntArray  #: (ne,) index into ``definition.zones``
    allowables: Array  #: (ne,) limit allowable, von Mises [Pa]
    centroids: Array  #: (ne, 3) [m]
    content_hash: str  #: of definition and bulk data
    empty_moments: MassMoments  #: of ``structure.inertia``
    ignored_parameters: tuple[str, ...]  #: PARAM cards of the bulk data passed over

    def fill_factors(self, fuel: Mapping[str, float], payload: Mapping[str, float]) -> Array:
        """Fill factors (n_groups,) of stated masses [kg]; defaults where nothing is stated.

        Raises
        ------
        RecordError
            Unknown name, or a mass outside 0 to capacity; names field, value and range.
        """
        stated = self._stated(fuel, payload)
        return np.where(np.isnan(stated), self._default_masses(), stated) / self._capacities()

    def loading_for(
        self,
        mass: float | None = None,
        centre_of_gravity: float | None = None,
        fuel: Mapping[str, float] | None = None,
        payload: Mapping[str, float] | None = None,
    ) -> Loading:
        """Find the loading state that meets what a record says.

        In this order: stated fuel and payload are kept; other tanks and bays start at their
        default fill; if the gross mass is stated, the other bays take up the difference, and what
        they cannot hold goes to the other tanks; if the centre of gravity is stated, payload (of
        the bays not stated) is shifted at constant mass towards it.

        Parameters
        ----------
        mass : float, optional
            Gross mass with the unsprung masses [kg].
        centre_of_gravity : float, optional
            Station of the gross centre of gravity, struts extended [m].
        fuel, payload : mapping, optional
            Masses by tank and bay name [kg].

        Raises
        ------
        RecordError
            Unknown name, mass outside 0 to capacity, or a gross mass that the groups that are left
            cannot make up within 1 %.
        """
        stated = self._stated(fuel or {}, payload or {})
        capacities = self._capacities()
        masses = np.where(np.isnan(stated), self._default_masses(), stated)
        tanks = np.arange(len(masses)) < len(self.definition.tanks)
        free_tanks, free_bays = np.isnan(stated) & tanks, np.isnan(stated) & ~tanks
        notes = self._default_notes(free_tanks, free_bays, solved=mass is not None)
        if mass is not None:
            masses = self._meet_mass(mass, masses, free_tanks, free_bays, notes)
        if centre_of_gravity is not None:
            if free_bays.sum() >= 2:
                stations = np.array([g.moments.first[0] / g.moments.mass for g in self.groups])
                gross, centre = self._gross(masses / capacities)
                change = gross * (centre_of_gravity - centre[0])
                masses = balance(masses, capacities, stations, free_bays, change)
            self._note_centre(centre_of_gravity, masses / capacities, notes)
        gross, centre = self._gross(masses / capacities)
        names = [group.name for group in self.groups]
        split = len(self.definition.tanks)
        return Loading(
            factors=masses / capacities,
            mass=gross,
            centre_of_gravity=centre,
            fuel=dict(zip(names[:split], masses[:split].tolist(), strict=True)),
            payload=dict(zip(names[split:], masses[split:].tolist(), strict=True)),
            notes=tuple(notes),
        )

    def inertia(self, factors: Array) -> Inertia:
        """Inertia of the loaded airframe, affine in ``factors`` (n_groups,)."""
        parts = [(1.0, self.structure.inertia)]
        parts += [
            (float(factor), group.inertia)
            for factor, group in zip(factors, self.groups, strict=True)
        ]
        return combine(parts)

    def mass_properties(self, factors: Array) -> MassProperties:
        """Rigid-body properties of the loaded airframe without the unsprung masses."""
        moments = self.empty_moments
        for factor, group in zip(factors, self.groups, strict=True):
            moments = moments.plus(float(factor), group.moments)
        return moments.properties()

    def landing_aircraft(self, factors: Array) -> LandingAircraft:
        """Aircraft for the landing simulation: the loaded airframe as a rigid body, its gears."""
        body = self.mass_properties(factors)
        reference, aero = self.definition.reference, self.definition.aerodynamics
        positions = self.structure.model.coordinates[self.pin_rows]
        gears, first = [], 0
        for gear in self.definition.gears:
            last = first + len(gear.pins)
            gears.append(gear.gear(positions[first:last]))
            first = last
        return LandingAircraft(
            mass=body.mass,
            centre_of_gravity=body.centre_of_gravity,
            inertia=body.inertia,
            gears=tuple(gears),
            aerodynamics=Aerodynamics.from_coefficients(
                area=reference.wing_area,
                span=reference.wing_span,
                chord=reference.mean_chord,
                drag_coefficient=aero.drag_coefficient,
                roll_damping_derivative=aero.roll_damping,
                pitch_damping_derivative=aero.pitch_damping,
                yaw_damping_derivative=aero.yaw_damping,
                air_density=aero.air_density,
            ),
        )

    def _capacities(self) -> Array:
        return np.array([group.capacity for group in self.groups])

    def _default_masses(self) -> Array:
        fills = [group.definition.default_fill for group in self.groups]
        return np.array(fills) * self._capacities()

    def _stated(self, fuel: Mapping[str, float], payload: Mapping[str, float]) -> Array:
        split = len(self.definition.tanks)
        return np.concatenate(
            [
                stated_masses(self.groups[:split], fuel, "fuel"),
                stated_masses(self.groups[split:], payload, "payload"),
            ]
        )

    def _gross(self, factors: Array) -> tuple[float, Array]:
        """Gross mass [kg] and centre of gravity (3,) [m] with the unsprung masses at the axles."""
        body = self.mass_properties(factors)
        mass, moment = body.mass, body.mass * body.centre_of_gravity
        for gear in self.definition.gears:
            axle = gear.pivot + gear.strut.extended_length * gear.axis
            mass, moment = mass + gear.unsprung_mass, moment + gear.unsprung_mass * axle
        return mass, moment / mass

    def _default_notes(
        self, free_tanks: BoolArray, free_bays: BoolArray, *, solved: bool
    ) -> list[str]:
        notes = []
        for kind, free in (("fuel", free_tanks), ("payload", free_bays)):
            names = [
                group.name for group, is_free in zip(self.groups, free, strict=True) if is_free
            ]
            if names:
                how = "default fill, adjusted to the gross mass" if solved else "default fill"
                notes.append(f"{kind} not stated for {', '.join(names)}: {how}")
        return notes

    def _meet_mass(
        self,
        mass: float,
        masses: Array,
        free_tanks: BoolArray,
        free_bays: BoolArray,
        notes: list[str],
    ) -> Array:
        capacities = self._capacities()
        left = mass - self._gross(masses / capacities)[0]
        for free in (free_bays, free_tanks):
            masses, left = spread(left, masses, capacities, free)
        if not abs(left) <= MASS_TOLERANCE * mass:
            free = free_tanks | free_bays
            lowest = self._gross(np.where(free, 0.0, masses) / capacities)[0]
            highest = self._gross(np.where(free, capacities, masses) / capacities)[0]
            span = f"{lowest:.0f} to {highest:.0f} kg" if free.any() else f"{lowest:.0f} kg"
            raise RecordError(
                f"mass = {mass:g} kg cannot be met: with the stated fuel and payload the aircraft "
                f"weighs {span}"
            )
        if abs(left) > 1e-6 * mass:
            notes.append(
                f"stated mass {mass:.0f} kg differs by {left:+.0f} kg from the sum of empty "
                "aircraft, fuel and payload; the sum is used"
            )
        return masses

    def _note_centre(self, wanted: float, factors: Array, notes: list[str]) -> None:
        found = float(self._gross(factors)[1][0])
        reference = self.definition.reference
        if abs(found - wanted) > 1e-3 * reference.mean_chord:
            notes.append(
                f"stated centre of gravity {wanted:.3f} m "
                f"({100 * reference.chord_fraction(wanted):.1f} % MAC) cannot be met with this "
                f"loading; {found:.3f} m ({100 * reference.chord_fraction(found):.1f} % MAC) "
                "is used"
            )


def load_airframe(folder: Path, progress: Progress = silent) -> Airframe:
    """Read, check and assemble the aircraft in a folder.

    Raises
    ------
    ModelError
        Definition or bulk data cannot be used, or do not fit each other; says where and why.
    """
    progress("reading the aircraft", 0.0)
    definition = load_definition(folder)
    path = folder / definition.bulk_data
    deck = read_bulk_data(path)
    identity = content_hash(folder, definition.bulk_data)
    progress("reading the aircraft", 0.5)
    try:
        empty, loads = _separated(deck.model, definition)
        zones = element_zones(deck.model, definition)
        allowables = element_allowables(deck.model, definition, zones)
        pin_rows = _pin_rows(deck.model, definition)
        progress("reading the aircraft", 1.0)
        structure = build_structure(empty, progress)
        progress("stress recovery", 0.0)
        recovery = build_stress_recovery(structure)
        progress("stress recovery", 1.0)
        groups = _loaded_groups(structure, definition, loads)
        empty_moments = MassMoments.of(structure.inertia)
        _check_empty_mass(empty_moments.mass, definition)
        air_shapes = air_load_shapes(structure, definition.air_loads)
    except ModelError as error:
        raise ModelError(f"{folder}: {error}") from error
    return Airframe(
        definition=definition,
        structure=structure,
        groups=groups,
        recovery=recovery,
        pin_rows=pin_rows,
        pin_loads=structure.nodal_loads(pin_rows),
        air_shapes=air_shapes,
        element_zone=zones,
        allowables=allowables,
        centroids=element_centroids(deck.model),
        content_hash=identity,
        empty_moments=empty_moments,
        ignored_parameters=deck.ignored_parameters,
    )


def _separated(
    model: FiniteElementModel, definition: AircraftDefinition
) -> tuple[FiniteElementModel, list[PointMasses]]:
    """Model without the lumped masses of tanks and bays, and those masses group by group."""
    masses = model.point_masses
    owner = np.full(len(masses.identifiers), -1, dtype=np.int64)
    loads = []
    for index, group in enumerate(definition.groups):
        inside = group.point_masses.contains(masses.identifiers)
        shared = inside & (owner >= 0)
        if np.any(shared):
            raise ModelError(
                f"CONM2 {masses.identifiers[shared][0]} belongs to "
                f"{definition.groups[owner[shared][0]].name} and {group.name}"
            )
        total = float(masses.masses[inside].sum())
        if not abs(total - group.capacity) <= CAPACITY_TOLERANCE * group.capacity:
            raise ModelError(
                f"{group.name}: its {int(inside.sum())} CONM2 ({group.point_masses}) weigh "
                f"{total:.3f} kg, capacity_kg is {group.capacity:g}"
            )
        owner[inside] = index
        loads.append(_selected(masses, inside))
    return replace(model, point_masses=_selected(masses, owner < 0)), loads


def _selected(masses: PointMasses, chosen: BoolArray) -> PointMasses:
    return PointMasses(
        identifiers=masses.identifiers[chosen],
        nodes=masses.nodes[chosen],
        masses=masses.masses[chosen],
        offsets=masses.offsets[chosen],
        inertias=masses.inertias[chosen],
    )


def _loaded_groups(
    structure: Structure, definition: AircraftDefinition, loads: list[PointMasses]
) -> tuple[LoadedGroup, ...]:
    groups = []
    for group, masses in zip(definition.groups, loads, strict=True):
        inertia = point_mass_inertia(structure.transformation, structure.model.coordinates, masses)
        groups.append(LoadedGroup(group, inertia, MassMoments.of(inertia)))
    return tuple(groups)


def _pin_rows(model: FiniteElementModel, definition: AircraftDefinition) -> IntArray:
    rows = []
    for gear in definition.gears:
        for pin in gear.pins:
            row = int(np.searchsorted(model.node_identifiers, pin.node))
            if row == model.node_count or model.node_identifiers[row] != pin.node:
                raise ModelError(
                    f"gears.{gear.name}.pins.{pin.name}: node {pin.node} is not in the bulk data"
                )
            rows.append(row)
    return np.array(rows, dtype=np.int64)


def _check_empty_mass(mass: float, definition: AircraftDefinition) -> None:
    total = math.fsum([mass, *(gear.unsprung_mass for gear in definition.gears)])
    expected = definition.masses.operating_empty
    if not abs(total - expected) <= EMPTY_MASS_TOLERANCE * expected:
        raise ModelError(
            f"bulk data without tanks and bays, plus unsprung masses, weigh {total:.1f} kg; "
            f"operating_empty_kg is {expected:g}"
        )
