"""A flexible airframe as a landing meets it: elastic modes in the mean-axis frame, body axes.

Any finite-element airframe comes down to this: its elastic free-free modes (unit modal mass,
M-orthogonal to the rigid modes), the motion they give to the gears' fittings and to the surfaces
that carry air loads, and how they change the inertia of the turning airframe.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import eigh

from solver.arrays import Array
from solver.fe.inertia import RATE_PRODUCTS
from solver.frames import BODY_STRUCTURAL, skew
from solver.gear.pins import pin_load_matrix
from solver.inertia_relief.damping import RayleighDamping
from solver.landing.aircraft import LandingAircraft

#: Directions of the residual flexibility below this share of its largest are rounding.
_DEPENDENT = 1e-9


@dataclass(frozen=True, slots=True)
class FlexibleAirframe:
    """Modes of an airframe at one loading; m modes, ascending.

    With modal coordinates q and body rate w the kinetic energy is that of the deformed body,

        T = m v^2 / 2 + w . J(q) w / 2 + w . h(q, q') + q' . q' / 2,

    where J(q) = J_0 + J_1(q) + J_2(q, q).  ``products`` holds J_1, ``centrifugal`` J_2 and
    ``euler`` h (see `solver.flexible_landing.equations`).
    """

    circular_frequency: Array  #: (m,) [rad/s]
    damping: Array  #: (m,) 2 zeta omega, of the aircraft's damping law [1/s]
    fittings: Array  #: (n_gears, 6, m) translation and rotation of each fitting at its pivot
    air: Array  #: (6, m) modal loads of a unit air force and moment about the centre of gravity
    products: Array  #: (6, m) modal loads of the rate products xx, yy, zz, xy, xz, yz
    euler: Array  #: (3, m, m) on rate derivatives; without rows: terms of second order left out
    centrifugal: Array  #: (6, m, m) symmetric; without rows: as above

    @property
    def size(self) -> int:
        """Number of modes."""
        return len(self.circular_frequency)

    def stiffened(self, factor: float) -> "FlexibleAirframe":
        """Raise all frequencies by ``factor``, shapes and damping ratios kept."""
        return replace(
            self,
            circular_frequency=self.circular_frequency * factor,
            damping=self.damping * factor,
        )

    def without_second_order(self) -> "FlexibleAirframe":
        """Without the terms in which displacement or velocity multiplies the body rate."""
        none = np.zeros((0, self.size, self.size))
        return replace(self, euler=none, centrifugal=none)

    def transformed(self, basis: Array, damping: RayleighDamping) -> "FlexibleAirframe":
        """Express it in a ``basis`` (m, k), mass-orthonormal and diagonal in the stiffness."""
        squared = np.einsum("ik,i,ik->k", basis, self.circular_frequency**2, basis)
        return FlexibleAirframe(
            circular_frequency=np.sqrt(squared),
            damping=damping.mass_coefficient + damping.stiffness_coefficient * squared,
            fittings=self.fittings @ basis,
            air=self.air @ basis,
            products=self.products @ basis,
            euler=basis.T @ self.euler @ basis,
            centrifugal=basis.T @ self.centrifugal @ basis,
        )


def residual_basis(flexible: FlexibleAirframe, modes: int) -> Array:
    """Lowest ``modes`` modes and the static residual vectors of all gear fittings, (m, k).

    The response of the modes left out to a slow load f is f / w^2.  For the six loads at each
    fitting that is at most 6 n_gears vectors; in the space they span, modes are found anew, so that
    the basis stays orthonormal in mass and diagonal in stiffness (Craig, "Coupling of substructures
    for dynamic analyses", 2000: residual-attachment modes).
    """
    size = flexible.size
    if modes >= size:
        return np.eye(size)
    squared = flexible.circular_frequency[modes:] ** 2
    loads = flexible.fittings.reshape(-1, size)[:, modes:]
    # Forces and moments are made alike by the flexibility that each one meets.
    static = (loads / np.sqrt(np.einsum("ij,j,ij->i", loads, 1 / squared, loads))[:, None]).T
    static = static / squared[:, None]
    directions, sizes, _ = np.linalg.svd(static, full_matrices=False)
    directions = directions[:, sizes > _DEPENDENT * sizes[0]]
    turn = eigh(directions.T @ (squared[:, None] * directions))[1]
    residual = directions @ turn
    basis = np.zeros((size, modes + residual.shape[1]))
    basis[:modes, :modes] = np.eye(modes)
    basis[modes:, modes:] = residual
    return basis


def flexible_airframe(
    aircraft: LandingAircraft,
    circular_frequency: Array,
    applied: Array,
    products: Array,
    euler: Array,
    centrifugal: Array,
    damping: RayleighDamping,
) -> FlexibleAirframe:
    """Turn modal data in structural axes into a `FlexibleAirframe`.

    Parameters
    ----------
    aircraft : LandingAircraft
        The same airframe as a rigid body, with gears and pins.
    circular_frequency : (m,) array
        Ascending [rad/s]; modes of unit modal mass, mean-axis.
    applied : (6 n_pins + 6, m) array
        Modal loads of unit forces and moments at the pins in the order of the gears, and of unit
        air resultants about the structural origin.
    products : (6, m) array
        Modal loads of the rate products, see `Inertia.rigid_load_shapes`.
    euler, centrifugal : (3, m, m) and (6, m, m) arrays
        See `Inertia`.
    """
    signs = BODY_STRUCTURAL
    pairs = np.array([signs[i] * signs[j] for i, j in RATE_PRODUCTS])
    both = np.concatenate([signs, signs])[:, None]
    fittings, first = [], 0
    for gear in aircraft.gears:
        last = first + 6 * len(gear.pins)
        # The fitting follows its pins as their loads share the wrench: both do the same work.
        fittings.append(both * (pin_load_matrix(gear.pins, gear.pivot).T @ applied[first:last]))
        first = last
    # Body force and moment about the centre of gravity become resultants about the origin.
    resultants = np.zeros((6, 6))
    resultants[:3, :3] = resultants[3:, 3:] = np.diag(signs)
    resultants[3:, :3] = skew(aircraft.centre_of_gravity) @ np.diag(signs)
    symmetric = (centrifugal + centrifugal.transpose(0, 2, 1)) / 2
    coefficients = damping.mass_coefficient, damping.stiffness_coefficient
    return FlexibleAirframe(
        circular_frequency=circular_frequency,
        damping=coefficients[0] + coefficients[1] * circular_frequency**2,
        fittings=np.stack(fittings),
        air=resultants.T @ applied[first:],
        products=pairs[:, None] * products,
        euler=signs[:, None, None] * euler,
        centrifugal=pairs[:, None, None] * symmetric,
    )
