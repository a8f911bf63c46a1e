"""Whole landings three ways: nonlinear dynamics, extended inertia relief at full order, reduced.

The comparisons of Tables 2 and 3 and of Figs 28 to 33 of Lee et al., for the landing of their
Table 1 and two others.  Long analyses are stored.
"""

import numpy as np

from solver.aircraft.airframe import Airframe, load_airframe
from solver.aircraft.bizjet import build_bizjet
from solver.arrays import Array
from solver.inertia_relief.basis import BasisSettings
from solver.inertia_relief.build import reduced_model
from solver.inertia_relief.reduced import ReducedModel
from verification.cases import Case
from verification.chapter import Chapter, Comparisons, Item, Table, Text
from verification.comparison import Comparison
from verification.run import Run
from verification.store import exclusive
from verification.tables.agreement import (
    AGREED,
    APART,
    EXAMINED,
    STRESSED,
    FieldAgreement,
    Followed,
    field_agreements,
    relative,
)
from verification.tables.analyses import SUBSTEPS, full_order, nonlinear, reduced
from verification.tables.figures import field_plot, peaks_plot, sequence_plot
from verification.tables.landings import HARD, NOSE_FIRST, PAPER, landed
from verification.tables.largest import largest_stress

#: What Lee et al. report in Table 3 [s].
PAPER_SECONDS = (114_091.0, 1_523.0)
#: Differences of every element's peak up to which they are counted.
COUNTED = 0.02


def chapter(run: Run) -> Chapter:
    """Compute and describe."""
    airframe, model = _aircraft(run)
    cases, duration = ((PAPER,), 0.04) if run.quick else ((PAPER, HARD, NOSE_FIRST), 1.0)
    followed = [_follow(run, airframe, model, case, duration) for case in cases]
    return Chapter(
        "tables",
        "Whole landings: nonlinear, full order, reduced",
        (
            Text(_introduction(airframe, model, duration)),
            *[sequence_plot(airframe, one.landed) for one in followed],
            *largest_stress(airframe, followed),
            *_fields(airframe, followed),
            *_running_times(followed),
        ),
    )


def _aircraft(run: Run) -> tuple[Airframe, ReducedModel]:
    """Full-size aircraft, or in the short form one of a coarse mesh."""
    if not run.quick:
        return run.airframe, run.reduced
    folder = run.folder / "tables-aircraft"
    with exclusive(folder.with_suffix(".lock")):
        build_bizjet(folder, refinement=0.25)
        airframe = load_airframe(folder)
    return airframe, reduced_model(airframe, settings=BasisSettings(modes=40))


def _follow(
    run: Run, airframe: Airframe, model: ReducedModel, case: Case, duration: float
) -> Followed:
    one = landed(airframe, case, duration)
    return Followed(
        one,
        nonlinear(run, airframe, one),
        full_order(run, airframe, one),
        reduced(model, one),
    )


def _introduction(airframe: Airframe, model: ReducedModel, duration: float) -> str:
    structure = airframe.structure
    return (
        "The loads of each landing are followed three ways. The nonlinear analysis moves the free "
        f"airframe ({structure.n_free} freedoms, {len(airframe.centroids)} elements with stress) "
        "with corotated shells and beams through finite rotation; nothing of its motion is "
        "prescribed. Extended inertia relief (EIR) at full order has the same freedoms in the "
        f"mean-axis frame of the rigid motion, and reduced EIR, the service's own way, "
        f"{model.size} coordinates. Nonlinear analysis and full order take the same steps of "
        f"{1 / SUBSTEPS:g} ms, by rules that are the same for small motion (midpoint, and average "
        "acceleration), with the same mass and damping, so that their difference is geometry. "
        f"Followed are {duration:g} s from the first contact."
    )


def _fields(airframe: Airframe, followed: list[Followed]) -> list[Item]:
    rows = [_field_row(one, found) for one in followed for found in field_agreements(airframe, one)]
    table = Table(
        "Stress fields at the peak of each gear's load, full-order EIR against nonlinear",
        (
            "landing",
            "gear",
            "time [s]",
            "load [kN]",
            "correlation",
            f"elements above {STRESSED:.0%}",
            "RMS difference [%]",
            "median [%]",
            "pressed shells [%]",
            "other shells [%]",
            "largest difference over largest stress [%]",
            f"elements that differ by more than {APART:.0%} of it",
            "critical factors around them",
            f"around elements within {AGREED:.0%}",
        ),
        tuple(rows),
        f"Differences of elements above {STRESSED:.0%} of the largest stress, relative to each "
        "element's own. Pressed shells are those whose principal membrane compression is above "
        "half of their von Mises stress. Critical factors: see the tables of largest stress; the "
        f"middle half of them, for the {EXAMINED} elements that differ most and about as many that "
        "agree.",
    )
    return [
        table,
        *[field_plot(airframe, one) for one in followed],
        _peaks_table(followed),
        peaks_plot(followed),
    ]


