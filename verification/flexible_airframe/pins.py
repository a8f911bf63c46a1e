"""How much the elastic pins of a rigid fitting hold the airframe together between them."""

from dataclasses import replace

import numpy as np

from solver.flexible_landing.modes import FlexibleAirframe
from solver.gear.pins import pin_load_matrix, resultant_matrix
from verification.comparison import Comparison
from verification.flexible_airframe.study import (
    FULL_MODES,
    Landed,
    Models,
    land_with,
    strut_forces,
    truncated,
)


def with_tied_pins(models: Models) -> FlexibleAirframe:
    """All modes of the airframe with the pins' stiffness against each other.

    Pins of stiffness k at the fitting's six motions G carry, beside the gear's wrench, the forces
    ``(k - k G (G' k G)^-1 G' k) u`` when the airframe's deformation u moves them apart.
    """
    loading, aircraft = models.loading, models.aircraft
    shapes = loading.modes_with_rigid[:, ::-1] * models.all_full.circular_frequency
    pins = np.asarray(loading.model.applied.T @ shapes)
    stiffness = np.diag(models.all_full.circular_frequency**2)
    first = 0
    for gear in aircraft.gears:
        last = first + 6 * len(gear.pins)
        own = np.concatenate([np.asarray(pin.stiffness, dtype=np.float64) for pin in gear.pins])
        follows = resultant_matrix(gear.pins, gear.pivot) * own
        tied = np.diag(own) - pin_load_matrix(gear.pins, gear.pivot) @ follows
        stiffness += pins[first:last].T @ tied @ pins[first:last]
        first = last
    squared, turn = np.linalg.eigh((stiffness + stiffness.T) / 2)
    damping = loading.model.damping
    tied_modes = models.all_full.transformed(turn, damping)
    return replace(
        tied_modes,
        circular_frequency=np.sqrt(squared),
        damping=damping.mass_coefficient + damping.stiffness_coefficient * squared,
    )


def pin_comparison(models: Models, landed: Landed, duration: float) -> Comparison:
    """Peak strut forces with and without that restraint."""
    tied = truncated(with_tied_pins(models), FULL_MODES, models.loading)
    found = strut_forces(land_with(models, tied, landed.approach, duration).history)
    free = strut_forces(landed.full.history)
    return Comparison(
        f"{landed.approach.title}: peak strut forces with pins that hold the airframe between "
        "them, worst difference",
        float(np.abs(found.max(axis=1) / free.max(axis=1) - 1).max()),
        0.0,
        0.005,
        "",
        "pins that pass on the gear's wrench alone, as everywhere else",
        "the structure between a gear's pins is as stiff as the pins are",
        scale=1.0,
    )
