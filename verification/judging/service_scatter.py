"""The aircraft that really landed: drawn from the scatter that its definition states.

No method is told; the probability assumes the same scatter, an estimate takes the definition.
"""

from dataclasses import replace

import numpy as np

from solver.aircraft.scatter import Scatter
from solver.landing.aircraft import LandingAircraft
from solver.landing.contact import Contact, Lift
from solver.probability.loadings import CENTRE
from solver.probability.variables import Sample


def scattered_aircraft(
    nominal: LandingAircraft, contact: Contact, scatter: Scatter, rng: np.random.Generator
) -> LandingAircraft:
    """Draw gas pressures, strut damping, tyres and runway friction of an aircraft in service."""
    deviations = [scatter.gas_pressure, scatter.strut_damping, scatter.tyre_stiffness]
    sample = Sample(
        contacts=(contact,),
        point=CENTRE,
        gears=np.exp(rng.standard_normal((len(nominal.gears), 3)) * deviations),
        friction=float(np.exp(scatter.tyre_friction * rng.standard_normal())),
        structural_damping=1.0,
        zone_strength=np.ones(0),
    )
    return sample.aircraft(nominal)


def scattered_lift(nominal: Lift, scatter: Scatter, rng: np.random.Generator) -> Lift:
    """Draw the course that the lift took."""
    start, time, residual = rng.standard_normal(3)
    return replace(
        nominal,
        decay_start=max(nominal.decay_start + scatter.lift_decay_start * float(start), 0.0),
        decay_time=nominal.decay_time * float(np.exp(scatter.lift_decay_time * time)),
        residual_fraction=float(
            np.clip(nominal.residual_fraction + scatter.residual_lift_fraction * residual, 0, 1)
        ),
    )
