"""The free airframe under the first pin loads of a landing, by the solver and by Kratos.

The solver integrates in the mean-axis frame, the loads made self-equilibrated by extended inertia
relief; Kratos integrates the whole motion of the free structure by Newmark's scheme with the same
step.  The elastic part of its motion is what remains when its rigid part is
taken off; strains and stresses have none anyway.
"""

import numpy as np

from solver.arrays import Array
from solver.fe.model import FiniteElementModel
from solver.fe.stress import build_stress_recovery
from solver.fe.structure import Structure, build_structure
from solver.frames import body_structural
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.free_body import FreeBody, free_body
from solver.inertia_relief.full_order import BodyLoads, integrate_full_order
from solver.inertia_relief.motion import RigidMotion
from solver.landing.simulate import SimulationOptions, simulate_landing
from verification.cases import CASES
from verification.chapter import Comparisons, Item, Plot, Text
from verification.comparison import Comparison
from verification.peers.airframe_items import SOURCES
from verification.peers.apart import apart
from verification.peers.element_items import COMMON_RATIO
from verification.peers.kratos_model import THIN_QUAD
from verification.peers.kratos_runs import NodeLoads, free_transient
from verification.peers.variants import triangulated, with_poisson_ratio
from verification.plots import Line, Panel, line_plot
from verification.run import Run

STEP = 1e-3  #: [s]
STEPS = 40
CASE = "level"
SOURCE = "Kratos, Newmark's scheme of the whole free motion, same triangles and step"


def pin_loads(run: Run) -> NodeLoads:
    """Change of the pin loads since the contact, over the first steps of a landing."""
    airframe = run.airframe
    case = next(case for case in CASES if case.name == CASE)
    history = simulate_landing(
        airframe.landing_aircraft(np.ones(len(airframe.groups))),
        case.contact,
        SimulationOptions(
            output_interval=STEP, time_limit=2 * STEP * STEPS, stop_when_settled=False
        ),
    )
    loads = np.concatenate([gear.pin_loads for gear in history.gears], axis=1)[: STEPS + 1]
    structural = body_structural(loads.reshape(*loads.shape[:2], 2, 3)).reshape(loads.shape)
    return NodeLoads(STEP, airframe.pin_rows, structural[1:] - structural[0])


def transient_items(run: Run, model: FiniteElementModel) -> list[Item]:
    """Displacements and stresses of both."""
    twin = with_poisson_ratio(triangulated(model), COMMON_RATIO)
    loads = pin_loads(run)
    step = "transient by Kratos"
    peer = run.stored(
        "peer-transient",
        [twin, loads],
        (*SOURCES, "solver/landing", "solver/gear"),
        lambda: _kept(
            apart(
                free_transient,
                twin,
                loads,
                THIN_QUAD,
                report=lambda share: run.progress(step, share),
            )
        ),
    )
    run.progress("transient by the solver", 0.0)
    structure = build_structure(twin)
    body = free_body(structure)
    ours = _integrated(structure, body, loads)
    run.progress("transient by the solver", 0.6)
    theirs = _elastic(structure, body, peer["displacement"])
    risen = _risen(structure, body, loads, peer["displacement"])
    stress = _von_mises(structure, ours)
    run.progress("transient by the solver", 1.0)
    places = _places(model, loads)
    return [
        Text(
            "The free airframe is hit by the pin loads of the first 40 ms of a landing at 10 ft/s, "
            "in which spin-up drags the main gear aft, counted from their value at the contact. "
            "The solver integrates the elastic motion in the mean-axis frame, with loads made "
            "self-equilibrated as in every landing; Kratos integrates the whole free motion. No "
            "damping. The model is the twin of the modes above."
        ),
        _plot(structure, ours, theirs, places, stress, peer["von_mises"]),
        Comparisons(
            "First 40 ms of a landing beside Kratos",
            _compared(structure, ours, theirs, places, stress, peer["von_mises"], risen),
        ),
    ]


