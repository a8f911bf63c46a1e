"""Inertia of the structure in a turning frame, kept as mass points and rotary bodies.

The kinetic energy of small displacements u in a frame that turns at the rate w is

    T = 1/2 (N u' + W N u)' (m kron I3) (N u' + W N u) + 1/2 (R u' + W R u)' J (R u' + W R u)

with N u the displacement of the mass points, R u the rotation vectors of the rotary bodies and
W = skew(w).  Lagrange's equation gives the terms of the paper's eq (15) in symmetric form:

    M u'' + (M W - W' M) u' + (M dW/dt - W' M W) u

where W acts on translations and on rotations alike, since both are vectors seen from the turning
frame: a beam spinning about its axis shows its bending frequencies shifted by exactly the spin.
As every mass point has the same inertia in all directions, M W = W M for the points, and all terms
follow from the positions of the points without any further approximation.

Loads of the frame's own motion on a point at r from the frame's origin are
m (g - a - (W' + W W) r), on a rotary body -(J w' + w x J w); rigid modes turn them into the
Newton-Euler equations to rounding.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import block_diag, bsr_array, csc_array, csr_array, diags_array, kron, vstack

from solver.arrays import Array, IntArray
from solver.fe.model import PointMasses
from solver.frames import skew

#: Generators of rotation: skew matrices of unit rates about x, y, z.
GENERATORS = skew(np.eye(3))
#: Order of the products of rates in `Inertia.rigid_load_shapes`.
RATE_PRODUCTS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


@dataclass(frozen=True, slots=True)
class MassProperties:
    """Rigid-body inertia in structural axes."""

    mass: float  #: [kg]
    centre_of_gravity: Array  #: (3,) [m]
    inertia: Array  #: (3, 3) tensor about the centre of gravity [kg m2]


@dataclass(frozen=True, slots=True)
class Inertia:
    """Mass points and rotary bodies that follow the free freedoms.

    Three-component arrays of points and bodies are stored point by point: row 3 i + component.
    """

    points: Array  #: (p, 3) positions of the mass points [m]
    interpolation: csr_array  #: N (3 p, n_free) displacement of the points
    scalar_mass: csr_array  #: m (p, p) symmetric [kg]
    rotary_interpolation: csr_array  #: R (3 k, n_free) rotation vectors of the rotary bodies
    rotary: Array  #: J (k, 3, 3) symmetric [kg m2]

    @property
    def n_free(self) -> int:
        """Number of free freedoms."""
        return int(self.interpolation.shape[1])

    def mass_matrix(self) -> csc_array:
        """Mass matrix M (n_free, n_free) [kg, kg m, kg m2]."""
        return self._assembled(self.scalar_mass, np.eye(3), self.rotary)

    def gyroscopic(self, axis: int) -> csc_array:
        """Coefficient G_k of ``rate[axis]`` in the velocity term, M W - W' M; skew."""
        turn = GENERATORS[axis]
        return self._assembled(
            self.scalar_mass, 2.0 * turn, self.rotary @ turn + turn @ self.rotary
        )

    def euler(self, axis: int) -> csc_array:
        """Coefficient E_k of ``rate_derivative[axis]`` in the displacement term, M dW/dt.

        Skew for the mass points (half of G_k); J dW/dt of a rotary body is skew only where J is
        the same about all axes.
        """
        turn = GENERATORS[axis]
        return self._assembled(self.scalar_mass, turn, self.rotary @ turn)

    def centrifugal(self, i: int, j: int) -> csc_array:
        """Coefficient C_ij of ``rate[i] rate[j]`` (i <= j) in the displacement term, -W' M W.

        Symmetric; the sum over i <= j is negative semidefinite for every rate.
        """
        a, b = GENERATORS[i], GENERATORS[j]
        product = a @ b if i == j else a @ b + b @ a
        rotary = a @ self.rotary @ b
        if i != j:
            rotary = rotary + b @ self.rotary @ a
        return self._assembled(self.scalar_mass, product, rotary)

    def gravity_shapes(self) -> Array:
        """Give loads (n_free, 3) of unit specific force along x, y, z: N' m 1 [kg, kg m]."""
        lumped = np.asarray(self.scalar_mass.sum(axis=1)).ravel()
        field = np.einsum("p,ic->pic", lumped, np.eye(3)).reshape(-1, 3)
        return np.asarray(self.interpolation.T @ field)

    def rigid_load_shapes(self, origin: Array) -> Array:
        """Inertia loads (n_free, 12) of unit motions of the frame about ``origin`` (3,).

        Columns: acceleration minus gravity along x, y, z [per m/s2]; rate derivative x, y, z
        [per rad/s2]; products of rates xx, yy, zz, xy, xz, yz [per rad2/s2].  With s those twelve
        numbers, the load is ``rigid_load_shapes(origin) @ s``.
        """
        levers = self.points - origin
        fields = [np.broadcast_to(np.eye(3), (len(levers), 3, 3))]
        bodies = [np.zeros((len(self.rotary), 3, 3))]
        fields.append(np.stack([levers @ turn.T for turn in GENERATORS], axis=2))
        bodies.append(np.array(self.rotary))
        for i, j in RATE_PRODUCTS:
            a, b = GENERATORS[i], GENERATORS[j]
            product = a @ b if i == j else a @ b + b @ a
            moment = self.rotary[:, :, j] @ a.T
            if i != j:
                moment = moment + self.rotary[:, :, i] @ b.T
            fields.append((levers @ product.T)[:, :, None])
            bodies.append(moment[:, :, None])
        accelerations = np.concatenate(fields, axis=2)
        weighted = self.scalar_mass @ accelerations.reshape(len(levers), -1)
        moments = np.concatenate(bodies, axis=2).reshape(-1, 12)
        load = self.interpolation.T @ weighted.reshape(-1, 12)
        return -np.asarray(load + self.rotary_interpolation.T @ moments)

    def rigid_load(
        self,
        acceleration: Array,
        gravity: Array,
        rate: Array,
        rate_derivative: Array,
        origin: Array,
    ) -> Array:
        """Give the loads (n_free, nt) of gravity and of the frame's own motion on the structure.

        Parameters
        ----------
        acceleration : (nt, 3) array
            Inertial acceleration of ``origin`` [m/s2]; structural axes here and below.
        gravity : (nt, 3) array
            Acceleration of gravity [m/s2].
        rate, rate_derivative : (nt, 3) array
            Angular rate of the frame and its derivative [rad/s, rad/s2].
        origin : (3,) array
            Origin of the frame [m].
        """
        products = np.stack([rate[:, i] * rate[:, j] for i, j in RATE_PRODUCTS], axis=1)
        motion = np.concatenate([acceleration - gravity, rate_derivative, products], axis=1)
        load: Array = self.rigid_load_shapes(origin) @ motion.T
        return load

    def rigid_body_properties(self) -> MassProperties:
        """Mass, centre of gravity and inertia: Phi_R' M Phi_R, from the points' positions.

        Constraints and elements carry rigid motion exactly, so that the moments of the points
        are those of the mass matrix on the rigid modes.
        """
        lumped = np.asarray(self.scalar_mass.sum(axis=1)).ravel()
        mass = float(lumped.sum())
        if mass == 0.0:
            return MassProperties(0.0, np.zeros(3), self.rotary.sum(axis=0))
        centre = lumped @ self.points / mass
        levers = self.points - centre
        second = levers.T @ (self.scalar_mass @ levers)
        inertia = np.trace(second) * np.eye(3) - second + self.rotary.sum(axis=0)
        return MassProperties(mass, centre, 0.5 * (inertia + inertia.T))

    def _assembled(self, scalar: csr_array, direction: Array, bodies: Array) -> csc_array:
        """N' (m kron direction) N + R' blockdiag(bodies) R."""
        points = self.interpolation.T @ (kron(scalar, direction, format="csr") @ self.interpolation)
        if len(bodies) == 0:
            return csc_array(points)
        blocks = _block_diagonal(bodies)
        rotations = self.rotary_interpolation.T @ (blocks @ self.rotary_interpolation)
        return csc_array(points + rotations)


