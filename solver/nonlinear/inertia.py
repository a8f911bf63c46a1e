"""Inertia of a structure at finite rotation: mass points on turned arms, and rotary bodies.

Mass points and their coupled masses are those of the linear model (`solver.fe.mass`), so that both
models weigh the same in every respect; only their places follow the turned nodes, offsets and beam
axes without linearisation.  A force on a point goes back to the nodes by the exact derivative of
its place.  Coriolis and centrifugal terms need no formula: they are in the accelerations.
"""

from dataclasses import dataclass

import numba
import numpy as np
from scipy.sparse import block_diag, csr_array, diags_array

from solver.arrays import Array, IntArray
from solver.fe.beam import (
    STATIONS,
    beam_geometry,
    beam_mass_points,
    beam_rotary_inertia,
)
from solver.fe.mass import shell_mass
from solver.fe.model import FiniteElementModel
from solver.fe.sections import beam_sections, shell_sections
from solver.nonlinear.beam_kernels import beam_point_loads, beam_points
from solver.nonlinear.configuration import Configuration


@dataclass(frozen=True, slots=True)
class MassPoints:
    """Mass points: at nodes of shells, then along beams, then at arms from nodes (lumped)."""

    shell_nodes: IntArray  #: (a,)
    beam_nodes: IntArray  #: (b, 2)
    beam_offsets: Array  #: (b, 2, 3) [m]
    beam_frames: Array  #: (b, 3, 3) initial
    beam_shapes: Array  #: (b, stations, 2, 2) see `beam_points` [m]
    lumped_nodes: IntArray  #: (c,)
    lumped_arms: Array  #: (c, 3) initial axes [m]
    mass: csr_array  #: (p, p) symmetric, p = a + b stations + c [kg]

    @property
    def count(self) -> int:
        """Number of points p."""
        return int(self.mass.shape[0])

    @property
    def _beams(self) -> slice:
        first = len(self.shell_nodes)
        return slice(first, first + len(self.beam_nodes) * len(STATIONS))

    def places(self, at: Configuration) -> Array:
        """Positions (p, 3) [m]."""
        out = np.empty((self.count, 3))
        beams = self._beams
        out[: beams.start] = at.positions[self.shell_nodes]
        beam_points(
            self.beam_nodes,
            self.beam_offsets,
            self.beam_frames,
            STATIONS,
            self.beam_shapes,
            at.positions,
            at.rotations,
            out[beams].reshape(len(self.beam_nodes), -1, 3),
        )
        out[beams.stop :] = at.positions[self.lumped_nodes] + self._arms(at)
        return out

    def add_loads(self, at: Configuration, places: Array, forces: Array, out: Array) -> None:
        """Add nodal loads (n, 6) of ``forces`` (p, 3) that act at ``places`` (p, 3).

        The places may stand a little beside those of the configuration (the mean over a step); the
        moment of the loads is that of the forces at their places.
        """
        beams = self._beams
        _to_nodes(self.shell_nodes, at.positions, places[: beams.start], forces[: beams.start], out)
        beam_point_loads(
            self.beam_nodes,
            self.beam_offsets,
            self.beam_frames,
            STATIONS,
            self.beam_shapes,
            at.positions,
            at.rotations,
            places[beams].reshape(len(self.beam_nodes), -1, 3),
            forces[beams].reshape(len(self.beam_nodes), -1, 3),
            out,
        )
        _to_nodes(self.lumped_nodes, at.positions, places[beams.stop :], forces[beams.stop :], out)

    def _arms(self, at: Configuration) -> Array:
        arms: Array = np.einsum("kij,kj->ki", at.rotations[self.lumped_nodes], self.lumped_arms)
        return arms


@dataclass(frozen=True, slots=True)
class RotaryBodies:
    """Rotary inertia of nodes."""

    nodes: IntArray  #: (k,) each named once
    inertia: Array  #: J (k, 3, 3) body axes, which are the initial ones [kg m2]

    def momentum(self, rotations: Array, rates: Array) -> Array:
        """Angular momentum (k, 3) in inertial axes, from rates (k, 3) in body axes [N m s]."""
        out = np.empty_like(rates)
        _rotary_momentum(self.nodes, self.inertia, rotations, rates, out)
        return out

    def mean_rates(self, before: Array, after: Array, step: float) -> Array:
        """Rates (k, 3) in body axes of Cayley turns between rotations (n, 3, 3) [rad/s]."""
        out = np.empty((len(self.nodes), 3))
        _cayley_rates(self.nodes, before, after, step, out)
        return out


