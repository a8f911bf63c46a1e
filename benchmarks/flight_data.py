"""How well contacts and states are recovered from recordings of many synthetic landings.

``python -m benchmarks.flight_data`` flies 500 landings (``--landings N``), records each with one of
the packaged frames in turn, and compares what is recovered with the truth of the simulation.  For
each quantity it prints the root mean square error, the mean stated standard deviation and the
mean of the squared ratio of error to stated deviation, which is 1 where the deviations are honest;
beside it the sink rate from differenced radio altitude; for times also the share within 0.1 s.
"""

import argparse
import json
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from app.cli.landing_file import LandingFile
from solver.flight_data.contacts import ContactKind
from solver.flight_data.fleet import SyntheticLanding, synthetic_landing
from solver.flight_data.frame_file import packaged_frame
from solver.flight_data.geometry import Geometry, aircraft_geometry
from solver.flight_data.parameter import Parameter
from solver.flight_data.reconstruction import Reconstruction, reconstruct
from solver.landing.aircraft import Aerodynamics, LandingAircraft
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS

FRAMES = ("737-3c", "737-7", "a330", "business-jet-8", "business-jet-16")
EXAMPLE = Path(__file__).parents[1] / "examples" / "landing_level_10fps.json"

#: A bounce that is found belongs to the true one that is closer than this [s].
MATCH = 0.4

#: What a contact's time may be off by [s].
WANTED = 0.1


@dataclass(slots=True)
class Tally:
    """Errors and stated deviations of one quantity."""

    error: list[float] = field(default_factory=list)
    sd: list[float] = field(default_factory=list)

    def add(self, error: float, sd: float) -> None:
        """Count one landing."""
        self.error.append(float(error))
        self.sd.append(float(sd))

    def summary(self) -> dict[str, float]:
        """Return the figures that are printed."""
        error, sd = np.array(self.error), np.array(self.sd)
        return {
            "count": len(error),
            "rms_error": float(np.sqrt(np.mean(error**2))),
            "median_error": float(np.median(np.abs(error))),
            "bias": float(np.mean(error)),
            "share_within_0.1": float(np.mean(np.abs(error) <= WANTED)),
            "mean_sd": float(np.mean(sd)),
            "normalised_error_squared": float(np.mean((error / sd) ** 2)),
        }


@dataclass(slots=True)
class Score:
    """All tallies of one frame, or of all."""

    tallies: dict[str, Tally] = field(default_factory=dict)
    joint: list[float] = field(default_factory=list)  #: normalised error squared of the state
    landings: int = 0
    undetermined: int = 0
    late: int = 0  #: first contacts off by more than 0.1 s
    true_bounces: int = 0
    found_bounces: int = 0
    half_bounces: int = 0  #: of the others, those where only one main gear was off the ground
    false_bounces: int = 0
    called_one_gear: int = 0  #: of those not found, those reported as of one gear

    def tally(self, name: str) -> Tally:
        """Tally by name, made on first use."""
        return self.tallies.setdefault(name, Tally())

    def add(self, landing: SyntheticLanding, answer: Reconstruction, geometry: Geometry) -> None:
        """Count one landing."""
        self.landings += 1
        if not answer.contacts:
            self.undetermined += 1
            return
        first = answer.contacts[0]
        self.tally("time_s").add(first.time, first.time_sd)
        self.late += abs(first.time) > WANTED
        state, contact = first.state, landing.contact
        truths = {
            name: getattr(contact, name, contact.lift.fraction) for name in CONTACT_COMPONENTS
        }
        errors = [getattr(state, name).value - truths[name] for name in CONTACT_COMPONENTS]
        for name, error in zip(CONTACT_COMPONENTS, errors, strict=True):
            self.tally(name).add(error, getattr(state, name).sd)
        self.joint.append(
            float(errors @ np.linalg.solve(state.covariance, errors)) / len(CONTACT_COMPONENTS)
        )
        for wheel in geometry.wheels:
            true = landing.gear_sink_rate(wheel.position)
            estimate = state.gear_sink_rates[wheel.gear]
            self.tally(f"sink_rate_{wheel.gear}").add(estimate.value - true, estimate.sd)
            if wheel in geometry.mains:
                for name, value in differenced(landing).items():
                    self.tally(name).add(value - true, 1.0)
        self._later(landing, answer, geometry)

    def _later(self, landing: SyntheticLanding, answer: Reconstruction, geometry: Geometry) -> None:
        ours = [c for c in answer.contacts if c.kind is ContactKind.BOUNCE]
        single = [c.time for c in answer.contacts if c.kind is ContactKind.ONE_GEAR]
        used: set[int] = set()
        for time in landing.main_contacts(geometry)[1:]:
            self.true_bounces += 1
            near = [(abs(c.time - time), i) for i, c in enumerate(ours) if i not in used]
            distance, index = min(near, default=(np.inf, -1))
            if distance < MATCH:
                used.add(index)
                self.found_bounces += 1
                self.tally("bounce_time_s").add(ours[index].time - time, ours[index].time_sd)
            else:
                self.called_one_gear += any(abs(other - time) < MATCH for other in single)
        again = landing.main_gears_again(geometry)
        for index, contact in enumerate(ours):
            if index not in used:
                is_half = any(abs(contact.time - time) < MATCH for time in again)
                self.half_bounces += is_half
                self.false_bounces += not is_half
        nose = [c for c in answer.contacts if c.kind is ContactKind.DEROTATION]
        true_nose = landing.nose_contact(geometry)
        if nose and true_nose is not None:
            self.tally("nose_time_s").add(nose[0].time - true_nose, nose[0].time_sd)

    def summary(self) -> dict[str, object]:
        """Return everything as plain values."""
        return {
            "landings": self.landings,
            "undetermined": self.undetermined,
            "first_contact_off_by_more_than_0.1_s": self.late,
            "bounces": self.true_bounces,
            "bounces_found": self.found_bounces,
            "bounces_reported_as_of_one_gear": self.called_one_gear,
            "bounces_of_one_gear_only": self.half_bounces,
            "bounces_false": self.false_bounces,
            "normalised_error_squared_of_the_state": float(np.mean(self.joint)),
            "quantities": {name: tally.summary() for name, tally in self.tallies.items()},
        }


