"""Modes of the full-size airframe, out of its reduced model or of its matrices."""

from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import eigh

from solver.arrays import Array
from solver.errors import ModelError
from solver.flexible_landing.modes import FlexibleAirframe, flexible_airframe
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.projection import projected_inertia
from solver.landing.aircraft import LandingAircraft

if TYPE_CHECKING:
    from solver.fe.inertia import Inertia
    from solver.fe.structure import Structure
    from solver.inertia_relief.loading import ReducedLoading

#: Eigenvalues below this share of the seventh belong to the rigid modes.
_RIGID_SHARE = 1e-4


def modes_of_loading(loading: "ReducedLoading", aircraft: LandingAircraft) -> FlexibleAirframe:
    """All modes of a reduced airframe at one loading.

    The reduced model holds the lowest modes of the full-size structure to many digits and its
    static response to every load at every pin exactly; its higher modes stand for the rest.
    """
    model = loading.model
    frequency = loading.circular_frequency[::-1]
    # Modes of unit strain energy become modes of unit mass.
    shapes = loading.modes_with_rigid[:, ::-1] * frequency
    operators = np.zeros(model.rate_operators.shape[1:])
    for weight, part in zip(loading.weights, model.rate_operators, strict=True):
        operators += weight * np.asarray(part, dtype=np.float64)
    rates = shapes.T @ operators.transpose(0, 2, 1) @ shapes
    return flexible_airframe(
        aircraft,
        frequency.copy(),
        np.asarray(model.applied.T @ shapes),
        (loading.inertia[:, 6:].T @ shapes),
        rates[3:6],
        rates[6:],
        model.damping,
    )


def modes_of_structure(
    structure: "Structure",
    inertia: "Inertia",
    applied: Array,
    aircraft: LandingAircraft,
    damping: RayleighDamping,
) -> FlexibleAirframe:
    """All elastic modes of a small structure, by a dense solution.

    Parameters
    ----------
    applied : (n_free, 6 n_pins + 6) array
        Loads of unit pin components and of unit air resultants about the structural origin.

    Raises
    ------
    ModelError
        The structure has not exactly six rigid modes.
    """
    frequency, shapes = dense_modes(structure, inertia)
    _, rates = projected_inertia(inertia, shapes)
    products = inertia.rigid_load_shapes(aircraft.centre_of_gravity)[:, 6:].T @ shapes
    return flexible_airframe(
        aircraft, frequency, applied.T @ shapes, products, rates[3:6], rates[6:], damping
    )


def dense_modes(structure: "Structure", inertia: "Inertia") -> tuple[Array, Array]:
    """Circular frequencies (m,) [rad/s] and shapes (n_free, m) of unit modal mass, mean-axis.

    Freedoms without mass follow the others and have no modes.

    Raises
    ------
    ModelError
        The structure has not exactly six rigid modes.
    """
    body = free_body(structure, inertia)
    stiffness, mass = body.stiffness.toarray(), body.mass.toarray()
    shift = np.trace(stiffness) / np.trace(mass) * 1e-6
    # (K + s M) x = (w^2 + s) M x, turned over: M may be singular, K + s M is not.
    values, shapes = eigh(mass, stiffness + shift * mass)
    has_mass = values > 1e-14 * values[-1]
    values, shapes = values[has_mass][::-1], shapes[:, has_mass][:, ::-1]
    squared = 1.0 / values - shift
    shapes = shapes / np.sqrt(values)
    if np.any(np.abs(squared[:6]) > _RIGID_SHARE * squared[6]):
        raise ModelError(
            f"the structure has not six rigid modes: eigenvalues {squared[:8].round(3).tolist()}"
        )
    elastic = body.mean_axis(shapes[:, 6:])
    # The slow modes set the rounding of the fast ones; two steps of Newton and Schulz towards the
    # nearest orthonormal set take it out.
    for _ in range(2):
        product = elastic.T @ (body.mass @ elastic)
        elastic = elastic @ (1.5 * np.eye(len(product)) - 0.5 * product)
    return np.sqrt(squared[6:]), elastic