@numba.njit(cache=True, error_model="numpy")
def _to_nodes(
    nodes: IntArray, positions: Array, places: Array, forces: Array, loads: Array
) -> None:
    """Add forces (k, 3) at their places to the loads of the nodes that carry them."""
    for k in range(len(nodes)):
        at = nodes[k]
        x = places[k, 0] - positions[at, 0]
        y = places[k, 1] - positions[at, 1]
        z = places[k, 2] - positions[at, 2]
        for i in range(3):
            loads[at, i] += forces[k, i]
        loads[at, 3] += y * forces[k, 2] - z * forces[k, 1]
        loads[at, 4] += z * forces[k, 0] - x * forces[k, 2]
        loads[at, 5] += x * forces[k, 1] - y * forces[k, 0]


@numba.njit(cache=True, error_model="numpy")
def _rotary_momentum(
    nodes: IntArray, inertia: Array, rotations: Array, rates: Array, out: Array
) -> None:
    body = np.empty(3)
    for k in range(len(nodes)):
        turn = rotations[nodes[k]]
        for i in range(3):
            body[i] = (
                inertia[k, i, 0] * rates[k, 0]
                + inertia[k, i, 1] * rates[k, 1]
                + inertia[k, i, 2] * rates[k, 2]
            )
        for i in range(3):
            out[k, i] = turn[i, 0] * body[0] + turn[i, 1] * body[1] + turn[i, 2] * body[2]


@numba.njit(cache=True, error_model="numpy")
def _cayley_rates(nodes: IntArray, before: Array, after: Array, step: float, out: Array) -> None:
    """Skew part of ``before' after`` times 4 / (1 + trace), an axis of length 2 tan(angle / 2)."""
    relative = np.empty((3, 3))
    for k in range(len(nodes)):
        a, b = before[nodes[k]], after[nodes[k]]
        for i in range(3):
            for j in range(3):
                relative[i, j] = a[0, i] * b[0, j] + a[1, i] * b[1, j] + a[2, i] * b[2, j]
        factor = 2.0 / ((1.0 + relative[0, 0] + relative[1, 1] + relative[2, 2]) * step)
        out[k, 0] = factor * (relative[2, 1] - relative[1, 2])
        out[k, 1] = factor * (relative[0, 2] - relative[2, 0])
        out[k, 2] = factor * (relative[1, 0] - relative[0, 1])


def finite_inertia(model: FiniteElementModel) -> tuple[MassPoints, RotaryBodies]:
    """Inertia of a model: elements, nonstructural mass and lumped masses."""
    quads, triangles = shell_sections(model, model.quads), shell_sections(model, model.triangles)
    beams, geometry = (
        beam_sections(model, model.beams),
        beam_geometry(model.coordinates, model.beams),
    )
    lumped = model.point_masses
    scalar, rotary_nodes, shell_rotary = shell_mass(model, quads, triangles)
    shell_nodes = np.unique(
        np.concatenate([model.quads.nodes.ravel(), model.triangles.nodes.ravel()])
    )
    _, masses, shapes = beam_mass_points(geometry, beams)
    # the same shapes in the beam's axes, from the freedoms of its ends
    local = geometry.frames[:, None] @ shapes @ np.linalg.inv(geometry.link)[:, None]
    slopes = np.empty((*masses.shape, 2, 2))
    # a slope along e3 is a negative rotation about e2
    slopes[:, :, 0, 0], slopes[:, :, 0, 1] = local[:, :, 1, 5], local[:, :, 1, 11]
    slopes[:, :, 1, 0], slopes[:, :, 1, 1] = -local[:, :, 2, 4], -local[:, :, 2, 10]

    halves = 0.5 * np.repeat(beam_rotary_inertia(geometry, beams), 2, axis=0)
    rotary = np.zeros((model.node_count, 3, 3))
    np.add.at(rotary, rotary_nodes, shell_rotary)
    np.add.at(rotary, model.beams.nodes.ravel(), halves)
    np.add.at(rotary, lumped.nodes, lumped.inertias)
    turning = np.flatnonzero(np.any(rotary != 0.0, axis=(1, 2)))
    points = MassPoints(
        shell_nodes=shell_nodes,
        beam_nodes=np.ascontiguousarray(model.beams.nodes, dtype=np.int64),
        beam_offsets=np.ascontiguousarray(model.beams.offsets, dtype=np.float64),
        beam_frames=geometry.frames,
        beam_shapes=slopes,
        lumped_nodes=np.asarray(lumped.nodes, dtype=np.int64),
        lumped_arms=np.asarray(lumped.offsets, dtype=np.float64),
        mass=csr_array(
            block_diag(
                [
                    scalar[shell_nodes][:, shell_nodes],
                    diags_array(masses.ravel()),
                    diags_array(lumped.masses),
                ]
            )
        ),
    )
    return points, RotaryBodies(turning, rotary[turning])