def _field_row(one: Followed, found: FieldAgreement) -> tuple[str, ...]:
    return (
        one.title,
        found.peak.gear.replace("_", " "),
        f"{found.time:.3f}",
        f"{found.peak.force / 1e3:.1f}",
        f"{found.correlation:.5f}",
        str(found.stressed),
        f"{100 * found.deviation:.2f}",
        f"{100 * found.bias:+.2f}",
        f"{100 * found.compressed:+.2f}",
        f"{100 * found.stretched:+.2f}",
        f"{100 * found.largest:.2f}",
        str(found.apart),
        _spread(found.factors_apart),
        _spread(found.factors_agreed),
    )


def _spread(factors: Array) -> str:
    """Middle half of critical factors."""
    if not len(factors):
        return "none"
    return " to ".join(f"{value:.2f}" for value in np.quantile(factors, [0.25, 0.75]))


def _peaks_table(followed: list[Followed]) -> Table:
    rows = []
    for one in followed:
        reference = one.nonlinear.stress.peak
        chosen = reference > STRESSED * reference.max()
        difference = 100 * relative(one.full.stress.peak, reference)[chosen]
        rows.append(
            (
                one.title,
                f"{reference.max() / 1e6:.1f}",
                f"{one.full.stress.peak.max() / 1e6:.1f}",
                str(int(chosen.sum())),
                f"{np.median(difference):+.2f}",
                f"{np.quantile(difference, 0.05):+.2f} to {np.quantile(difference, 0.95):+.2f}",
                f"{difference.min():+.2f} to {difference.max():+.2f}",
                f"{100 * float(np.mean(np.abs(difference) < 100 * COUNTED)):.1f}",
            )
        )
    return Table(
        "Every element's peak over the landing, full-order EIR against nonlinear",
        (
            "landing",
            "largest, nonlinear [MPa]",
            "largest, EIR [MPa]",
            f"elements above {STRESSED:.0%}",
            "median difference [%]",
            "5th to 95th percentile [%]",
            "all [%]",
            f"within {COUNTED:.0%} [% of them]",
        ),
        tuple(rows),
    )


def _running_times(followed: list[Followed]) -> list[Item]:
    rows, comparisons = [], []
    for one in followed:
        slow, full, fast = (analysis.seconds for _, analysis in one.analyses)
        rows.append(
            (
                one.title,
                f"{slow:.1f}",
                f"{full:.1f}",
                f"{fast:.3f}",
                f"{slow / full:.2f}",
                f"{full / fast:.0f}",
                f"{slow / fast:.0f}",
                f"{one.nonlinear.iterations:.2f}",
            )
        )
        for name, error in (
            ("energy account", one.nonlinear.energy_error),
            ("momentum account", one.nonlinear.momentum_error),
        ):
            comparisons.append(
                Comparison(
                    f"{one.title}: {name} of the nonlinear analysis, imbalance",
                    error,
                    0.0,
                    1e-3,
                    "",
                    "balance of the whole landing",
                    "an error of the reference must be small beside the compared differences",
                    scale=1.0,
                )
            )
    factor = PAPER_SECONDS[0] / PAPER_SECONDS[1]
    return [
        Table(
            "Processor time",
            (
                "landing",
                "nonlinear [s]",
                "EIR, full order [s]",
                "EIR, reduced [s]",
                "nonlinear : full order",
                "full order : reduced",
                "nonlinear : reduced",
                "evaluations in a nonlinear step",
            ),
            tuple(rows),
            f"Lee et al.: {PAPER_SECONDS[0]:.0f} s and {PAPER_SECONDS[1]:.0f} s, a factor of "
            f"{factor:.0f}. One thread. Nonlinear and full order contain their matrices and "
            "the stress of every element at every sample, the reduced time loading, integration "
            "and peaks of all elements; building the reduced model, once for an aircraft, is not "
            "in it. Where a nonlinear run was interrupted, only its steps count.",
        ),
        Comparisons("How well the reference was solved", tuple(comparisons)),
    ]
