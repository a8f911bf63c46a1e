"""What is kept of a nonlinear run: peaks, fields at wanted times, the mean frame, the account."""

from collections.abc import Mapping
from dataclasses import astuple, dataclass, fields
from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Array, IntArray
from solver.nonlinear.account import kinetic_energy, momenta
from solver.nonlinear.checkpoint import Sample
from solver.nonlinear.configuration import initial_pose
from solver.nonlinear.integrate import NonlinearReport
from solver.nonlinear.mean_frame import mean_frame
from solver.nonlinear.structure import NonlinearStructure

if TYPE_CHECKING:
    from solver.fe.stress import StressRecovery

#: Sums of the account at every sample, in this order [J, N s, N m s].
ENERGIES = ("kinetic", "strain", "load work", "gravity work", "elastic work", "damping work")


@dataclass(frozen=True, slots=True)
class NonlinearLanding:
    """Result of a nonlinear landing; elements in the solver's order, von Mises stress [Pa].

    Inertial axes are the structural axes at the first sample, in steady motion with the velocity
    that the centre of gravity had there.
    """

    time: Array  #: (nt,) samples, those of the loads [s]
    peak_stress: Array  #: (ne,) largest over all samples
    peak_sample: IntArray  #: (ne,) and its sample
    largest_stress: Array  #: (nt,) largest of all elements
    largest_element: IntArray  #: (nt,) and its element
    stress_samples: IntArray  #: (nw,) samples whose whole field is kept
    stress: Array  #: (nw, ne) of these
    positions: Array  #: (nw, n, 3) of all nodes [m]
    centre: Array  #: (nt, 3) centre of gravity [m]
    turn: Array  #: (nt, 3, 3) turn of the airframe's mean frame since the first sample
    energies: Array  #: (nt, 6) see `ENERGIES` [J]
    momenta: Array  #: (nt, 6) momentum, angular momentum about the origin [N s, N m s]
    impulses: Array  #: (nt, 6) of loads and gravity since the first sample
    report: NonlinearReport

    def arrays(self) -> dict[str, Array]:
        """Everything as named arrays, to be stored; `of` takes them back."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        values["report"] = np.array(astuple(self.report), dtype=np.float64)
        return values

    @classmethod
    def of(cls, arrays: Mapping[str, Array]) -> "NonlinearLanding":
        """Undo `arrays`."""
        steps, iterations, seconds, factorisations, error = arrays["report"].tolist()
        report = NonlinearReport(int(steps), int(iterations), seconds, int(factorisations), error)
        return cls(**{**arrays, "report": report})  # type: ignore[arg-type]

    @property
    def energy_error(self) -> float:
        """Largest imbalance of the energy account, relative to the largest energy in it."""
        kinetic, strain, loads, gravity, elastic, damping = self.energies.T
        del strain  # the elastic work holds it, and what the damping took
        balance = kinetic - kinetic[0] + elastic + damping - loads - gravity
        return float(np.abs(balance).max() / np.abs(self.energies).max())

    @property
    def momentum_error(self) -> Array:
        """Largest imbalance of momentum and angular momentum, relative to the impulses' sizes."""
        balance = self.momenta - self.momenta[0] - self.impulses
        parts = [
            np.linalg.norm(balance[:, rows], axis=1).max()
            / np.linalg.norm(self.impulses[:, rows], axis=1).max()
            for rows in (slice(0, 3), slice(3, 6))
        ]
        return np.array(parts)


class StressRecorder:
    """Keeps peaks, wanted fields, the mean frame and the account of a run."""

    def __init__(
        self,
        structure: NonlinearStructure,
        recovery: "StressRecovery",
        samples: int,
        wanted: IntArray,
    ) -> None:
        count = recovery.n_shells + recovery.n_beams
        self._structure, self._recovery, self._wanted = structure, recovery, wanted
        at = structure.constraints.placed(initial_pose(structure.model.coordinates))
        self._initial = structure.points.places(at)
        self.kept: dict[str, Array] = {
            "peak_stress": np.zeros(count),
            "peak_sample": np.zeros(count),
            "largest_stress": np.zeros(samples),
            "largest_element": np.zeros(samples),
            "stress": np.zeros((len(wanted), count)),
            "positions": np.zeros((len(wanted), structure.model.node_count, 3)),
            "centre": np.zeros((samples, 3)),
            "turn": np.zeros((samples, 3, 3)),
            "energies": np.zeros((samples, len(ENERGIES))),
            "momenta": np.zeros((samples, 6)),
            "impulses": np.zeros((samples, 6)),
        }

    def __call__(self, sample: Sample) -> None:
        """Take a sample."""
        structure, kept, row = self._structure, self.kept, sample.index
        motion, account = sample.motion, sample.account
        shells, beams = structure.elements.stresses(motion.deformations)
        stress = self._recovery.von_mises(shells[:, None], beams[:, None])[:, 0]
        higher = stress > kept["peak_stress"]
        kept["peak_stress"][higher] = stress[higher]
        kept["peak_sample"][higher] = row
        kept["largest_element"][row] = stress.argmax()
        kept["largest_stress"][row] = stress.max()
        kept["centre"][row], kept["turn"][row] = mean_frame(structure, motion, self._initial)
        kept["energies"][row] = [
            kinetic_energy(structure, motion),
            structure.elements.strain_energy(motion.deformations),
            account.load_work,
            account.gravity_work,
            account.elastic_work,
            account.damping_work,
        ]
        kept["momenta"][row] = momenta(structure, motion)
        kept["impulses"][row] = account.impulse
        for place in np.flatnonzero(self._wanted == row):
            kept["stress"][place] = stress
            kept["positions"][place] = motion.at.positions

    def arrays(self) -> dict[str, Array]:
        """Everything kept so far."""
        return self.kept

    def restore(self, arrays: dict[str, Array]) -> None:
        """Take back what `arrays` gave."""
        self.kept = {name: array.copy() for name, array in arrays.items()}

    def result(self, time: Array, report: NonlinearReport) -> NonlinearLanding:
        """Give the finished run."""
        kept = self.kept
        return NonlinearLanding(
            time=time,
            peak_stress=kept["peak_stress"],
            peak_sample=kept["peak_sample"].astype(np.int64),
            largest_stress=kept["largest_stress"],
            largest_element=kept["largest_element"].astype(np.int64),
            stress_samples=self._wanted,
            stress=kept["stress"],
            positions=kept["positions"],
            centre=kept["centre"],
            turn=kept["turn"],
            energies=kept["energies"],
            momenta=kept["momenta"],
            impulses=kept["impulses"],
            report=report,
        )
