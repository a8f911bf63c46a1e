"""Error over the time step: full-order Newmark, and the reduced recursion with its sweeps."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from solver.arrays import Array
from solver.inertia_relief.basis import BasisSettings
from solver.inertia_relief.damping import RayleighDamping
from solver.inertia_relief.full_order import BodyLoads
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import LandingLoads
from solver.inertia_relief.motion import RigidMotion
from solver.inertia_relief.reduced import ReducedModel
from solver.inertia_relief.response import landing_response
from verification.inertia_relief.free_beam import history
from verification.inertia_relief.winged_body import (
    WingedBody,
    balanced_landing,
    full_order_peaks,
    reduced,
    reduced_peaks,
    turned_landing,
    winged_body,
)

DAMPING = RayleighDamping(0.02, 3.0, 40.0)
FACTORS = np.array([0.85, 0.3])
SEED = 11
#: Sweeps of the W terms until what they change is below the errors to be seen.
SWEEPS = 1e-8


@dataclass(frozen=True, slots=True)
class StepError:
    """Error of a history over the time step."""

    steps: Array  #: (k,) [s]
    errors: Array  #: (k,) largest difference from the finest, relative to the largest value

    @property
    def order(self) -> float:
        """Slope in logarithmic axes."""
        return float(np.polyfit(np.log(self.steps), np.log(self.errors), 1)[0])


def sampled(loads: LandingLoads, every: int) -> LandingLoads:
    """Return every so manieth sample of a landing; each sample stays balanced."""
    motion = loads.motion
    return LandingLoads(
        loads.time[::every],
        loads.pin_loads[::every],
        loads.air_loads[::every],
        RigidMotion(
            motion.origin,
            motion.acceleration[::every],
            motion.gravity[::every],
            motion.rate[::every],
            motion.rate_derivative[::every],
        ),
    )


def newmark_error(levels: int = 5, duration: float = 0.2) -> StepError:
    """Full-order integration of a winged body's landing, all W terms, against finer steps."""
    winged = winged_body(6, 8)
    loads = balanced_landing(winged, FACTORS, SEED, duration, step=2e-3)
    body = winged.body(FACTORS)
    body_loads = BodyLoads(loads.time, winged.applied, loads.applied_amplitudes(), loads.motion)
    substeps = 2 ** np.arange(levels + 2)
    histories = [history(body, body_loads, DAMPING, int(count)) for count in substeps]
    # of second order, two solutions give a third that both are compared with
    exact = histories[-1] + (histories[-1] - histories[-2]) / 3
    scale = np.abs(exact).max()
    errors = [float(np.abs(found - exact).max() / scale) for found in histories[:levels]]
    steps = 2e-3 / substeps[:levels].astype(np.float64)
    return StepError(steps, np.array(errors))


def recursion_error(
    winged: WingedBody, model: ReducedModel, levels: int = 5, duration: float = 0.4
) -> StepError:
    """Reduced recursion of the same landing on coarser samples of its loads."""
    finest = 1.25e-4
    loads = balanced_landing(winged, FACTORS, SEED, duration, step=finest)
    loading = assemble(model, FACTORS)
    exact = landing_response(loading, loads, SWEEPS).coordinates
    scale = np.abs(exact).max()
    every = 2 ** np.arange(3, levels + 3)
    errors = []
    for count in every.tolist():
        coarse = landing_response(loading, sampled(loads, count), SWEEPS).coordinates
        errors.append(float(np.abs(coarse - exact[:, ::count]).max() / scale))
    return StepError(finest * every.astype(np.float64), np.array(errors))


def linear_load_change(winged: WingedBody, model: ReducedModel, parts: int = 8) -> float:
    """Change of the recursion by a finer grid under the same loads, linear between coarse samples.

    A lift through the centre of gravity that rises and falls; nothing turns, hence no W terms.
    """
    time = 4e-3 * np.arange(101, dtype=np.float64)
    properties = winged.inertia(FACTORS).rigid_body_properties()
    amplitude = np.random.default_rng(SEED).standard_normal(len(time)).cumsum() * properties.mass
    fine = np.linspace(time[0], time[-1], parts * (len(time) - 1) + 1)
    found = []
    for grid in (time, fine):
        lift = np.zeros((len(grid), 6))
        lift[:, 2] = np.interp(grid, time, amplitude)
        lift[:, 3:] = np.cross(properties.centre_of_gravity, lift[:, :3])
        zero = np.zeros((len(grid), 3))
        motion = RigidMotion(
            properties.centre_of_gravity, lift[:, :3] / properties.mass, zero, zero, zero
        )
        pins = np.zeros((len(grid), winged.pins.shape[1]))
        loads = LandingLoads(grid, pins, lift, motion)
        found.append(landing_response(assemble(model, FACTORS), loads).coordinates)
    return float(np.abs(found[1][:, ::parts] - found[0]).max() / np.abs(found[0]).max())


@dataclass(frozen=True, slots=True)
class FrameChoice:
    """Largest change of an element's peak by another description, relative to the peak."""

    full_order: float  #: of any element
    reduced: float  #: of elements above 20 % of the global peak


def frame_choice(seeds: tuple[int, ...] = (3, 8), modes: int = 30) -> list[FrameChoice]:
    """Describe a winged body and its landing in turned axes from another origin."""
    straight = winged_body(6, 8)
    settings = BasisSettings(modes=modes)
    found = []
    for seed in seeds:
        turn = Rotation.random(rng=np.random.default_rng(seed)).as_matrix()
        shift = np.array([30.0, -4.0, 9.0])
        turned = winged_body(6, 8, turn, shift)
        loads = balanced_landing(straight, FACTORS, seed, duration=0.1)
        other = turned_landing(loads, turn, shift)
        whole = [
            full_order_peaks(body, FACTORS, part, DAMPING).stress
            for body, part in ((straight, loads), (turned, other))
        ]
        small = [
            reduced_peaks(reduced(body, settings, DAMPING), FACTORS, part).stress
            for body, part in ((straight, loads), (turned, other))
        ]
        stressed = whole[0] > 0.2 * whole[0].max()
        found.append(
            FrameChoice(
                float(np.abs(whole[1] / whole[0] - 1).max()),
                float(np.abs(small[1] / small[0] - 1)[stressed].max()),
            )
        )
    return found
