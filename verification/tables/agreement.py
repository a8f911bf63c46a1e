"""How far the analyses of a landing agree: most stressed element, whole fields, peaks."""

from dataclasses import dataclass

import numpy as np

from solver.aircraft.airframe import Airframe
from solver.arrays import Array, BoolArray, IntArray
from verification.tables.analyses import Analysis, FullOrder, Nonlinear
from verification.tables.landings import GearPeak, Landed
from verification.tables.panels import PanelStability
from verification.tables.submodel import panel_stress

#: Elements above this share of the largest stress take part in the comparison of fields.
STRESSED = 0.2
#: Difference over the largest stress from which an element counts as one that the analyses part at.
APART = 0.1
#: Difference up to which they agree.
AGREED = 0.02
#: Elements of either kind whose neighbourhoods are examined, at most.
EXAMINED = 40


@dataclass(frozen=True, slots=True)
class Followed:
    """One landing by all three analyses."""

    landed: Landed
    nonlinear: Nonlinear
    full: FullOrder
    fast: Analysis

    @property
    def title(self) -> str:
        """Words that name the landing."""
        return self.landed.case.title

    @property
    def analyses(self) -> tuple[tuple[str, Analysis], ...]:
        """Name and stresses of each analysis."""
        return (
            ("nonlinear", self.nonlinear.stress),
            ("EIR, full order", self.full.stress),
            ("EIR, reduced", self.fast),
        )


@dataclass(frozen=True, slots=True)
class Crest:
    """Largest stress of the swing on whose flank an instant lies."""

    time: float  #: [s]
    stress: float  #: [Pa]


def crest(analysis: Analysis, time: Array, sample: int) -> Crest:
    """Follow the most stressed element uphill from a sample, as long as it stays that."""
    largest, element = analysis.largest, analysis.element
    for step in (-1, 1):
        at = sample
        while (
            0 <= at + step < len(largest)
            and element[at + step] == element[sample]
            and largest[at + step] >= largest[at]
        ):
            at += step
        if at != sample:
            return Crest(float(time[at]), float(largest[at]))
    return Crest(float(time[sample]), float(largest[sample]))


@dataclass(frozen=True, slots=True)
class Maximum:
    """Most stressed element at one instant, by each analysis."""

    time: float  #: [s]
    elements: tuple[int, int, int]  #: nonlinear, full order, reduced
    stresses: tuple[float, float, float]  #: [Pa]
    #: Nonlinear stress of the full order's most stressed element, over the largest one.
    standing: float
    at_same: float  #: full-order stress of the nonlinear analysis's most stressed element [Pa]
    #: At which the full order's stresses buckle the panel around that element.
    critical_factor: float
    panel: float  #: its stress in nonlinear statics of the panel, driven by the full order [Pa]
    crests: tuple[Crest, Crest]  #: of the nonlinear analysis and the full order

    @property
    def is_same(self) -> bool:
        """Whether nonlinear analysis and full order find the same element."""
        return self.elements[0] == self.elements[1]

    @property
    def difference(self) -> float:
        """Of the full order's largest stress from the nonlinear one, relative."""
        return self.stresses[1] / self.stresses[0] - 1.0


def maxima(airframe: Airframe, followed: Followed) -> list[Maximum]:
    """Most stressed elements at the instants of the table."""
    found = []
    fields = [analysis.fields for _, analysis in followed.analyses]
    for row, sample in enumerate(followed.landed.instants):
        elements = [int(field[row].argmax()) for field in fields]
        first, second, third = (
            float(field[row, element]) for field, element in zip(fields, elements, strict=True)
        )
        panels = _panels(airframe, followed, row)
        found.append(
            Maximum(
                time=float(followed.landed.loads.time[sample]),
                elements=(elements[0], elements[1], elements[2]),
                stresses=(first, second, third),
                standing=float(fields[0][row, elements[1]]) / first,
                at_same=float(fields[1][row, elements[0]]),
                critical_factor=panels.factor(elements[0]),
                panel=panel_stress(airframe, followed.full.displacements[row], elements[0]),
                crests=(
                    crest(followed.nonlinear.stress, followed.landed.loads.time, sample),
                    crest(followed.full.stress, followed.landed.loads.time, sample),
                ),
            )
        )
    return found