def combine(parts: Sequence[tuple[float, Inertia]]) -> Inertia:
    """Sum of factor times part over parts on the same free freedoms (mass is affine in them).

    Parts with factor zero are left out; at least one part must be given.
    """
    used = [(factor, part) for factor, part in parts if factor != 0.0] or [(0.0, parts[0][1])]
    return Inertia(
        points=np.concatenate([part.points for _, part in used]),
        interpolation=csr_array(vstack([part.interpolation for _, part in used])),
        scalar_mass=csr_array(block_diag([factor * part.scalar_mass for factor, part in used])),
        rotary_interpolation=csr_array(vstack([part.rotary_interpolation for _, part in used])),
        rotary=np.concatenate([factor * part.rotary for factor, part in used]),
    )


def point_mass_inertia(
    transformation: csr_array, coordinates: Array, masses: PointMasses
) -> Inertia:
    """Inertia of lumped masses rigidly attached to nodes (CONM2).

    Parameters
    ----------
    transformation : (6 n, n_free) sparse array
        Of the structure that carries them.
    coordinates : (n, 3) array
        Node positions [m].
    masses : PointMasses
        Their nodes are rows of ``coordinates``.
    """
    nodes = masses.nodes
    turning = np.flatnonzero(np.any(masses.inertias != 0.0, axis=(1, 2)))
    return Inertia(
        points=coordinates[nodes] + masses.offsets,
        interpolation=attached_points(nodes, masses.offsets, len(coordinates)) @ transformation,
        scalar_mass=csr_array(diags_array(masses.masses)),
        rotary_interpolation=node_rotations(nodes[turning], len(coordinates)) @ transformation,
        rotary=masses.inertias[turning],
    )


def attached_points(nodes: IntArray, offsets: Array, node_count: int) -> csr_array:
    """Displacement (3 p, 6 n) of points held rigidly at ``offsets`` (p, 3) from their nodes."""
    blocks = np.concatenate(
        [np.broadcast_to(np.eye(3), (len(nodes), 3, 3)), -skew(offsets)], axis=2
    )
    return _node_blocks(nodes, blocks, node_count)


def node_rotations(nodes: IntArray, node_count: int) -> csr_array:
    """Rotation vectors (3 k, 6 n) of nodes."""
    blocks = np.zeros((len(nodes), 3, 6))
    blocks[:, :, 3:] = np.eye(3)
    return _node_blocks(nodes, blocks, node_count)


def _node_blocks(nodes: IntArray, blocks: Array, node_count: int) -> csr_array:
    """Sparse rows of blocks (p, r, 6), block i acting on the freedoms of node ``nodes[i]``."""
    count, rows = blocks.shape[:2]
    matrix = bsr_array(
        (np.ascontiguousarray(blocks), nodes, np.arange(count + 1)),
        shape=(rows * count, 6 * node_count),
    )
    return _without_zeros(matrix)


def _block_diagonal(blocks: Array) -> csr_array:
    count, size = blocks.shape[:2]
    matrix = bsr_array(
        (np.ascontiguousarray(blocks), np.arange(count), np.arange(count + 1)),
        shape=(size * count, size * count),
    )
    return _without_zeros(matrix)


def _without_zeros(matrix: bsr_array) -> csr_array:
    rows = csr_array(matrix.tocsr())
    rows.eliminate_zeros()
    return rows
