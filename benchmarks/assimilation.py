"""How much recorded responses improve the state of a contact, and which defects they give away.

``python -m benchmarks.assimilation`` flies synthetic landings whose aircraft differs from the
nominal one by the scatter of service, records each with one of the packaged frames in turn, and
compares the state at the first contact, and at each bounce, before and after its response is
looked at with the truth.
For each frame it prints the errors of the sink rate and the normalised error squared of the whole
state, then how the misfit of good recordings is distributed, and how often stated defects are
found.  ``--figure`` draws one response and the misfits.
"""

import argparse
import json
from dataclasses import dataclass, field, replace
from pathlib import Path
from time import process_time

import numpy as np

from benchmarks.flight_data import FRAMES, example_aircraft
from solver.arrays import Array
from solver.assimilation.assimilate import ContactUpdate, assimilate
from solver.assimilation.parameters import GAS_PRESSURE, contact_values
from solver.assimilation.scattered_landing import scattered_landing
from solver.flight_data.frame_file import packaged_frame
from solver.flight_data.geometry import aircraft_geometry
from solver.flight_data.parameter import Parameter
from solver.flight_data.reconstruction import Reconstruction, reconstruct
from solver.flight_data.window import Window
from solver.landing.contact_uncertainty import CONTACT_COMPONENTS
from solver.landing.excerpt import contact_during

AIRCRAFT = example_aircraft()
GEOMETRY = aircraft_geometry(AIRCRAFT)

#: A contact found so far from the true one is another one [s].
LATE = 0.1

#: A bounce is that of the simulation that is so near to it [s].
MATCH = 0.4

#: Sink rate from which a defect is worth finding [m/s].
FIRM = 1.5


@dataclass(frozen=True, slots=True)
class Defect:
    """Something wrong that the estimator does not know of."""

    name: str
    changes: dict[str, float] = field(default_factory=dict)  #: of the aircraft
    gain: float = 1.0  #: of the normal acceleration about one g
    later: float = 0.0  #: contact found so much later than it was [s]


DEFECTS = (
    Defect("one strut at 30 % gas pressure", {GAS_PRESSURE + "left": float(np.log(0.3))}),
    Defect(
        "both main struts at 30 % gas pressure",
        {GAS_PRESSURE + gear: float(np.log(0.3)) for gear in ("left", "right")},
    ),
    Defect("normal acceleration 20 % too large", gain=1.2),
    Defect("aircraft 20 % heavier than recorded", {"mass": float(np.log(1.2))}),
    Defect("aircraft 20 % lighter than recorded", {"mass": float(np.log(0.8))}),
    Defect("contact found 0.5 s late", later=0.5),
    Defect("contact found 0.5 s early", later=-0.5),
)


@dataclass(frozen=True, slots=True)
class Flown:
    """One contact, and what became of it."""

    frame: str
    truth: Array  #: (9,) state at the contact
    true_time: float  #: [s]
    update: ContactUpdate
    seconds: float = 0.0  #: processor time of the assimilation of the whole landing

    @property
    def is_late(self) -> bool:
        """Whether it was found so far from where it was that it is another one."""
        return abs(self.update.found.time - self.true_time) >= LATE

    @property
    def errors(self) -> tuple[Array, Array]:
        """Of the state before and after, (9,) each."""
        before, after = (contact_values(c) for c in (self.update.prior, self.update.contact))
        return before - self.truth, after - self.truth

    @property
    def normalised(self) -> tuple[float, float]:
        """Squared errors over covariance and number of components."""
        covariances = self.update.prior_uncertainty.matrix, self.update.uncertainty.matrix
        before, after = (
            float(error @ np.linalg.solve(covariance, error)) / len(error)
            for error, covariance in zip(self.errors, covariances, strict=True)
        )
        return before, after


