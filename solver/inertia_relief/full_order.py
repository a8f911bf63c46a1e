"""Extended inertia relief at full order: every freedom of the mesh, every W term of eq (15).

Newmark's average acceleration with one factorisation of ``K + c M``, which is not singular though
nothing supports the structure.  The W terms change with the rate at every step; they stand on the
right-hand side and are iterated until they agree with the displacement they depend on.  The
frame is the mean-axis frame, hence the rigid resultant of the W terms is the reaction of the
frame (a change of the rigid motion, which the rigid-body model owns) and is taken out with the
d'Alembert loads of `FreeBody.self_equilibrated`, as is the rounding of the balanced loads.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.errors import ModelError
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.factor import factorise
from solver.inertia_relief.free_body import FreeBody
from solver.inertia_relief.motion import RigidMotion
from solver.inertia_relief.rate_terms import RateTerms
from solver.inertia_relief.static import inertia_relief, steady_state
from solver.progress import Progress, silent

#: Called with the index of the first sample and the displacements (n, nb) of a block of samples,
#: an array that is overwritten after the call.
BlockConsumer = Callable[[int, Array], None]


@dataclass(frozen=True, slots=True)
class BodyLoads:
    """Loads on a free body, piecewise linear between samples of a uniform time grid."""

    time: Array  #: (nt,) [s]
    shapes: Array  #: (n, k) applied loads of unit amplitude
    amplitudes: Array  #: (nt, k)
    motion: RigidMotion


@dataclass(frozen=True, slots=True)
class FullOrderReport:
    """What an integration did."""

    steps: int
    time_step: float  #: [s]
    solves: int  #: linear solves, iterations of the W terms included
    steady_sweeps: int
    largest_frame_reaction: float  #: rigid resultant of the W terms relative to the weight


def integrate_full_order(
    body: FreeBody,
    loads: BodyLoads,
    damping: RayleighDamping,
    consume: BlockConsumer,
    substeps: int = 1,
    tolerance: float = 1e-8,
    block: int = 64,
    progress: Progress = silent,
) -> FullOrderReport:
    """Integrate eq (15) from the steady state of the first sample, at rest.

    Parameters
    ----------
    consume : callable
        Receives the displacement at every sample of the loads, in blocks.
    substeps : int
        Time steps between two samples.
    tolerance : float
        Change of the W terms between iterations relative to the load, where iteration stops.

    Notes
    -----
    Newmark, "A method of computation for structural dynamics", 1959, beta 1/4, gamma 1/2.
    """
    return integrate_together(
        body, [loads], damping, [consume], substeps, tolerance, block, progress
    )


def integrate_together(
    body: FreeBody,
    landings: Sequence[BodyLoads],
    damping: RayleighDamping,
    consumers: Sequence[BlockConsumer],
    substeps: int = 1,
    tolerance: float = 1e-8,
    block: int = 64,
    progress: Progress = silent,
) -> FullOrderReport:
    """Integrate several landings of one loading side by side, see `integrate_full_order`.

    They share the factors, which are read once for all right-hand sides of a step.  Every landing
    has its own consumer.

    Raises
    ------
    ModelError
        The landings differ in their time grid or in the shapes of their loads.
    """
    _check_alike(landings)
    time, shapes, origin = landings[0].time, landings[0].shapes, landings[0].motion.origin
    count = len(time)
    step = float(time[1] - time[0]) / substeps
    inertial = body.inertia.rigid_load_shapes(origin)
    # landing by landing along the last axis
    applied = np.stack([loads.amplitudes for loads in landings], axis=2)
    inertia_amplitudes = np.stack([loads.motion.inertia_amplitudes() for loads in landings], axis=2)
    rate = np.stack([loads.motion.rate for loads in landings], axis=1)
    rate_derivative = np.stack([loads.motion.rate_derivative for loads in landings], axis=1)

    def load_at(sample: int) -> Array:
        total = shapes @ applied[sample] + inertial @ inertia_amplitudes[sample]
        return np.asfortranarray(body.self_equilibrated(total))

    relief = inertia_relief(body)
    load = load_at(0)
    steady = [
        steady_state(relief, load[:, k], rate[0, k], rate_derivative[0, k])
        for k in range(len(landings))
    ]
    del relief
    displacement = np.asfortranarray(np.stack([shape for shape, _ in steady], axis=1))
    velocity, acceleration = np.zeros_like(displacement), np.zeros_like(displacement)
    terms = RateTerms(body.inertia)
    alpha, beta = damping.mass_coefficient, damping.stiffness_coefficient
    stiffness, mass = body.stiffness, body.mass
    factor = factorise(stiffness * (1 + 2 * beta / step) + mass * (4 / step**2 + 2 * alpha / step))
    weight = body.total_mass * max(float(np.linalg.norm(landings[0].motion.gravity[0])), 1.0)
    scale = np.array([1.0] * 3 + [1 / body.gyration_radius] * 3)
    reaction = 0.0
    turning = np.any(rate, axis=(1, 2)) | np.any(rate_derivative, axis=(1, 2))

    samples = np.empty((len(landings), len(displacement), min(block, count)))
    samples[:, :, 0], filled, first = displacement.T, 1, 0
    force = previous = terms.force(rate[0], rate_derivative[0], displacement, velocity)
    solves = 0
    for sample in range(1, count):
        if filled == samples.shape[2]:
            for consume, part in zip(consumers, samples, strict=True):
                consume(first, part)
            first, filled = first + filled, 0
            progress("full-order integration", sample / count)
        target = load_at(sample)
        rotates = bool(turning[sample] or turning[sample - 1])
        for substep in range(1, substeps + 1):
            share = substep / substeps
            now = load + share * (target - load)
            omega = rate[sample - 1] + share * (rate[sample] - rate[sample - 1])
            omega_dot = rate_derivative[sample - 1] + share * (
                rate_derivative[sample] - rate_derivative[sample - 1]
            )
            history = mass @ (
                (4 / step**2 + 2 * alpha / step) * displacement
                + (4 / step + alpha) * velocity
                + acceleration
            ) + stiffness @ (beta * (2 / step * displacement + velocity))
            guess = 2 * force - previous if rotates else np.zeros_like(force)
            limit = tolerance * np.linalg.norm(now, axis=0)
            while True:
                balanced = body.self_equilibrated(guess) if rotates else guess
                updated = factor.solve(np.asfortranarray(now - balanced + history))
                solves += 1
                new_velocity = 2 / step * (updated - displacement) - velocity
                if not rotates:
                    break
                found = terms.force(omega, omega_dot, updated, new_velocity)
                change = np.linalg.norm(found - guess, axis=0)
                guess = found
                if np.all(change <= limit):
                    break
            acceleration = (
                4 / step**2 * (updated - displacement) - 4 / step * velocity - acceleration
            )
            displacement, velocity = updated, new_velocity
            previous, force = force, guess
            if rotates:
                resultant = np.linalg.norm(scale[:, None] * (body.rigid_modes.T @ force), axis=0)
                reaction = max(reaction, float(resultant.max()) / weight)
        load = target
        samples[:, :, filled] = displacement.T
        filled += 1
    for consume, part in zip(consumers, samples, strict=True):
        consume(first, part[:, :filled])
    progress("full-order integration", 1.0)
    sweeps = max(sweeps for _, sweeps in steady)
    return FullOrderReport((count - 1) * substeps, step, solves, sweeps, reaction)


def _check_alike(landings: Sequence[BodyLoads]) -> None:
    one = landings[0]
    for number, other in enumerate(landings):
        same = (
            (one.time, other.time),
            (one.shapes, other.shapes),
            (one.motion.origin, other.motion.origin),
        )
        if not all(left is right or np.array_equal(left, right) for left, right in same):
            raise ModelError(
                f"landing {number} has another time grid, origin or load shapes than the first"
            )
