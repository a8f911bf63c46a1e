"""What two-way coupling changes in the airframe's stress: the same analysis, two sets of loads."""

from dataclasses import dataclass

import numpy as np

from solver.arrays import Array
from solver.flexible_landing.loads import flexible_landing_loads
from solver.frames import BODY_STRUCTURAL
from solver.gear.pins import pin_load_matrix
from solver.inertia_relief.loads import landing_loads
from solver.inertia_relief.peaks import StressPeaks, find_peaks
from solver.inertia_relief.response import ReducedResponse, landing_response
from verification.chapter import Plot, Table
from verification.comparison import Comparison
from verification.flexible_airframe.study import FULL, Landed, Models
from verification.plots import Line, Panel, line_plot
from verification.run import Run

#: Elements above this share of the largest peak are looked at.
STRESSED = 0.2


@dataclass(frozen=True, slots=True)
class BothPeaks:
    """Peaks of all elements from the loads of the rigid and of the flexible landing."""

    landed: Landed
    one_way: StressPeaks
    two_way: StressPeaks
    response: ReducedResponse  #: to the loads of the flexible landing

    @property
    def stressed(self) -> Array:
        """Elements above the share of the largest one-way peak, as a mask."""
        return np.asarray(self.one_way.stress > STRESSED * self.one_way.stress.max())

    @property
    def changes(self) -> Array:
        """Relative change of those elements' peaks by two-way coupling."""
        chosen = self.stressed
        return np.asarray(self.two_way.stress[chosen] / self.one_way.stress[chosen] - 1)


def both_peaks(run: Run, models: Models, landed: Landed) -> BothPeaks:
    """Search the peaks under both sets of loads."""
    one = landing_response(models.loading, landing_loads(run.airframe, landed.rigid))
    loads = flexible_landing_loads(run.airframe, models.aircraft, landed.full.history)
    two = landing_response(models.loading, loads)
    return BothPeaks(landed, find_peaks(run.reduced, one), find_peaks(run.reduced, two), two)


def fitting_motion_errors(models: Models, peaks: BothPeaks) -> list[tuple[str, float, float]]:
    """Largest displacement of each fitting [m]: in the flexible landing, and its difference.

    The difference is that of the motion which extended inertia relief finds for the loads of the
    flexible landing from the elastic motion in that landing itself.
    """
    loading = models.loading
    pins = np.asarray(loading.model.applied.T @ loading.modes_with_rigid)
    modal = loading.modes.T @ peaks.response.coordinates
    rows, first = [], 0
    for index, gear in enumerate(models.aircraft.gears):
        last = first + 6 * len(gear.pins)
        shape = pin_load_matrix(gear.pins, gear.pivot).T @ pins[first:last]
        first = last
        found = BODY_STRUCTURAL[:, None] * (shape @ modal)[:3]
        expected = models.full.fittings[index, :3] @ peaks.landed.full.coordinates
        largest = np.linalg.norm(expected, axis=0).max()
        rows.append(
            (gear.name, float(largest), float(np.linalg.norm(found - expected, axis=0).max()))
        )
    return rows


def stress_table(run: Run, all_peaks: list[BothPeaks]) -> Table:
    """Largest stress, largest utilisation and the change of the stressed elements."""
    airframe = run.airframe
    identifiers = airframe.structure.model.element_identifiers
    rows = []
    for peaks in all_peaks:
        one, two = peaks.one_way.stress, peaks.two_way.stress
        used = one / airframe.allowables, two / airframe.allowables
        zones = [
            airframe.definition.zones[airframe.element_zone[int(np.argmax(use))]].name
            for use in used
        ]
        changes = 100 * peaks.changes
        rows.append(
            (
                peaks.landed.approach.title,
                f"{one.max() / 1e6:.1f} ({identifiers[int(np.argmax(one))]})",
                f"{two.max() / 1e6:.1f} ({identifiers[int(np.argmax(two))]})",
                f"{used[0].max():.3f} ({zones[0]})",
                f"{used[1].max():.3f} ({zones[1]})",
                str(len(changes)),
                f"{np.median(changes):+.1f}",
                f"{np.quantile(changes, 0.05):+.1f} to {np.quantile(changes, 0.95):+.1f}",
                f"{changes.min():+.1f} to {changes.max():+.1f}",
            )
        )
    return Table(
        "Peak von Mises stress from the loads of the rigid landing (one-way) and of the flexible "
        "one (two-way)",
        (
            "approach",
            "one-way: largest [MPa] (element)",
            "two-way",
            "one-way: largest share of its allowable (where)",
            "two-way",
            "elements above 20 %",
            "their change: median [%]",
            "5th to 95th percentile [%]",
            "smallest to largest [%]",
        ),
        tuple(rows),
        "Changes are those of each element's own peak, whenever it occurs, by two-way coupling.",
    )


def stress_plot(all_peaks: list[BothPeaks]) -> Plot:
    """Peak of every element, two-way against one-way."""
    panels = []
    for peaks in all_peaks:
        top = float(peaks.one_way.stress.max()) / 1e6
        one, two = peaks.one_way.stress / 1e6, peaks.two_way.stress / 1e6
        panels.append(
            Panel(
                "one-way [MPa]",
                "two-way [MPa]",
                [
                    Line(np.array([0.0, top]), np.array([0.0, top]), width=0.6, colour=4),
                    Line(one, two, stroke="points", colour=0),
                ],
                peaks.landed.approach.title,
            )
        )
    return line_plot(
        "flexible-stress",
        "Peak von Mises stress of every element: loads of the landing with the flexible airframe "
        f"({FULL}) against those with the rigid one; the line is equality.",
        panels,
        height=2.4,
    )


def stress_comparisons(run: Run, all_peaks: list[BothPeaks]) -> list[Comparison]:
    """Compare the two figures that a verdict rests on."""
    rows = []
    for peaks in all_peaks:
        title = peaks.landed.approach.title
        for name, scale, unit, bound in (
            ("largest peak", 1.0, "Pa", 0.15),
            ("largest share of an allowable", run.airframe.allowables, "", 0.35),
        ):
            rows.append(
                Comparison(
                    f"{title}: {name}, one-way",
                    float((peaks.one_way.stress / scale).max()),
                    float((peaks.two_way.stress / scale).max()),
                    bound,
                    unit,
                    "loads of the landing with the flexible airframe",
                    "no requirement but the error that one-way coupling is known to make, rounded "
                    "up: legs on a flexible airframe swing slower, so that what rings near the "
                    "spring-back frequency, such as floor beams, rings otherwise",
                )
            )
    return rows


def consistency_comparisons(models: Models, peaks: BothPeaks) -> list[Comparison]:
    """Inertia relief under the flexible landing's loads moves the fittings as that landing did."""
    return [
        Comparison(
            f"{peaks.landed.approach.title}: motion of the {name} fitting by inertia relief, "
            "largest difference",
            difference,
            0.0,
            0.02 * largest,
            "m",
            f"elastic motion in the flexible landing itself, up to {1e3 * largest:.1f} mm",
            "inertia relief acts on undeformed arms and on loads linear between samples, a "
            "hundredth or so of the motion",
            scale=1.0,
        )
        for name, largest, difference in fitting_motion_errors(models, peaks)
    ]
