"""Reduced against full-order extended inertia relief: every element's peak in whole landings.

Both integrate the same loads of landings at loadings outside the basis.  The full-order peaks are
stored, as they take minutes for each landing.
"""

from dataclasses import dataclass
from time import process_time

import numpy as np

from solver.arrays import Array
from solver.inertia_relief.accumulate import PeakAccumulator
from solver.inertia_relief.build import airframe_damping
from solver.inertia_relief.free_body import free_body
from solver.inertia_relief.full_order import BodyLoads, integrate_full_order
from solver.inertia_relief.loading import assemble
from solver.inertia_relief.loads import LandingLoads, applied_shapes
from solver.inertia_relief.peaks import find_peaks
from solver.inertia_relief.response import landing_response
from verification.cases import CASES, Case
from verification.chapter import Chapter, Comparisons, Plot, Table, Text
from verification.comparison import Comparison
from verification.inertia_relief.drawn_landings import (
    FULL_ORDER_SOURCES,
    DrawnLanding,
    drawn_landings,
)
from verification.plots import Line, Panel, line_plot
from verification.run import Run

#: Elements whose peak exceeds this share of the largest one must agree.
STRESSED = 0.2
#: Largest admissible difference of their peaks.
TOLERANCE = 0.01
#: The same for whole landings drawn at random: share of the largest peak, and difference.
DRAWN_STRESSED, DRAWN_TOLERANCE = 0.1, 0.005


@dataclass(frozen=True, slots=True)
class LandingPeaks:
    """Peaks of one landing by both ways."""

    case: Case
    duration: float  #: [s]
    full: Array  #: (ne,) full order [Pa]
    full_seconds: float  #: processor time
    fast: Array  #: (ne,) reduced [Pa]
    fast_seconds: float  #: processor time, integration and search

    @property
    def share(self) -> Array:
        """Full-order peak over the largest one (ne,)."""
        return np.asarray(self.full / self.full.max())

    @property
    def difference(self) -> Array:
        """Of the reduced peak from the full-order one, over the latter (ne,)."""
        return np.asarray(self.fast / np.where(self.full > 0, self.full, np.inf) - 1)

    @property
    def stressed(self) -> Array:
        """Differences of the elements that must agree, without sign."""
        return np.abs(self.difference[self.share > STRESSED])


def chapter(run: Run) -> Chapter:
    """Compute and describe."""
    cases, duration, substeps = (CASES[:1], 0.06, 2) if run.quick else (CASES, 1.0, 4)
    landings = [_peaks(run, case, duration, substeps) for case in cases]
    rows = [row for landing in landings for row in _comparisons(landing)]
    if not run.quick:
        rows.append(_step_error(run, landings[0], duration, substeps))
    # 0.7 s hold the touchdown of every gear, and the steps of the whole second would take an hour
    count, each, time = (1, 2, 0.06) if run.quick else (5, 4, 0.7)
    drawn = drawn_landings(run, count, each, time, (1, 2, 3) if run.quick else (2, 3, 4))
    size, count = run.reduced.size, run.reduced.element_count
    return Chapter(
        "reduced",
        "Reduced against full order",
        (
            Text(
                "The service integrates the airframe's vibration in "
                f"{size} reduced coordinates and searches {count} elements for their peaks. Here "
                "the same loads are integrated in all "
                f"{run.airframe.structure.n_free} freedoms, with the stress of every element at "
                "every step, for landings at loadings outside those the basis was made at. "
                + (
                    f"Of the landing only the first {1e3 * duration:.0f} ms are followed in this "
                    "short form."
                    if run.quick
                    else "The settings of the basis were chosen without a look at the last one."
                )
            ),
            _table(landings, substeps),
            Comparisons("Peaks of the elements, reduced against full order", tuple(rows)),
            _scatter_plot(landings),
            _difference_plot(landings),
            *_drawn_section(drawn, run.quick),
        ),
    )


def _peaks(run: Run, case: Case, duration: float, substeps: int) -> LandingPeaks:
    airframe = run.airframe
    loads = case.loads(airframe, duration)
    full, full_seconds = _full_order(run, case, loads, substeps)
    fast, fast_seconds = _reduced(run, case.factors(airframe), loads)
    return LandingPeaks(case, duration, full, full_seconds, fast, fast_seconds)