def differenced(landing: SyntheticLanding) -> dict[str, float]:
    """Sink rate from radio altitude: last second's difference, and a line over three seconds."""
    samples = np.array(
        sorted(
            (t, v)
            for channel in landing.window.of(Parameter.RADIO_ALTITUDE)
            for t, v in zip(channel.time, channel.value, strict=True)
            if t <= 0.0
        )
    )
    last = samples[-1]
    before = samples[samples[:, 0] <= last[0] - 0.95][-1]
    line = samples[samples[:, 0] > -3.0]
    if len(line) < 3:
        line = samples[-3:]
    return {
        "radio_altitude_difference": float((before[1] - last[1]) / (last[0] - before[0])),
        "radio_altitude_line_3_s": float(-np.polyfit(line[:, 0], line[:, 1], 1)[0]),
    }


def example_aircraft() -> LandingAircraft:
    """Return the aircraft of the example file, with the usual damping of a business jet."""
    description = LandingFile.model_validate_json(EXAMPLE.read_bytes()).aircraft_description
    assert description is not None
    aerodynamics = Aerodynamics.from_coefficients(
        area=47.9,
        span=19.3,
        chord=2.674,
        drag_coefficient=0.12,
        roll_damping_derivative=-0.45,
        pitch_damping_derivative=-18.0,
        yaw_damping_derivative=-0.12,
    )
    return replace(description.aircraft(), aerodynamics=aerodynamics)


def show(name: str, score: Score) -> None:
    """Print one table."""
    print(
        f"\n{name}: {score.landings} landings, {score.undetermined} undetermined, "
        f"{score.late} first contacts off by more than 0.1 s; bounces: {score.found_bounces} of "
        f"{score.true_bounces} found, {score.called_one_gear} more reported as of one gear, "
        f"{score.half_bounces} reported where one gear stayed down, {score.false_bounces} where "
        "both did; "
        f"state's normalised error squared {np.mean(score.joint):.2f}"
    )
    print(
        f"{'':28s}{'rms':>9s}{'median':>9s}{'bias':>9s}{'sd':>9s}{'(e/sd)^2':>9s}{'<= 0.1 s':>9s}"
    )
    for label, tally in score.tallies.items():
        s = tally.summary()
        honest = "" if label.startswith("radio") else f"{s['normalised_error_squared']:9.2f}"
        sd = "" if label.startswith("radio") else f"{s['mean_sd']:9.4f}"
        within = f"{s['share_within_0.1']:9.3f}" if "time" in label else ""
        print(
            f"{label:28s}{s['rms_error']:9.4f}{s['median_error']:9.4f}{s['bias']:9.4f}"
            f"{sd}{honest}{within}"
        )


def main() -> None:
    """Fly the fleet and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--landings", type=int, default=500)
    parser.add_argument("--first-seed", type=int, default=10_000)
    parser.add_argument("--json", type=Path, help="write the figures here")
    given = parser.parse_args()
    aircraft = example_aircraft()
    geometry = aircraft_geometry(aircraft)
    scores = {name: Score() for name in ("all", *FRAMES)}
    for number in range(given.landings):
        frame = FRAMES[number % len(FRAMES)]
        landing = synthetic_landing(
            aircraft, geometry, packaged_frame(frame), given.first_seed + number
        )
        answer = reconstruct(landing.window, geometry)
        for name in ("all", frame):
            scores[name].add(landing, answer, geometry)
    for name, score in scores.items():
        show(name, score)
    if given.json is not None:
        document = {name: score.summary() for name, score in scores.items()}
        given.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
