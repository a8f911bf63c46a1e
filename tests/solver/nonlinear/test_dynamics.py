"""Free motion: what it keeps, in whatever axes, and how it converges."""

from itertools import pairwise

import numpy as np
import pytest

from solver.arrays import Array
from solver.errors import SimulationDivergedError
from solver.fe.structure import build_structure
from solver.frames import rotation_matrix
from solver.inertia_relief.damping import RayleighDamping
from solver.nonlinear.account import kinetic_energy, momenta
from solver.nonlinear.checkpoint import Checkpoint, Sample
from solver.nonlinear.configuration import Pose, initial_pose
from solver.nonlinear.correction import Corrector
from solver.nonlinear.integrate import integrate_nonlinear
from solver.nonlinear.loads import DirectedLoads, dead_loads, no_loads
from solver.nonlinear.midpoint import UNDAMPED, motion_of
from tests.solver.nonlinear.bodies import FAR_TURN, disturbed_pose, mixed, mixed_model
from verification.nonlinear.flying_beam import PLANE, SPACE, flying_beam
from verification.nonlinear.small_loads import small_loads

STEP = 2e-3
RATE = np.array([3.0, 5.0, -4.0])
#: Smooth enough to be followed by the steps used here.
BENT = 2e-4


def bent_pose() -> Pose:
    """The mixed body bent and twisted a little."""
    structure = mixed()
    x, y, _ = structure.model.coordinates[structure.free_nodes].T
    freedoms = np.zeros((len(x), 6))
    freedoms[:, 2] = BENT * x**2
    freedoms[:, 4] = -2 * BENT * x
    freedoms[:, 3] = BENT * y
    return disturbed_pose(structure, freedoms)


def fly(
    steps: int,
    step: float = STEP,
    pose: Pose | None = None,
    velocity: Array = np.array([1.0, 2.0, 3.0]),  # noqa: B008
    rate: Array = RATE,
    loads: DirectedLoads | None = None,
    damping: RayleighDamping = UNDAMPED,
    tolerance: float = 1e-9,
    **options,
) -> list[Sample]:
    structure = mixed()
    mass = build_structure(mixed_model()).inertia.mass_matrix()
    samples: list[Sample] = []
    integrate_nonlinear(
        structure,
        motion_of(structure, bent_pose() if pose is None else pose, velocity, rate),
        no_loads(structure.model.node_count) if loads is None else loads,
        damping,
        Corrector(structure, mass, step, damping),
        step,
        steps,
        options.pop("record", samples.append),
        tolerance=tolerance,
        **options,
    )
    return samples


def energy(sample: Sample) -> float:
    structure = mixed()
    strain = structure.elements.strain_energy(sample.motion.deformations)
    return kinetic_energy(structure, sample.motion) + strain


def test_free_flight_keeps_momentum_and_energy_over_a_revolution():
    # 1.2 s at 7 rad/s: more than a revolution, about no principal axis, while the body rings
    samples = fly(240, step=5e-3)
    structure, first = mixed(), samples[0]
    turned = np.trace(samples[45].motion.at.rotations[0])
    assert turned == pytest.approx(1 + 2 * np.cos(1.6), abs=0.1)  # rad, after an eighth
    kept = momenta(structure, first.motion)
    for sample in samples[::20]:
        found = momenta(structure, sample.motion)
        np.testing.assert_allclose(found[:3], kept[:3], rtol=1e-9)
        np.testing.assert_allclose(found[3:], kept[3:], atol=1e-9 * np.linalg.norm(kept[3:]))
    energies = np.array([energy(sample) for sample in samples])
    strain = mixed().elements.strain_energy(first.motion.deformations)
    # second order in time, without a trend
    assert np.abs(energies - energies[0]).max() < 5e-4 * strain
    assert abs(energies[-80:].mean() - energies[:80].mean()) < 1e-4 * strain


def test_damping_takes_energy_but_no_momentum():
    samples = fly(200, damping=RayleighDamping(ratio=0.05))
    structure, last = mixed(), samples[-1]
    before, after = (momenta(structure, samples[k].motion) for k in (0, -1))
    np.testing.assert_allclose(after[:3], before[:3], rtol=1e-9)
    np.testing.assert_allclose(after[3:], before[3:], atol=1e-9 * np.linalg.norm(before[3:]))
    assert last.account.damping_work > 0.0
    # what the elements took is stored or lost, and never comes back
    kinetic = [kinetic_energy(structure, samples[k].motion) for k in (0, -1)]
    taken = last.account.elastic_work + last.account.damping_work
    assert kinetic[1] - kinetic[0] + taken == pytest.approx(0.0, abs=1e-5 * kinetic[0])
    energies = np.array([energy(sample) for sample in samples])
    assert energies[-1] < energies[0]


def test_loads_and_gravity_change_momentum_by_their_impulse():
    structure = mixed()
    shapes = np.random.default_rng(9).normal(size=(6 * structure.model.node_count, 2))
    times = np.array([0.0, 0.05, 0.1])
    amplitudes = np.array([[1.0, 0.0], [20.0, -10.0], [0.0, 30.0]])
    samples = fly(40, loads=dead_loads(times, shapes, amplitudes, np.array([0.0, 1.0, -9.8])))
    change = momenta(structure, samples[-1].motion) - momenta(structure, samples[0].motion)
    impulse = samples[-1].account.impulse
    np.testing.assert_allclose(change, impulse, atol=1e-8 * np.linalg.norm(impulse))
    account = samples[-1].account
    stored = energy(samples[-1]) - energy(samples[0])
    assert stored == pytest.approx(account.load_work + account.gravity_work, rel=1e-4)