def _full_order(run: Run, case: Case, loads: LandingLoads, substeps: int) -> tuple[Array, float]:
    """Peaks (ne,) of the full-order integration and its processor time [s]."""
    airframe = run.airframe
    damping = airframe_damping(airframe)
    amplitudes = loads.applied_amplitudes()

    def compute() -> dict[str, Array]:
        start = process_time()
        peaks = PeakAccumulator(airframe.recovery)
        integrate_full_order(
            free_body(airframe.structure, airframe.inertia(case.factors(airframe))),
            BodyLoads(loads.time, applied_shapes(airframe), amplitudes, loads.motion),
            damping,
            peaks,
            substeps,
            progress=lambda step, share: run.progress(f"{case.name}: {step}", share),
        )
        return {"stress": peaks.stress, "seconds": np.array(process_time() - start)}

    inputs = [
        airframe.content_hash, case.factors(airframe), damping, substeps, loads.time, amplitudes,
        loads.motion,
    ]  # fmt: skip
    found = run.stored(f"full-order-{case.name}", inputs, FULL_ORDER_SOURCES, compute)
    return found["stress"], float(found["seconds"])


def _reduced(run: Run, factors: Array, loads: LandingLoads) -> tuple[Array, float]:
    """Peaks (ne,) of the reduced integration and its processor time [s]."""
    for _ in range(2):  # the first call compiles
        start = process_time()
        peaks = find_peaks(run.reduced, landing_response(assemble(run.reduced, factors), loads))
        seconds = process_time() - start
    return peaks.stress, seconds


def _comparisons(landing: LandingPeaks) -> tuple[Comparison, ...]:
    title = landing.case.title
    source = "full-order integration of the same loads"
    return (
        Comparison(
            f"{title}: elements above {STRESSED:.0%} of the largest peak, worst difference",
            float(landing.stressed.max()),
            0.0,
            TOLERANCE,
            "",
            source,
            "a hundredth of an element's peak is far below the uncertainty of any allowable",
            scale=1.0,
        ),
        Comparison(
            f"{title}: largest peak of all elements",
            float(landing.fast.max()),
            float(landing.full.max()),
            1e-3,
            "Pa",
            source,
            "the largest stresses are those of the mode shapes and loads the basis is made of",
        ),
    )