def fly(number: int, seed: int, defect: Defect, least_sink_rate: float = 0.0) -> list[Flown]:
    """Fly one landing: its first contact, then its bounces; nothing if the window cannot tell.

    Left out are contacts of which nothing could be compared, and bounces that were none.
    """
    frame = FRAMES[number % len(FRAMES)]
    scattered = scattered_landing(
        AIRCRAFT, GEOMETRY, packaged_frame(frame), seed + number, defects=defect.changes
    )
    landing = scattered.landing
    if landing.contact.sink_rate < least_sink_rate:
        return []
    window = amplified(landing.window, defect.gain)
    found = reconstruct(window, GEOMETRY)
    if not found.contacts:
        return []
    begun = process_time()
    if defect.later:
        found = misplaced(found, defect.later)
    first, *later = assimilate(window, found, AIRCRAFT, GEOMETRY).updates
    seconds = process_time() - begun
    if first.misfit is None:
        return []
    flown = [Flown(frame, contact_values(landing.contact), 0.0, first, seconds)]
    for update in later:
        times = np.array(landing.main_contacts(GEOMETRY)[1:])
        apart = np.abs(times - update.found.time)
        if update.misfit is None or not np.any(apart < MATCH):
            continue
        time = float(times[np.argmin(apart)])
        history, sample = landing.history, int(np.searchsorted(landing.history.time, time))
        true = contact_during(scattered.aircraft, history, sample, landing.contact.lift)
        flown.append(Flown(frame, contact_values(true), time, update))
    return flown


def amplified(window: Window, gain: float) -> Window:
    """Window whose normal acceleration has a wrong gain."""
    return replace(
        window,
        channels=tuple(
            replace(channel, value=1.0 + gain * (channel.value - 1.0))
            if channel.parameter is Parameter.NORMAL_ACCELERATION
            else channel
            for channel in window.channels
        ),
    )


def misplaced(found: Reconstruction, later: float) -> Reconstruction:
    """First contact alone, at another time [s]."""
    first = found.contacts[0]
    return replace(found, contacts=(replace(first, time=first.time + later),))


def root_mean_square(values: list[float]) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(np.square(values)))) if values else float("nan")


def sink_table(flown: list[Flown]) -> list[dict[str, float | str]]:
    """Sink rate and whole state before and after, for all frames and each."""
    rows: list[dict[str, float | str]] = []
    for name in ("all", *FRAMES):
        those = [each for each in flown if name in ("all", each.frame) and each.update.is_corrected]
        if not those:
            continue
        sink = [[float(e[0]) for e in each.errors] for each in those]
        rows.append(
            {
                "frame": name,
                "landings": len(those),
                "sink_rms_before": root_mean_square([s[0] for s in sink]),
                "sink_rms_after": root_mean_square([s[1] for s in sink]),
                "squared_before": float(np.mean([each.normalised[0] for each in those])),
                "squared_after": float(np.mean([each.normalised[1] for each in those])),
            }
        )
    return rows


def component_table(flown: list[Flown]) -> list[dict[str, float | str]]:
    """Error, deviation and normalised error squared of each component, before and after."""
    those = [each for each in flown if each.update.is_corrected]
    rows: list[dict[str, float | str]] = []
    for index, name in enumerate(CONTACT_COMPONENTS):
        row: dict[str, float | str] = {"component": name}
        for label, which in (("before", 0), ("after", 1)):
            errors = np.array([each.errors[which][index] for each in those])
            known = [
                each.update.uncertainty if which else each.update.prior_uncertainty
                for each in those
            ]
            sds = np.array([np.sqrt(each.matrix[index, index]) for each in known])
            row[f"rms_{label}"] = float(np.sqrt(np.mean(errors**2)))
            row[f"sd_{label}"] = float(np.mean(sds))
            row[f"squared_{label}"] = float(np.mean((errors / sds) ** 2))
        rows.append(row)
    return rows


def misfits(flown: list[Flown]) -> dict[str, float]:
    """How the misfit of good recordings is distributed."""
    found = [each.update.misfit for each in flown if each.update.misfit is not None]
    ratio = [m.chi_square / m.measurements for m in found]
    probability = np.array([m.probability for m in found])
    pulls = np.array([abs(m.strongest.pull) for m in found])
    return {
        "recordings": len(found),
        "mean_chi_square_over_samples": float(np.mean(ratio)),
        "share_below_0.05": float(np.mean(probability < 0.05)),
        "share_below_0.01": float(np.mean(probability < 0.01)),
        "least_probability": float(probability.min()),
        "largest_pull": float(pulls.max()),
        "median_largest_pull": float(np.median(pulls)),
        "unexplained": sum(not m.is_explained for m in found),
        "unexplained_though_found_within_0.1_s": sum(
            not each.update.misfit.is_explained and not each.is_late
            for each in flown
            if each.update.misfit is not None
        ),
        "contacts_off_by_more_than_0.1_s": sum(each.is_late for each in flown),
    }