def test_motion_does_not_depend_on_the_axes_it_is_seen_from():
    matrix = rotation_matrix(FAR_TURN)
    velocity, shift = np.array([1.0, 2.0, 3.0]), np.array([5.0, -3.0, 2.0])
    one = fly(30)[-1].motion
    pose = bent_pose().rigidly_moved(FAR_TURN, shift)
    there = matrix @ velocity - np.cross(matrix @ RATE, shift)
    other = fly(30, pose=pose, velocity=there, rate=matrix @ RATE)[-1].motion
    np.testing.assert_allclose(other.at.positions, one.at.positions @ matrix.T + shift, atol=1e-9)
    for a, b in zip(other.deformations.parts, one.deformations.parts, strict=True):
        np.testing.assert_allclose(a, b, atol=1e-9)


def test_interrupted_run_ends_where_an_uninterrupted_one_does(tmp_path, monkeypatch):
    monkeypatch.setattr("solver.nonlinear.checkpoint.INTERVAL", 0.0)

    class Trace:
        """Height of a node; the run is cut off at a sample."""

        def __init__(self, stop: int) -> None:
            self.heights, self.stop = np.zeros(31), stop

        def __call__(self, sample: Sample) -> None:
            if sample.index == self.stop:
                raise InterruptedError
            self.heights[sample.index] = sample.motion.at.positions[3, 2]

        def arrays(self) -> dict[str, Array]:
            return {"heights": self.heights}

        def restore(self, arrays: dict[str, Array]) -> None:
            self.heights = arrays["heights"].copy()

    whole, part, rest = Trace(99), Trace(14), Trace(99)
    place = Checkpoint(tmp_path / "run.npz", "this run")
    fly(30, record=whole)
    with pytest.raises(InterruptedError):
        fly(30, record=part, checkpoint=place)
    assert place.path.exists()
    fly(30, record=rest, checkpoint=place)
    # a resumed run factorises anew: equal to the tolerance of the iteration
    np.testing.assert_allclose(rest.heights, whole.heights, rtol=1e-8)
    assert not place.path.exists()


def test_checkpoint_of_another_run_is_not_taken_up(tmp_path, monkeypatch):
    monkeypatch.setattr("solver.nonlinear.checkpoint.INTERVAL", 0.0)
    place = tmp_path / "run.npz"
    np.savez(place, key=np.array("another run"))
    taken: list[int] = []

    class Indices:
        def __call__(self, sample: Sample) -> None:
            taken.append(sample.index)

        def arrays(self) -> dict[str, Array]:
            return {}

        def restore(self, arrays: dict[str, Array]) -> None:
            raise AssertionError("restored from another run")

    fly(3, record=Indices(), checkpoint=Checkpoint(place, "this run"))
    assert taken == [0, 1, 2, 3]


def test_step_without_a_solution_is_an_error():
    structure = mixed()
    torn = initial_pose(structure.model.coordinates)
    torn.positions[0] = np.nan
    with pytest.raises(SimulationDivergedError, match="finite numbers"):
        fly(1, pose=torn)


def test_flying_beam_converges_with_second_order_and_keeps_its_momentum():
    ends = [flying_beam(6, step, 5.0, PLANE) for step in (0.1, 0.05, 0.025)]
    errors = [np.abs(coarse.lower[-1] - fine.lower[-1]).max() for coarse, fine in pairwise(ends)]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.25)
    fine = ends[-1]
    # impulse of 8 over 2.5, closed form
    np.testing.assert_allclose(fine.momenta[-1, :3], [20.0, 0.0, 0.0], atol=1e-6)
    coasting = fine.time > 2.51
    angular = fine.momenta[coasting, 5]
    np.testing.assert_allclose(angular, angular[0], rtol=1e-7)
    np.testing.assert_allclose(fine.energy[coasting], fine.energy[-1], rtol=1e-3)


def test_beam_flying_in_space_keeps_momentum_and_energy():
    flight = flying_beam(6, 0.05, 7.0, SPACE)
    # the triangle of force has the impulse 20 * 5 / 2, closed form
    np.testing.assert_allclose(flight.momenta[-1, :3], [50.0, 0.0, 0.0], atol=1e-5)
    coasting = flight.time > 5.01
    angular = flight.momenta[coasting, 3:]
    np.testing.assert_allclose(angular, np.broadcast_to(angular[0], angular.shape), atol=1e-4)
    np.testing.assert_allclose(flight.energy[coasting], flight.energy[-1], rtol=1e-3)
    assert np.ptp(flight.upper[:, 2]) > 1.0  # it leaves the plane


def test_small_loads_are_answered_as_in_the_linear_analysis(mini):
    factors = np.array([0.45, 0.3, 0.8])[: len(mini.groups)]
    some, few = (small_loads(mini, factors, factor, samples=20) for factor in (1e-2, 1e-3))
    assert some.difference < 3e-4
    assert few.difference < 3e-5