def _step_error(run: Run, landing: LandingPeaks, duration: float, substeps: int) -> Comparison:
    """How much of the difference the full order's own steps can be."""
    loads = landing.case.loads(run.airframe, duration)
    coarse, _ = _full_order(run, landing.case, loads, substeps // 2)
    stressed = landing.share > STRESSED
    change = np.abs(coarse / np.where(landing.full > 0, landing.full, np.inf) - 1)[stressed]
    return Comparison(
        f"{landing.case.title}: full order at doubled steps, worst difference of those elements",
        float(change.max()),
        0.0,
        TOLERANCE,
        "",
        f"full order at steps of {1e3 * loads.time[1] / substeps:.2f} ms",
        "second order in the step: the reference itself is a third of this from its limit",
        scale=1.0,
    )


def _drawn_section(drawn: list[DrawnLanding], quick: bool) -> tuple[Text, Table, Comparisons]:
    # the first milliseconds end on steep flanks, and the short form's steps are long
    share, tolerance = (STRESSED, TOLERANCE) if quick else (DRAWN_STRESSED, DRAWN_TOLERANCE)
    stressed = [landing.full > share * landing.full.max() for landing in drawn]
    rows = [
        (
            f"{landing.loading + 1}, {landing.mass:,.0f} kg",
            f"{landing.contact.sink_rate:.2f}",
            f"{np.degrees(landing.contact.pitch):.1f}",
            f"{np.degrees(landing.contact.roll):.1f}",
            f"{np.degrees(landing.contact.drift):.1f}",
            f"{landing.full.max() / 1e6:.0f}",
            str(int(some.sum())),
            f"{100 * landing.worst(0.2):.3f}",
            f"{100 * landing.worst(0.1):.3f}",
            f"{100 * landing.worst(0.05):.3f}",
            f"{100 * landing.full_error[some].max():.3f}",
        )
        for landing, some in zip(drawn, stressed, strict=True)
    ]
    comparisons = tuple(
        Comparison(
            f"drawn landing {number}, loading {landing.loading + 1}: elements above "
            f"{share:.0%} of the largest peak, worst difference",
            landing.worst(share),
            0.0,
            tolerance,
            "",
            "full-order integration of the same loads, in the limit of small steps",
            "a two-hundredth of so mild a stress decides nothing",
            scale=1.0,
        )
        for number, landing in enumerate(drawn, start=1)
    )
    loadings = len({landing.loading for landing in drawn})
    text = (
        f"{len(drawn)} landings at {loadings} loading{'s' if loadings > 1 else ''}, all drawn at "
        "random: sink rate, attitude, drift, rates, lift, and the fill of every tank and bay. The "
        "full order is integrated at three step sizes; its displacements are carried on to the "
        "limit of small steps, sample by sample, as the integration has even powers of the step."
        + (
            " In this short form only 60 ms are followed."
            if quick
            else " The settings of the basis were chosen with a look at landings 12, 13, 14, 16, "
            "not at the others; the landings that choose its axes span the same ranges."
        )
    )
    return (
        Text(text),
        Table(
            "Landings drawn at random: differences of the elements' peaks",
            (
                "loading",
                "sink rate [m/s]",
                "pitch [deg]",
                "roll [deg]",
                "drift [deg]",
                "largest peak [MPa]",
                f"elements above {share:.0%}",
                "above 20 %: worst [%]",
                "above 10 %: worst [%]",
                "above 5 %: worst [%]",
                "of the reference itself [%]",
            ),
            tuple(rows),
            "The last column is what the longest of the three steps change in the limit, worst "
            f"element above {share:.0%}: an estimate of its error.",
        ),
        Comparisons("Landings drawn at random", comparisons),
    )


def _table(landings: list[LandingPeaks], substeps: int) -> Table:
    rows = []
    for landing in landings:
        mild = np.abs(landing.difference[landing.share > 0.05])
        rows.append(
            (
                landing.case.title,
                f"{landing.full.max() / 1e6:.1f}",
                str(len(landing.stressed)),
                f"{100 * np.median(landing.stressed):.3f}",
                f"{100 * landing.stressed.max():.3f}",
                f"{100 * np.quantile(mild, 0.99):.3f}",
                f"{100 * mild.max():.3f}",
                f"{landing.full_seconds:.1f}",
                f"{landing.fast_seconds:.3f}",
                f"{landing.full_seconds / landing.fast_seconds:.0f}",
            )
        )
    return Table(
        "Differences of the elements' peaks, and processor time",
        (
            "landing",
            "largest peak [MPa]",
            "elements above 20 %",
            "median [%]",
            "worst [%]",
            "above 5 %: 99th percentile [%]",
            "worst [%]",
            "full order [s]",
            "reduced [s]",
            "factor",
        ),
        tuple(rows),
        "Differences are relative to each element's own full-order peak. Elements above 20 % or "
        "5 % are those whose peak exceeds that share of the landing's largest. The full order is "
        f"integrated at steps of {1 / substeps:g} ms, finer than a comparison of speed would need.",
    )


def _scatter_plot(landings: list[LandingPeaks]) -> Plot:
    panels = []
    for landing in landings:
        top = landing.full.max() / 1e6
        panels.append(
            Panel(
                "full order [MPa]",
                "reduced [MPa]",
                [
                    Line(np.array([0.0, top]), np.array([0.0, top]), width=0.6, colour=4),
                    Line(landing.full / 1e6, landing.fast / 1e6, stroke="points", colour=0),
                ],
                landing.case.title,
            )
        )
    return line_plot(
        "reduced-scatter",
        "Peak von Mises stress of every element, reduced against full order; the line is equality.",
        panels,
        height=2.4,
    )


def _difference_plot(landings: list[LandingPeaks]) -> Plot:
    bound = 100 * TOLERANCE
    panels = [
        Panel(
            "full-order peak over the largest one [%]",
            "difference [%]",
            [
                Line(100 * landing.share, 100 * landing.difference, stroke="points", colour=0),
                Line(np.array([100 * STRESSED, 100.0]), np.array([bound, bound]), colour=1),
                Line(np.array([100 * STRESSED, 100.0]), np.array([-bound, -bound]), colour=1),
            ],
            landing.case.title,
            log="x",
            x_limits=(1.0, 110.0),
            y_limits=(-4 * bound, 4 * bound),
        )
        for landing in landings
    ]
    return line_plot(
        "reduced-difference",
        "Difference of the reduced from the full-order peak over the peak itself, against how "
        "much an element is stressed; the lines are what is admissible above 20 %.",
        panels,
    )