def _kept(found: dict[str, Array]) -> dict[str, Array]:
    """Keep the motion, and the von Mises stress of the worse face of every shell."""
    faces = [_von_mises_of_tensor(found[face]) for face in ("bottom", "top")]
    return {"displacement": found["displacement"], "von_mises": np.maximum(*faces)}


def _von_mises_of_tensor(stress: Array) -> Array:
    """Von Mises stress (...) of tensors (..., 3, 3)."""
    mean = np.trace(stress, axis1=-2, axis2=-1)[..., None, None] / 3.0
    deviator = stress - mean * np.eye(3)
    squared: Array = np.sqrt(1.5 * np.sum(deviator**2, axis=(-2, -1)))
    return squared


def _integrated(structure: Structure, body: FreeBody, loads: NodeLoads) -> Array:
    """Elastic displacement (nt, n_free) at the ends of the steps."""
    count = len(loads.loads) + 1
    still = np.zeros((count, 3))
    amplitudes = np.zeros((count, 6 * len(loads.nodes)))
    amplitudes[1:] = loads.loads.reshape(count - 1, -1)
    kept = np.zeros((count, structure.n_free))

    def keep(first: int, samples: Array) -> None:
        kept[first : first + samples.shape[1]] = samples.T

    integrate_full_order(
        body,
        BodyLoads(
            time=loads.step * np.arange(count, dtype=np.float64),
            shapes=structure.nodal_loads(loads.nodes).toarray(),
            amplitudes=amplitudes,
            motion=RigidMotion(body.centre_of_gravity, still, still, still, still),
        ),
        RayleighDamping(ratio=0.0),
        keep,
    )
    return kept[1:]


def _elastic(structure: Structure, body: FreeBody, displacement: Array) -> Array:
    """Elastic part (nt, n_free) of the peer's displacement (nt, n, 6)."""
    free = displacement.reshape(len(displacement), -1)[:, structure.free]
    return body.mean_axis(free.T).T


def _risen(
    structure: Structure, body: FreeBody, loads: NodeLoads, displacement: Array
) -> tuple[float, float]:
    """Rise of the centre of gravity at the end [m]: of a rigid body, and in the peer's motion."""
    force = np.concatenate([[0.0], loads.loads[:, :, 2].sum(axis=1)])
    mean = (force[1:] + force[:-1]) / (2.0 * body.total_mass)
    # Newmark's average acceleration: the speed gains, and the place gains half a step of it.
    speed = np.concatenate([[0.0], np.cumsum(loads.step * mean)])
    rise = float(np.sum(loads.step * (speed[1:] + speed[:-1]) / 2.0))
    last = displacement[-1].ravel()[structure.free]
    rigid = np.linalg.solve(body.rigid_mass, body.rigid_momentum.T @ last)
    return rise, float(rigid[2])


def _von_mises(structure: Structure, displacement: Array) -> Array:
    """Von Mises stress (nt, n_shells) of the worse face of every shell [Pa]."""
    recovery = build_stress_recovery(structure)
    shells = recovery.shell_operator @ displacement.T
    beams = recovery.beam_operator @ displacement.T
    return recovery.von_mises(shells, beams)[: recovery.n_shells].T


def _places(model: FiniteElementModel, loads: NodeLoads) -> dict[str, int]:
    """Node rows at the ends of the airframe and at the pin with the largest force."""
    x, y, z = model.coordinates.T
    forces = np.linalg.norm(loads.loads[:, :, :3], axis=2).max(axis=0)
    return {
        "wing tip": int(np.argmax(y)),
        "nose": int(np.argmin(x)),
        "tail": int(np.argmax(z)),
        "most loaded pin": int(loads.nodes[np.argmax(forces)]),
    }


