"""What an assessment needs of an aircraft once its reduced model is there.

No structure and no matrices: the definition, what the aircraft weighs in every loading state, where
its pins are, and what each element may carry.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from solver.aircraft.definition import AircraftDefinition
from solver.aircraft.loading import Loading, fill_factors, find_loading
from solver.aircraft.mass_states import LoadedGroup, MassStates
from solver.arrays import Array, IntArray
from solver.fe.inertia import MassProperties
from solver.landing.aircraft import Aerodynamics, LandingAircraft


@dataclass(frozen=True, slots=True)
class AssessedAirframe:
    """One aircraft as landings are simulated and judged with it; ne elements in solver order."""

    definition: AircraftDefinition
    content_hash: str  #: of definition and bulk data
    mass_states: MassStates  #: tanks and bays, and what the aircraft weighs with them
    pin_positions: Array  #: (n_pins, 3) in the order of the gears and their pins [m]
    element_identifiers: IntArray  #: (ne,)
    element_corners: IntArray  #: (ne,) 4 of quadrilaterals, 3 of triangles, 2 of beams
    element_zone: IntArray  #: (ne,) index into ``definition.zones``
    allowables: Array  #: (ne,) limit allowable, von Mises [Pa]
    centroids: Array  #: (ne, 3) [m]

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

    def mass_properties(self, factors: Array) -> MassProperties:
        """Rigid-body properties of the loaded airframe without the unsprung masses."""
        return self.mass_states.properties(factors)

    def landing_aircraft(
        self, factors: Array, runway_friction: float | None = None
    ) -> LandingAircraft:
        """Aircraft for the landing simulation: the loaded airframe as a rigid body, its gears.

        Parameters
        ----------
        factors : (n_groups,) array
            Fill of tanks and bays.
        runway_friction : float, optional
            Largest coefficient of friction; that of the definition's tyres by default.
        """
        body = self.mass_properties(factors)
        reference, aero = self.definition.reference, self.definition.aerodynamics
        gears, first = [], 0
        for gear in self.definition.gears:
            last = first + len(gear.pins)
            # writable, as the compiled landing was compiled for
            gears.append(gear.gear(np.array(self.pin_positions[first:last])))
            first = last
        aircraft = LandingAircraft(
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
        return aircraft if runway_friction is None else aircraft.on_runway(runway_friction)
