"""Geometrically nonlinear dynamics of a whole airframe in a landing: the reference analysis.

The airframe is free.  It starts with the rigid motion of the landing simulation, in the steady
shape that belongs to it, and moves under gravity, air loads and the pin loads of the gears, all as
the landing simulation found them; nothing of its motion is prescribed.  Model, mass, damping and
time integration are those of `solver.inertia_relief.full_order` as long as rotations are small, so
that a difference between both is geometric nonlinearity, or what loads of a rigid aircraft do to a
flexible one.
"""

import hashlib
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from solver.arrays import Array
from solver.inertia_relief.build import airframe_damping
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.loads import landing_loads
from solver.nonlinear.checkpoint import Checkpoint
from solver.nonlinear.correction import Corrector
from solver.nonlinear.integrate import TOLERANCE, integrate_nonlinear
from solver.nonlinear.loads import DirectedLoads, directed_landing_loads
from solver.nonlinear.midpoint import motion_of
from solver.nonlinear.recorder import NonlinearLanding, StressRecorder
from solver.nonlinear.steady import steady_pose
from solver.nonlinear.structure import loaded_model, nonlinear_structure
from solver.progress import Progress, silent

if TYPE_CHECKING:
    from solver.aircraft.airframe import Airframe
    from solver.landing.history import LandingHistory


def nonlinear_landing(
    airframe: "Airframe",
    factors: Array,
    history: "LandingHistory",
    *,
    duration: float | None = None,
    substeps: int = 2,
    stress_times: Sequence[float] = (),
    damping: RayleighDamping | None = None,
    tolerance: float = TOLERANCE,
    checkpoint: Path | None = None,
    progress: Progress = silent,
) -> NonlinearLanding:
    """Integrate the free airframe through a simulated landing, geometry fully nonlinear.

    Parameters
    ----------
    factors : (n_groups,) array
        Fill of tanks and bays, those that the landing was simulated with.
    history : LandingHistory
        Of `solver.landing.simulate.simulate_landing`; its time grid gives the samples.
    duration : float, optional
        How much of the landing [s]; all of it by default.
    substeps : int
        Time steps between two samples.
    stress_times : sequence of float
        Times at which stresses of all elements and positions of all nodes are kept; the nearest
        samples are taken [s].
    damping : RayleighDamping, optional
        That of the aircraft definition by default, as in extended inertia relief.
    tolerance : float
        Of Newton's iteration in every step; see `solver.nonlinear.integrate.TOLERANCE`.
    checkpoint : Path, optional
        File in which an interrupted run is kept; the same call takes it up again.  It is ignored
        if anything that the run rests on has changed, and deleted at the end.

    Raises
    ------
    ModelError
        The landing is not one of this airframe.
    SimulationDivergedError
        Steady shape or a step are not found.

    Notes
    -----
    A step of 0.5 ms of the full-size example takes two to four evaluations of its equations, 60 to
    100 ms on one core; nothing is damped but by the named law, and the error of time integration
    is that of `solver.inertia_relief.full_order` with the same step.
    """
    loads = landing_loads(airframe, history)
    loads = loads if duration is None else loads.until(duration)
    directed = directed_landing_loads(airframe, history, loads)
    damping = airframe_damping(airframe) if damping is None else damping
    wanted = np.array([np.abs(loads.time - time).argmin() for time in stress_times], dtype=np.int64)
    step = float(loads.time[1] - loads.time[0]) / substeps

    progress("nonlinear model", 0.0)
    structure = nonlinear_structure(loaded_model(airframe, factors))
    body = free_body(airframe.structure, airframe.inertia(factors))
    rate = loads.motion.rate[0]
    pose = steady_pose(structure, body, directed.at(float(loads.time[0])), directed.gravity, rate)
    start = motion_of(structure, pose, np.cross(body.centre_of_gravity, rate), rate)
    corrector = Corrector(structure, body.mass, step, damping)
    record = StressRecorder(structure, airframe.recovery, len(loads.time), wanted)
    kept = None
    if checkpoint is not None:
        settings = (step, tolerance, damping, wanted.tolist())
        kept = Checkpoint(checkpoint, _run_key(airframe, factors, directed, settings))
    report = integrate_nonlinear(
        structure,
        start,
        directed,
        damping,
        corrector,
        step,
        substeps * (len(loads.time) - 1),
        record,
        every=substeps,
        tolerance=tolerance,
        checkpoint=kept,
        progress=progress,
    )
    return record.result(loads.time, report)


def _run_key(
    airframe: "Airframe", factors: Array, loads: DirectedLoads, settings: tuple[object, ...]
) -> str:
    """Digest of all that a run rests on: aircraft, loads, settings, the solver's own text."""
    digest = hashlib.sha256(f"{airframe.content_hash} {settings}".encode())
    for array in (factors, loads.time, loads.amplitudes, loads.attitude, loads.gravity):
        digest.update(np.ascontiguousarray(array).tobytes())
    here = Path(__file__).parent
    for source in sorted([*here.glob("*.py"), *(here.parent / "fe").glob("*.py")]):
        digest.update(source.read_bytes())
    return digest.hexdigest()