def distance(airframe: Airframe, first: int, second: int) -> float:
    """Distance between the centroids of two elements [m]."""
    return float(np.linalg.norm(airframe.centroids[first] - airframe.centroids[second]))


@dataclass(frozen=True, slots=True)
class FieldAgreement:
    """Full-order against nonlinear stresses of all elements at the peak of a gear's load."""

    peak: GearPeak
    time: float  #: [s]
    correlation: float
    deviation: float  #: RMS of the relative difference of the stressed elements
    bias: float  #: median of that difference
    stressed: int  #: number of these elements
    compressed: float  #: median difference of the stressed shells that are pressed together
    stretched: float  #: and of those that are not
    largest: float  #: largest difference of any element, over the largest stress
    apart: int  #: elements that differ by more than `APART` of the largest stress
    factors_apart: Array  #: critical factors around some of them, those that differ most
    factors_agreed: Array  #: and around some stressed elements that agree


def field_agreements(airframe: Airframe, followed: Followed) -> list[FieldAgreement]:
    """Compare the fields at the peak of every gear's load."""
    landed, found = followed.landed, []
    for peak in landed.peaks:
        row = landed.field(peak)
        reference = followed.nonlinear.stress.fields[row]
        field = followed.full.stress.fields[row]
        chosen = reference > STRESSED * reference.max()
        difference = relative(field, reference)
        pressed = pressed_shells(followed.full, row)
        size = np.abs(field - reference) / reference.max()
        order = np.argsort(-size)
        apart = order[size[order] > APART]
        agreed = np.flatnonzero(chosen & (np.abs(difference) < AGREED))
        panels = _panels(airframe, followed, row)
        found.append(
            FieldAgreement(
                peak=peak,
                time=float(landed.loads.time[peak.sample]),
                correlation=float(np.corrcoef(reference, field)[0, 1]),
                deviation=float(np.sqrt(np.mean(difference[chosen] ** 2))),
                bias=float(np.median(difference[chosen])),
                stressed=int(chosen.sum()),
                compressed=_median(difference[chosen & pressed]),
                stretched=_median(difference[chosen & ~pressed & _shells(followed.full, chosen)]),
                largest=float(size.max()),
                apart=len(apart),
                factors_apart=_factors(panels, apart[:EXAMINED]),
                factors_agreed=_factors(panels, agreed[:: -(-len(agreed) // EXAMINED) or 1]),
            )
        )
    return found


def _panels(airframe: Airframe, followed: Followed, row: int) -> PanelStability:
    return PanelStability(airframe, followed.landed.factors, followed.full.displacements[row])


def _factors(panels: PanelStability, elements: IntArray) -> Array:
    return np.array([panels.factor(int(element)) for element in elements])


def relative(values: Array, reference: Array) -> Array:
    """Relative differences; none where the reference is zero."""
    return np.asarray(values / np.where(reference > 0, reference, np.inf) - 1.0)


def pressed_shells(full: FullOrder, row: int) -> BoolArray:
    """Elements (ne,) that are shells whose membrane stress is mostly compression.

    Mostly: the principal stress of compression is above half of the von Mises stress.
    """
    field, least = full.stress.fields[row], full.compression[row]
    pressed = np.zeros(len(field), dtype=bool)
    pressed[: len(least)] = -least > 0.5 * field[: len(least)]
    return pressed


def _shells(full: FullOrder, like: BoolArray) -> BoolArray:
    shells = np.zeros_like(like)
    shells[: full.compression.shape[1]] = True
    return shells


def _median(values: Array) -> float:
    return float(np.median(values)) if len(values) else float("nan")