def _at(structure: Structure, displacement: Array, row: int) -> Array:
    """Give the translation (nt, 3) of a node."""
    everywhere = structure.transformation[6 * row : 6 * row + 3] @ displacement.T
    return np.asarray(everywhere).T


def _compared(
    structure: Structure,
    ours: Array,
    theirs: Array,
    places: dict[str, int],
    stress: Array,
    peer_stress: Array,
    risen: tuple[float, float],
) -> tuple[Comparison, ...]:
    reason = (
        "same elements, loads and step; what differs is the rotary inertia of sections, and "
        "rounding, which adds up over the peer's increments, one solve to a step"
    )
    rows = [
        Comparison(
            "rise of the centre of gravity after 40 ms",
            risen[0] * 1e3,
            risen[1] * 1e3,
            1e-3,
            "mm",
            SOURCE,
            "the resultant of the pin loads on a rigid body, by the same scheme; " + reason,
        )
    ]
    for name, row in places.items():
        mine, other = _at(structure, ours, row), _at(structure, theirs, row)
        rows.append(
            Comparison(
                f"{name}, largest distance of the displacements over the largest displacement",
                float(np.linalg.norm(mine - other, axis=1).max())
                / float(np.linalg.norm(other, axis=1).max()),
                0.0,
                2e-3,
                "",
                SOURCE,
                reason,
                scale=1.0,
            )
        )
    largest = np.unravel_index(int(np.argmax(peer_stress)), peer_stress.shape)
    rows.append(
        Comparison(
            "largest von Mises stress of a shell",
            float(stress.max()) / 1e6,
            float(peer_stress[largest]) / 1e6,
            5e-3,
            "MPa",
            SOURCE,
            reason + "; stresses are means over the points of an element",
        )
    )
    peaks, peer_peaks = stress.max(axis=0), peer_stress.max(axis=0)
    high = peer_peaks > 0.2 * peer_peaks.max()
    rows.append(
        Comparison(
            f"largest difference of the peaks of {int(high.sum())} shells above 20 % of the "
            "largest",
            float(np.max(np.abs(peaks / peer_peaks - 1.0)[high])),
            0.0,
            1e-2,
            "",
            SOURCE,
            reason,
            scale=1.0,
        )
    )
    return tuple(rows)


def _plot(
    structure: Structure,
    ours: Array,
    theirs: Array,
    places: dict[str, int],
    stress: Array,
    peer_stress: Array,
) -> Plot:
    time = 1e3 * STEP * np.arange(1, len(ours) + 1, dtype=np.float64)
    panels = []
    for name, row in places.items():
        mine, other = _at(structure, ours, row)[:, 2], _at(structure, theirs, row)[:, 2]
        panels.append(
            Panel(
                "time [ms]",
                "up [mm]",
                [
                    Line(time, mine * 1e3, "solver", colour=0, width=2.4),
                    Line(time, other * 1e3, "Kratos", "dashed", colour=1),
                ],
                f"Elastic displacement, {name}",
            )
        )
    worst = int(np.argmax(peer_stress.max(axis=0)))
    panels.append(
        Panel(
            "time [ms]",
            "von Mises stress [MPa]",
            [
                Line(time, stress[:, worst] / 1e6, "solver", colour=0, width=2.4),
                Line(time, peer_stress[:, worst] / 1e6, "Kratos", "dashed", colour=1),
            ],
            "Shell of the largest stress",
        )
    )
    peaks, peer_peaks = stress.max(axis=0) / 1e6, peer_stress.max(axis=0) / 1e6
    panels.append(
        Panel(
            "Kratos [MPa]",
            "solver [MPa]",
            [Line(peer_peaks, peaks, stroke="points", colour=0)],
            "Peak von Mises stress of every shell",
            is_square=True,
        )
    )
    return line_plot(
        "peers-transient",
        "The free airframe under the pin loads of the first 40 ms of a landing at 10 ft/s: elastic "
        "displacements and stresses by the solver and, dashed, by Kratos.",
        panels,
    )
