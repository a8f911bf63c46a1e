"""Beam properties out of the full airframe's own flexibility, by static unit loads.

Unit loads on the ends of all branches, and unit air loads, are balanced by the inertia of the
stick's masses and laid on the full-size airframe through the stations.  In every bay between two
stations the section loads W follow from equilibrium alone, whatever lies in the bay; the relative
motion d of its two stations is what the full airframe answers.  Least squares over all cases, each
scaled to unit strain energy, give the bay's flexibility F, d = F W.

Of a uniform Timoshenko beam of length L, taken at its middle, at its shear centre and in its
principal axes, F is diagonal:

    L/EA, L^3/12EI_1 + L/GA_1, L^3/12EI_2 + L/GA_2, L/GJ, L/EI_2, L/EI_1

(Przemieniecki, Theory of Matrix Structural Analysis, 1968, section 5.6).  The shear centre is where
a shear force does not twist, the principal axes are those of the bending flexibility.  In these
axes every diagonal term is fitted once more by itself; what would stand beside the diagonal is left
out.
"""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.errors import ModelError
from solver.flexible_landing.stations import Station, carried, wrench_transfer

#: Axial flexibility over the lesser of the transverse ones, where it cannot be told.
_STIFF = 1e-2


@dataclass(frozen=True, slots=True)
class BayLoads:
    """Static load cases of one bay at its middle, structural axes; k cases."""

    section: Array  #: (6, k) force and moment of the outer part on the section
    motion: Array  #: (6, k) translation and rotation of the outer station against the inner one

    def at(self, arm: Array) -> "BayLoads":
        """Return the same at a point that lies at ``arm`` (3,) from the middle."""
        return BayLoads(wrench_transfer(-arm) @ self.section, carried(self.motion, arm))

    def turned(self, axes: Array) -> "BayLoads":
        """Return the same in other axes, the rows of ``axes`` (3, 3)."""
        both = np.kron(np.eye(2), axes)
        return BayLoads(both @ self.section, both @ self.motion)

    def flexibility(self) -> Array:
        """Symmetric matrix (6, 6) that fits all cases best."""
        inverse = np.linalg.pinv(self.section @ self.section.T, hermitian=True)
        fitted: Array = self.motion @ self.section.T @ inverse
        return (fitted + fitted.T) / 2

    def diagonal(self) -> Array:
        """Flexibility (6,) of every component by itself."""
        works = np.einsum("ik,ik->i", self.section, self.motion)
        return np.asarray(works / np.einsum("ik,ik->i", self.section, self.section))


@dataclass(frozen=True, slots=True)
class BaySection:
    """Stiffness of one bay as a uniform beam."""

    length: float  #: [m]
    axial: float  #: E A [N]
    bending_1: float  #: E I in the plane of axis and orientation, the stiffer one [N m2]
    bending_2: float  #: E I across it [N m2]
    torsion: float  #: G J [N m2]
    shear_1: float  #: G A_1 [N]; inf: bending leaves no shear flexibility
    shear_2: float  #: G A_2 [N]
    orientation: Array  #: (3,) unit vector, structural axes
    offset: Array  #: (3,) from the stations to the beam's axis [m]


def bay_loads(
    inner: Station,
    outer: Station,
    motions: tuple[Array, Array],
    outboard: list[tuple[Array, Array]],
) -> BayLoads:
    """Section loads and relative motion of a bay.

    Parameters
    ----------
    motions : two (6, k) arrays
        Of inner and outer station.
    outboard : list of (3,) and (6, k) arrays
        Point and wrench of every station beyond the bay.
    """
    middle = (inner.point + outer.point) / 2
    section = np.sum([wrench_transfer(point - middle) @ load for point, load in outboard], axis=0)
    relative = carried(motions[1], middle - outer.point)
    relative = relative - carried(motions[0], middle - inner.point)
    return BayLoads(section, relative)


def bay_section(inner: Station, outer: Station, loads: BayLoads) -> BaySection:
    """Uniform beam that fits a bay's load cases.

    Raises
    ------
    ModelError
        The bay's flexibility is not that of an elastic body.
    """
    span = outer.point - inner.point
    length = float(np.linalg.norm(span))
    axes = np.eye(3)
    axes[0] = span / length
    third = np.cross(axes[0], np.eye(3)[np.argmin(np.abs(span))])
    axes[2] = third / np.linalg.norm(third)
    axes[1] = np.cross(axes[2], axes[0])
    local = loads.turned(axes)
    coupled = local.flexibility()
    # A force at (y, z) from the middle adds the torque y V3 - z V2.
    shift = np.array([0.0, -coupled[3, 2], coupled[3, 1]]) / coupled[3, 3]
    local = local.at(shift)
    # Plane 1 bends about the third axis, the one of least bending flexibility.
    stiffest = np.linalg.eigh(local.flexibility()[4:, 4:])[1][:, 0]
    principal = np.eye(3)
    principal[2, 1:] = stiffest
    principal[1, 1:] = [stiffest[1], -stiffest[0]]
    local = local.turned(principal)
    together, alone = np.diag(local.flexibility()), local.diagonal()
    # A component that hardly loads this bay may come out negative by itself.
    values = np.where(alone > 0.0, alone, together)
    if values[0] <= 0.0 and np.all(values[1:] > 0.0):
        # Axial force in a swept box comes with bending whose motion along the axis outweighs its
        # own: it cannot be told, and is small. The bay does not give way along itself.
        values[0] = _STIFF * min(values[1], values[2])
    if not np.all(values > 0.0):
        raise ModelError(
            f"bay {inner.name} to {outer.name} has flexibilities {values.tolist()} in its own axes"
        )
    bending_2, bending_1 = length / values[4], length / values[5]
    shears = []
    for value, stiffness in ((values[1], bending_1), (values[2], bending_2)):
        rest = float(value - length**3 / (12 * stiffness))
        shears.append(length / rest if rest > 0.0 else np.inf)
    return BaySection(
        length=length,
        axial=float(length / values[0]),
        bending_1=float(bending_1),
        bending_2=float(bending_2),
        torsion=float(length / values[3]),
        shear_1=shears[0],
        shear_2=shears[1],
        orientation=(principal @ axes)[1],
        offset=axes.T @ shift,
    )
