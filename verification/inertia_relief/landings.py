"""Random landings of an airframe: their balance, and mass of both models at random loadings."""

from dataclasses import dataclass
from math import radians

import numpy as np

from solver.aircraft.airframe import Airframe
from solver.arrays import Array
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import LandingLoads, landing_loads
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.response import landing_response
from solver.landing.contact import Contact, Lift, LiftModel
from solver.landing.simulate import SimulationOptions, simulate_landing


def random_contact(random: np.random.Generator) -> Contact:
    """Draw a touchdown between soft and very hard, on any gear first, with rates and drift."""

    def angle(largest: float) -> float:
        return radians(random.uniform(-largest, largest))

    return Contact(
        sink_rate=random.uniform(0.3, 3.6),
        ground_speed=random.uniform(48.0, 72.0),
        pitch=radians(random.uniform(-3.0, 9.0)),
        roll=angle(5.0),
        drift=angle(6.0),
        pitch_rate=angle(4.0),
        roll_rate=angle(15.0),
        yaw_rate=angle(3.0),
        lift=Lift(random.choice([LiftModel.HELD, LiftModel.DECAYING]), random.uniform(0.7, 1.0)),
    )


def simulated_loads(
    airframe: Airframe, factors: Array, contact: Contact, duration: float
) -> LandingLoads:
    """Simulate a landing and give the loads of its airframe."""
    options = SimulationOptions(time_limit=duration, stop_when_settled=False)
    return landing_loads(
        airframe, simulate_landing(airframe.landing_aircraft(factors), contact, options)
    )


def random_residuals(
    airframe: Airframe, model: ReducedModel, count: int, seed: int = 2026
) -> Array:
    """Equilibrium residual (count,) of random touchdowns at random loadings."""
    random = np.random.default_rng(seed)
    found = []
    for _ in range(count):
        factors = random.uniform(0.0, 1.0, len(airframe.groups))
        loads = simulated_loads(airframe, factors, random_contact(random), duration=0.6)
        found.append(landing_response(assemble(model, factors), loads).equilibrium_residual)
    return np.array(found)


@dataclass(frozen=True, slots=True)
class MassDifference:
    """Largest relative differences from the finite-element mass matrix over random loadings."""

    mass: float
    centre_of_gravity: float  #: relative to the radius of gyration
    inertia: float  #: of the largest entry of the tensor


def mass_differences(
    airframe: Airframe, model: ReducedModel, count: int, seed: int = 7
) -> tuple[MassDifference, MassDifference]:
    """Compare rigid-body model and reduced model with ``Phi_R' M Phi_R`` of the mass matrix."""
    random = np.random.default_rng(seed)
    structure = airframe.structure
    rigid, reduced = [], []
    for _ in range(count):
        factors = random.uniform(0.0, 1.0, len(airframe.groups))
        modes = structure.rigid_modes(np.zeros(3))
        exact = modes.T @ (airframe.inertia(factors).mass_matrix() @ modes)
        aircraft = airframe.landing_aircraft(factors)
        rigid.append(
            _difference(exact, aircraft.mass, aircraft.centre_of_gravity, aircraft.inertia)
        )
        loading = assemble(model, factors)
        whole = np.tensordot(loading.weights, model.mass, axes=1)[:6, :6]
        central = loading.rigid_transfer @ whole @ loading.rigid_transfer.T
        reduced.append(_difference(exact, loading.mass, loading.centre_of_gravity, central[3:, 3:]))
    return (
        MassDifference(*np.max(rigid, axis=0).tolist()),
        MassDifference(*np.max(reduced, axis=0).tolist()),
    )


def _difference(exact: Array, mass: float, centre: Array, inertia: Array) -> list[float]:
    total = exact[0, 0]
    lever = exact[:3, 3:] / total  # -skew(centre of gravity)
    at = np.array([lever[1, 2], lever[2, 0], lever[0, 1]])
    central = exact[3:, 3:] - total * (at @ at * np.eye(3) - np.outer(at, at))
    gyration = np.sqrt(np.trace(central) / (2 * total))
    return [
        abs(mass / total - 1),
        float(np.abs(centre - at).max() / gyration),
        float(np.abs(inertia - central).max() / np.abs(central).max()),
    ]
