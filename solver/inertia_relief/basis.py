"""The reduced basis: elastic modes and residual (attachment) vectors, ranked by strain energy.

Modes carry the slow global motion.  What they miss is the local stress where loads enter, at the
gear fittings above all, so every load shape also gives its static response by inertia relief and
the next terms of its expansion in frequency (block Krylov vectors), at zero and, damped, beyond the
modes.  Only what the others do not already represent is kept.

Sources: Craig, "Coupling of substructures for dynamic analyses", 2000 (residual-attachment modes);
Bai, "Krylov subspace techniques for reduced-order modeling", 2002 (moment matching); Ruhe,
"Rational Krylov sequence methods for eigenvalue computation", 1984 (several shifts).
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from solver.arrays import Array, BoolArray, IntArray
from solver.errors import ModelError
from solver.fe.inertia import combine
from solver.inertia_relief.factor import factorise
from solver.inertia_relief.free_body import FreeBody, free_body
from solver.inertia_relief.lanczos import largest_modes
from solver.inertia_relief.static import inertia_relief
from solver.progress import Progress, silent

if TYPE_CHECKING:
    from solver.fe.inertia import Inertia
    from solver.fe.structure import Structure

#: Eigenvalues below this share of the first elastic one belong to rigid modes.
_RIGID_SHARE = 1e-4
#: A load whose balanced part is smaller than this share of it deforms nothing.
_NO_LOAD = 1e-9
#: Largest residual of a harmonic response, relative to the load.
_HARMONIC_ERROR = 1e-6
#: Vectors, or rows of the basis, that are worked on at once: a second basis in memory is spared.
_TOGETHER = 64
#: The shift makes ``K - sigma M`` definite; far below the first elastic mode [Hz].
_SHIFT_FREQUENCY = 0.5


@dataclass(frozen=True, slots=True)
class BasisSettings:
    """What goes into a reduced basis; part of the key under which a model is cached."""

    modes: int = 240  #: elastic modes of the middle mass state
    mode_tolerance: float = 1e-2  #: share of a mode's change by a group's mass that may be dropped
    residual_order: int = 2  #: vectors of each load: 1 static response, 2 and more Krylov
    cutoff_frequency: float = 100.0  #: where the terms of the expansion are compared [Hz]
    static_tolerance: float = 1e-3  #: share of a load's own static response that may be dropped
    krylov_tolerance: float = 1e-3  #: the same of later terms, of the strongest load at its place
    #: Frequencies [Hz] of harmonic responses beyond the modes, each with its mass state: fills
    #: repeated over the groups, all alike or some full where others are empty.
    harmonic_states: tuple[tuple[float, tuple[float, ...]], ...] = (
        (100.0, (0.5,)), (150.0, (0.5,)), (225.0, (0.5,)), (320.0, (0.5,)),
        (130.0, (0.0, 0.0, 1.0, 1.0)), (130.0, (1.0, 1.0, 0.0, 0.0)),
        (180.0, (0.0,)), (180.0, (1.0,)),
    )  # fmt: skip
    harmonic_loss: float = 0.15  #: imaginary part of their squared frequency, relative
    harmonic_tolerance: float = 2e-3  #: the same of the response at those frequencies


#: The state whose modes the basis is turned to.
MIDDLE = (0.5,)


def mass_state(
    base: "Inertia", groups: "tuple[Inertia, ...]", fills: tuple[float, ...] = MIDDLE
) -> "Inertia":
    """Inertia with the groups filled to ``fills`` of their capacity, repeated over the groups."""
    each = np.resize(fills, len(groups))
    return combine([(1.0, base), *zip(each.tolist(), groups, strict=True)])


def elastic_modes(body: FreeBody, count: int) -> tuple[Array, Array]:
    """Lowest elastic modes of a free body by shift-invert Lanczos iteration, see `largest_modes`.

    Returns
    -------
    (k,) array, (n, k) array
        Circular frequencies [rad/s] and M-orthonormal shapes; k is ``count``, or less on a
        structure too small for it.

    Raises
    ------
    ModelError
        The structure has not exactly six rigid modes: it is a mechanism, or held.
    """
    size = body.stiffness.shape[0]
    wanted = min(count + 6, max(7, size // 2))
    shift = -((2 * np.pi * _SHIFT_FREQUENCY) ** 2)
    shifted = body.stiffness - shift * body.mass
    inverse, shapes = largest_modes(factorise(shifted).solve, body.mass, wanted, shifted)
    values = shift + 1.0 / inverse
    if np.any(np.abs(values[:6]) > _RIGID_SHARE * values[6]):
        raise ModelError(f"the structure is held: its sixth eigenvalue is {values[5]:.3g} rad2/s2")
    if values[6] < (2 * np.pi * 1e-2) ** 2:
        raise ModelError(
            f"the structure is a mechanism: seventh eigenvalue {values[6]:.3g} rad2/s2"
        )
    return np.sqrt(values[6:]), body.mean_axis(shapes[:, 6:])


def extended(stiffness: Any, basis: Array, candidates: Array, tolerance: float) -> Array:
    """Append to a K-orthonormal ``basis`` (n, m) what it lacks of ``candidates`` (n, p).

    Of the candidates' remainders the principal directions in the strain-energy product are kept;
    each candidate is then represented with an error of at most ``tolerance`` in that norm.
    """
    remainder = _without(stiffness, basis, _without(stiffness, basis, candidates))
    for limit in (tolerance**2, 0.5):  # the second pass removes the rounding of the first
        gram = remainder.T @ (stiffness @ remainder)
        values, directions = np.linalg.eigh((gram + gram.T) / 2)
        kept = values > limit
        remainder = remainder @ (directions[:, kept] / np.sqrt(values[kept]))
        remainder = _without(stiffness, basis, remainder)
    return np.hstack([basis, remainder])


def _without(stiffness: Any, basis: Array, vectors: Array) -> Array:
    """Part of ``vectors`` that is K-orthogonal to the K-orthonormal ``basis``."""
    rest: Array = vectors - basis @ (basis.T @ (stiffness @ vectors))
    return rest


def energy_norms(stiffness: Any, vectors: Array) -> Array:
    """Square root of twice the strain energy of each vector (n, k)."""
    norms: Array = np.sqrt(np.maximum(np.einsum("ij,ij->j", vectors, stiffness @ vectors), 0.0))
    return norms


def build_basis(
    structure: "Structure",
    base: "Inertia",
    groups: "tuple[Inertia, ...]",
    applied: Array,
    settings: BasisSettings,
    progress: Progress = silent,
) -> Array:
    """K-orthonormal reduced basis (n, m), mean-axis with respect to the middle mass state.

    The response to a load of circular frequency w is x1 + w^2 x2 + w^4 x3 + ..., with x1 its
    inertia-relief solution and K x(j+1) = M x(j).  Modes come first, with how each changes as a
    group's mass comes or goes; of every term only what the basis lacked before it goes on to the
    next one.  Every x1 counts by the share of its own strain
    energy that is missing.  Later terms are taken at the cut-off frequency and under the loads of a
    hard landing (`_amplitudes`), and compared with the strongest static response at the same place:
    a pin, the air loads, the inertia of the structure or of a mass group.  The damped harmonic
    response (K - w^2 (1 - i eta) M)^-1 f at a few frequencies beyond the modes, in several mass
    states, is weighed alike: small stiff parts beside the fittings and under the payload ring
    there.  Without the loss eta it would be the shape of the one mode nearest to w; with it, it
    holds what all modes within the band w eta answer, as they do when they are damped.

    Parameters
    ----------
    base, groups : Inertia
        Of the empty structure, and of each full mass group.
    applied : (n, k) array
        Loads of unit pin and air components.
    """
    middle = free_body(structure, mass_state(base, groups))
    stiffness = structure.stiffness
    relief = inertia_relief(middle)
    progress("elastic modes", 0.0)
    frequencies, shapes = elastic_modes(middle, settings.modes)
    progress("elastic modes", 0.5)
    basis = np.zeros((structure.n_free, 0))
    basis = extended(stiffness, basis, shapes / frequencies, settings.mode_tolerance)
    for index, group in enumerate(groups):
        # full or empty instead of half full: the static response to the inertia of what differs
        change = relief.displacement(0.5 * (group.mass_matrix() @ (shapes * frequencies)))
        basis = extended(stiffness, basis, change, settings.mode_tolerance)
        progress("elastic modes", 0.5 + 0.5 * (index + 1) / len(groups))

    origin = middle.centre_of_gravity
    inertial = [part.rigid_load_shapes(origin) for part in (base, *groups)]
    loads = np.hstack([applied, *inertial])
    amplitudes, places = _amplitudes(applied.shape[1] // 6, len(inertial), middle.total_mass)
    acting = _acts(middle, loads)
    loads = loads[:, acting] * amplitudes[acting]
    term = relief.displacement(loads)
    norms, places = energy_norms(stiffness, term), places[acting]
    strongest = np.array([norms[places == place].max() for place in places])
    for order in range(settings.residual_order):
        progress("residual vectors", order / settings.residual_order)
        if order > 0:
            factor = (2 * np.pi * settings.cutoff_frequency) ** 2
            term = relief.displacement(factor * (middle.mass @ term))
        term = _without(stiffness, basis, term)
        if order == 0:
            basis = extended(stiffness, basis, term / norms, settings.static_tolerance)
        else:
            basis = extended(stiffness, basis, term / strongest, settings.krylov_tolerance)
    progress("residual vectors", 1.0)
    states = settings.harmonic_states
    for index, (frequency, fills) in enumerate(states):
        progress("harmonic vectors", index / len(states))
        body = free_body(structure, mass_state(base, groups, fills))
        term = harmonic_response(body, loads / strongest, frequency, settings.harmonic_loss)
        basis = extended(stiffness, basis, middle.mean_axis(term), settings.harmonic_tolerance)
    progress("harmonic vectors", 1.0)
    # as modes of the middle state, slow ones last: any loading's motion is then concentrated
    mass = np.empty((basis.shape[1],) * 2)
    for first in range(0, len(mass), _TOGETHER):
        part = slice(first, first + _TOGETHER)
        mass[:, part] = basis.T @ (middle.mass @ middle.mean_axis(basis[:, part]))
    turn = np.linalg.eigh(mass)[1]
    for first in range(0, len(basis), _TOGETHER):
        part = slice(first, first + _TOGETHER)
        basis[part] = basis[part] @ turn
    return basis


def harmonic_response(body: FreeBody, loads: Array, frequency: float, loss: float) -> Array:
    """Response (n, 2 k) to balanced loads (n, k) of one frequency [Hz]: in phase, then out of it.

    ``(K - w^2 (1 - i loss) M) u = f``.  Divided by ``1 + i beta w`` the matrix of a structure with
    Rayleigh damping is of this form, with a loss near ``beta w + alpha / w``, twice the ratio of
    critical damping.

    Raises
    ------
    ModelError
        The frequency is so close to an undamped mode that the solution is not one.
    """
    balanced = body.self_equilibrated(loads)
    matrix = body.stiffness - (2 * np.pi * frequency) ** 2 * (1 - 1j * loss) * body.mass
    factor, count, error = factorise(matrix), balanced.shape[1], 0.0
    response = np.empty((len(balanced), 2 * count))
    for first in range(0, count, _TOGETHER):
        some = balanced[:, first : first + _TOGETHER]
        found = factor.solve(np.ascontiguousarray(some, dtype=np.complex128))
        error = np.maximum(error, np.abs(matrix @ found - some).max())  # also if it is no number
        last = first + found.shape[1]
        response[:, first:last], response[:, count + first : count + last] = found.real, found.imag
    error /= np.abs(balanced).max()
    if not error <= _HARMONIC_ERROR:
        raise ModelError(f"harmonic response at {frequency:g} Hz is off by {error:.3g} of the load")
    return body.mean_axis(response)


def _amplitudes(wrenches: int, inertias: int, mass: float) -> tuple[Array, IntArray]:
    """Size of every load in a hard landing, and the number of the place where it acts.

    Pins take a quarter of the weight and its moment at 50 mm, the air loads (the last wrench) the
    weight and its moment at 1 m, the inertia 2 g, 5 rad/s2 and 0.3 rad2/s2.
    """
    weight = mass * 9.80665
    pin = weight / 4 * np.array([1.0, 1.0, 1.0, 0.05, 0.05, 0.05])
    air = weight * np.array([0.3, 0.3, 1.0, 1.0, 1.0, 1.0])
    inertial = np.array([20.0] * 3 + [5.0] * 3 + [0.3] * 6)
    sizes = [*[pin] * (wrenches - 1), air, *[inertial] * inertias]
    places = np.repeat(np.arange(len(sizes)), [len(part) for part in sizes])
    return np.concatenate(sizes), places


def _acts(body: FreeBody, loads: Array) -> BoolArray:
    """Mark the loads that deform the body: those whose balanced part is more than rounding."""
    norms = np.linalg.norm(loads, axis=0)
    balanced = np.linalg.norm(body.self_equilibrated(loads), axis=0)
    acting: BoolArray = balanced > _NO_LOAD * np.where(norms > 0.0, norms, np.inf)
    return acting
