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
from solver.aircraft.loading import Loading, fill_factors, find_loading
from solver.aircraft.mass_states import LoadedGroup, MassMoments, MassStates
from solver.aircraft.nastran import read_bulk_data
from solver.aircraft.zones import element_allowables, element_centroids, element_zones
from solver.arrays import Array, BoolArray, IntArray
from solver.errors import ModelError
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
    recovery: StressRecovery
    pin_rows: IntArray  #: (n_pins,) node rows, in the order of the gears and their pins
    pin_loads: csr_array  #: (n_free, 6 n_pins) unit forces and moments at the pins
    air_shapes: Array  #: (n_free, 6) unit wrenches about the structural origin
    element_zone: IntArray  #: (ne,) index into ``definition.zones``
    allowables: Array  #: (ne,) limit allowable, von Mises [Pa]
    centroids: Array  #: (ne, 3) [m]
    content_hash: str  #: of definition and bulk data
    mass_states: MassStates  #: tanks and bays, and what the aircraft weighs with them
    ignored_parameters: tuple[str, ...]  #: PARAM cards of the bulk data passed over

    @property
    def groups(self) -> tuple[LoadedGroup, ...]:
        """Tanks, then bays."""
        return self.mass_states.groups

    def fill_factors(self, fuel: Mapping[str, float], payload: Mapping[str, float]) -> Array:
        """Fill factors (n_groups,) of stated masses [kg]; see `solver.aircraft.loading`."""
        return fill_factors(self.mass_states, fuel, payload)

    def loading_for(
        self,
        mass: float | None = None,
        centre_of_gravity: float | None = None,
        fuel: Mapping[str, float] | None = None,
        payload: Mapping[str, float] | None = None,
    ) -> Loading:
        """Find the loading state of a record; see `solver.aircraft.loading.find_loading`."""
        return find_loading(self.mass_states, mass, centre_of_gravity, fuel, payload)

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
        return self.mass_states.properties(factors)

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
                weathercock_derivative=aero.weathercock,
                air_density=aero.air_density,
            ),
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
    identity = content_hash(folder, *definition.files)
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
        mass_states = MassStates(
            definition,
            MassMoments.of(structure.inertia),
            _loaded_groups(structure, definition, loads),
        )
        _check_empty_mass(mass_states.empty.mass, definition)
        air_shapes = air_load_shapes(structure, definition.air_loads)
    except ModelError as error:
        raise ModelError(f"{folder}: {error}") from error
    return Airframe(
        definition=definition,
        structure=structure,
        recovery=recovery,
        pin_rows=pin_rows,
        pin_loads=structure.nodal_loads(pin_rows),
        air_shapes=air_shapes,
        element_zone=zones,
        allowables=allowables,
        centroids=element_centroids(deck.model),
        content_hash=identity,
        mass_states=mass_states,
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
        groups.append(LoadedGroup(group, masses, inertia, MassMoments.of(inertia)))
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
