"""What was found, as tables: the same rows go to the terminal and into the docs."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from verification.judging.accidents import DESIGN_SINK_RATE, FOOT, JudgedCase, Scale
from verification.judging.knowledge import Knowledge, Learned
from verification.judging.methods import Answers
from verification.judging.population import KINDS
from verification.judging.score import Calibration, FleetScore
from verification.judging.shares import Curve, Share

#: Misses that are hoped for at most.
HOPED_MISSES = 0.01


@dataclass(frozen=True, slots=True)
class Table:
    """Headings and rows of text."""

    name: str  #: of its place in the docs
    title: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def markdown(self) -> str:
        """GitHub's form."""
        lines = [self.headings, ("---",) * len(self.headings), *self.rows]
        return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def percent(value: float) -> str:
    """Print a share in percent, with the digits it is good for."""
    if not np.isfinite(value):
        return "–"
    digits = 2 if abs(value) < 0.01 and value != 0.0 else 1 if abs(value) < 0.1 else 0
    return f"{100.0 * value:.{digits}f} %"


def with_interval(share: Share) -> str:
    """Print a share and its interval."""
    if not share.count:
        return "–"
    return f"{percent(share.value)} ({percent(share.lower)} to {percent(share.upper)})"


def cases_table(cases: Sequence[JudgedCase], scale: Scale) -> Table:
    """Show what was published of each case, what it became here, and the verdict."""
    rows = []
    for judged in cases:
        case = judged.case
        published = "; ".join(_published(each.basis, each.value, each.certainty)
                              for each in case.contact)  # fmt: skip
        sinks = "; ".join(f"{each.sink_rate / FOOT:.1f}" for each in judged.record.contacts)
        verdict = str(judged.assessment.verdict)
        rows.append(
            (
                f"{case.name}: {case.title}",
                published,
                case.assumptions or "nothing",
                sinks,
                f"{judged.utilisation:.2f}",
                str(case.expected),
                f"**{verdict}, milder**" if judged.is_milder else verdict,
            )
        )
    limit = scale.limit_sink_rate
    return Table(
        "cases",
        f"Limit sink rate of the example at its landing mass: {limit:.2f} m/s, "
        f"{limit / FOOT:.1f} ft/s ({limit / DESIGN_SINK_RATE:.2f} of the design sink rate)",
        (
            "case", "published", "assumed", "sink rate here [ft/s]", "largest use of a limit",
            "called for", "verdict",
        ),
        tuple(rows),
    )  # fmt: skip


def _published(basis: str, value: float, certainty: str) -> str:
    unit = {
        "sink_rate": f"{value:.0f} ft/min",
        "normal_load_factor": f"{value:.2f} g",
        "energy": f"{value:.1f} times the energy",
        "share": f"{value:.2f} of the limit",
    }[basis]
    return unit if certainty == "read" else f"{unit} ({certainty})"


def fleet_table(answers: Sequence[Answers], score: FleetScore) -> Table:
    """How many landings of each kind were flown, and what they stand for."""
    weights = np.array([each.weight for each in answers])
    rows = []
    for kind in KINDS:
        inside = np.array([each.kind == kind.name for each in answers])
        hard = inside & np.array([each.utilisation > 1.0 for each in answers])
        rows.append(
            (
                kind.name,
                percent(kind.share),
                str(int(inside.sum())),
                str(int(hard.sum())),
                percent(float(weights[hard].sum() / max(weights[inside].sum(), 1e-300))),
            )
        )
    rows.append(
        ("all", "100 %", str(score.landings), str(score.hard), with_interval(score.hard_share))
    )
    return Table(
        "fleet",
        f"{score.landings} landings flown, {score.hard} of them hard; in service "
        f"{percent(score.undetermined.value)} of the windows carry no verdict",
        ("kind", "of service", "flown", "hard", "hard, in service"),
        tuple(rows),
    )


def methods_table(score: FleetScore) -> Table:
    """Wrong calls, false alarms, misses and areas of every method."""
    rows = [
        (
            each.name,
            with_interval(each.wrong_calls),
            with_interval(each.false_alarms),
            with_interval(each.misses),
            f"{each.area:.3f} ({each.area_interval[0]:.3f} to {each.area_interval[1]:.3f})",
            percent(wrong_calls_at(each.curve, HOPED_MISSES)),
        )
        for each in score.methods
    ]
    return Table(
        "methods",
        "Methods on the same recordings, weighted to service",
        (
            "method", "wrong calls, of its alarms", "false alarms, of sound landings",
            "missed, of hard landings", "area under the curve",
            f"wrong calls if at most {percent(HOPED_MISSES)} were missed",
        ),
        tuple(rows),
    )  # fmt: skip


def wrong_calls_at(curve: Curve, misses: float) -> float:
    """Share of wrong calls at the highest threshold that misses no more."""
    enough = np.flatnonzero(curve.alarms_of_hard >= 1.0 - misses)
    return float(curve.wrong_calls[enough[0]])


def calibration_table(name: str, title: str, calibration: Calibration) -> Table:
    """Reliability of stated probabilities."""
    rows = [
        (
            str(each.observed.count),
            percent(each.stated),
            with_interval(each.observed),
            f"{100.0 * (each.observed.value - each.stated):+.0f} points",
        )
        for each in calibration.bins
    ]
    return Table(
        name,
        f"{title}: mean distance {100.0 * calibration.error:.1f} points",
        ("landings", "stated", "hard", "difference"),
        tuple(rows),
    )


def knowledge_table(knowledge: Sequence[Knowledge]) -> Table:
    """Show what an estimate errs by, and what better knowledge would make of it."""
    rows = [
        (
            each.name,
            str(each.landings),
            _signed(each.error_mean),
            percent(each.error_sd),
            percent(each.error_size),
            with_interval(each.wrong_calls),
            with_interval(each.misses),
            f"{each.area:.3f}" if np.isfinite(each.area) else "–",
            with_interval(each.wrong_calls_in_service),
            with_interval(each.misses_in_service),
        )
        for each in knowledge
    ]
    return Table(
        "knowledge",
        "Landings near the limit, as flown; what is added is added to the state after assimilation "
        "at 8 Hz",
        (
            "the use of a limit by", "landings", "mean error", "scatter of the error",
            "median size", "wrong calls", "missed", "area under the curve",
            "wrong calls, in service",
            "missed, in service",
        ),
        tuple(rows),
    )  # fmt: skip


def learned_table(learned: Sequence[Learned]) -> Table:
    """Show what a recorded response tells of the aircraft."""
    rates = sorted(learned[0].left) if learned else []
    return Table(
        "learned",
        "Standard deviation after assimilation over that before, mean",
        ("what the aircraft was like", *(f"{rate:g} Hz" for rate in rates)),
        tuple(
            (each.parameter.replace("_", " "), *(f"{each.left[rate]:.2f}" for rate in rates))
            for each in learned
        ),
    )


def _signed(value: float) -> str:
    return f"{100.0 * value:+.1f} %"