def defect_row(defect: Defect, count: int, seed: int) -> dict[str, float | str]:
    """How often a defect is found, in all landings and in firm ones."""
    flown = [each[0] for k in range(count) if (each := fly(k, seed, defect))]
    firm = [each for each in flown if each.truth[0] > FIRM]

    def share(those: list[Flown]) -> float:
        return float(np.mean([bool(each.update.unchanged_because) for each in those]))

    return {
        "defect": defect.name,
        "landings": len(flown),
        "found": share(flown),
        "firm": len(firm),
        "found_firm": share(firm) if firm else float("nan"),
    }


def draw(path: Path, flown: list[Flown]) -> None:
    """Draw the misfits of all, and recorded against simulated peaks before and after."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    found = [each.update.misfit for each in flown if each.update.misfit is not None]
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.8), layout="constrained")
    recorded = [m.peak.recorded for m in found]
    ends = (1.0, max(recorded) + 0.1)
    left.plot(ends, ends, color="0.7", linewidth=1.0)
    left.plot(recorded, [m.peak.prior for m in found], "o", mfc="none", label="before the update")
    left.plot(recorded, [m.peak.posterior for m in found], ".", label="after it")
    left.set_xlabel("recorded peak normal acceleration [g]")
    left.set_ylabel("simulated, sampled as recorded [g]")
    left.legend(frameon=False)
    uniform = (np.arange(len(found)) + 0.5) / len(found)
    right.plot(uniform, uniform, color="0.7", linewidth=1.0)
    right.plot(uniform, np.sort([m.probability for m in found]), drawstyle="steps-mid")
    right.set_xlabel("share of good recordings")
    right.set_ylabel("probability of a misfit as large")
    figure.savefig(path)


def show(title: str, rows: list[dict[str, float | str]]) -> None:
    """Print a table."""
    print(f"\n{title}")
    if not rows:
        print("none")
        return
    widths = {key: max(len(key), 12) + 2 for key in rows[0]}
    first = next(iter(widths))
    widths[first] = max(len(str(row[first])) for row in rows) + 2
    print("".join(f"{key:>{width}s}" for key, width in widths.items()))
    for row in rows:
        cells = {key: v if isinstance(v, str) else f"{v:.3g}" for key, v in row.items()}
        print("".join(f"{cells[key]:>{width}s}" for key, width in widths.items()))


def show_good(
    count: int, seed: int, least_sink_rate: float, figure: Path | None
) -> dict[str, object]:
    """Fly landings without a defect and print what became of them."""
    good = Defect("none")
    landings = [each for k in range(count) if (each := fly(k, seed, good, least_sink_rate))]
    flown = [first for first, *_ in landings]
    bounces = [bounce for _, *later in landings for bounce in later]
    document: dict[str, object] = {
        "sink_rate": (sink := sink_table(flown)),
        "components": (components := component_table(flown)),
        "misfit": (misfit := misfits(flown)),
        "bounces": (bounced := component_table(bounces)),
        "misfit_of_bounces": (bounce_misfit := misfits(bounces)),
        "seconds": float(np.mean([each.seconds for each in flown])),
    }
    show("sink rate [m/s] and normalised error squared of the state", sink)
    show("components, SI", components)
    print("\nmisfit of good recordings:", {k: round(v, 4) for k, v in misfit.items()})
    show("bounces: components, SI", bounced)
    print("\nmisfit of bounces:", {k: round(v, 4) for k, v in bounce_misfit.items()})
    print(f"processor time {document['seconds']:.2f} s a landing")
    if figure is not None:
        draw(figure, flown)
    return document


def main() -> None:
    """Fly and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--landings", type=int, default=200)
    parser.add_argument("--defects", type=int, default=20, help="landings for each defect")
    parser.add_argument("--first-seed", type=int, default=60_000)
    parser.add_argument(
        "--least-sink-rate", type=float, default=0.0, help="leave softer landings out [m/s]"
    )
    parser.add_argument("--json", type=Path, help="write the figures here")
    parser.add_argument("--figure", type=Path, help="draw peaks and misfits (SVG or PNG)")
    given = parser.parse_args()
    document: dict[str, object] = {}
    if given.landings:
        document |= show_good(given.landings, given.first_seed, given.least_sink_rate, given.figure)
    if given.defects:
        rows = [defect_row(defect, given.defects, given.first_seed + 5_000) for defect in DEFECTS]
        show(f"defects; firm means above {FIRM} m/s", rows)
        document["defects"] = rows
    if given.json is not None:
        given.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
