"""Largest stress of all elements at the instants of the table, by the three analyses."""

from solver.aircraft.airframe import Airframe
from verification.chapter import Comparisons, Item, Table, Text
from verification.comparison import Comparison
from verification.tables import submodel
from verification.tables.agreement import Followed, Maximum, distance, maxima
from verification.tables.figures import history_plot
from verification.tables.panels import REACH

#: Of the largest stress, extended inertia relief against nonlinear, where one element has it.
TOLERANCE = 0.02
#: Of the largest stress, reduced against full order.
REDUCED_TOLERANCE = 0.01
#: Of the stress in a panel that is nonlinear by itself, against the nonlinear analysis.
PANEL_TOLERANCE = 0.05
#: What Lee et al. report in Table 2.
PAPER_DIFFERENCES = (0.0373, 0.0270, 0.0214, 0.0312)


def largest_stress(airframe: Airframe, followed: list[Followed]) -> list[Item]:
    """Tables, figure, comparisons and what explains the differences."""
    found = [maxima(airframe, one) for one in followed]
    pairs = list(zip(followed, found, strict=True))
    rows = [row for one, largest in pairs for row in _maximum_comparisons(one, largest)]
    low, high = 100 * min(PAPER_DIFFERENCES), 100 * max(PAPER_DIFFERENCES)
    return [
        history_plot(followed),
        *[_maximum_table(airframe, one, largest) for one, largest in pairs],
        Comparisons("Largest stress of all elements", tuple(rows)),
        Text(
            f"Lee et al. report differences of {low:.1f} to {high:.1f} % between their nonlinear "
            "analysis and extended inertia relief. " + _explanation(pairs)
        ),
    ]


def _maximum_table(airframe: Airframe, one: Followed, largest: list[Maximum]) -> Table:
    model = airframe.structure.model
    rows = []
    for maximum in largest:
        for index, (name, _) in enumerate(one.analyses):
            element, stress = maximum.elements[index], maximum.stresses[index]
            place = ", ".join(f"{value:.3f}" for value in airframe.centroids[element])
            away = distance(airframe, maximum.elements[0], element)
            rows.append(
                (
                    f"{maximum.time:.3f}" if index == 0 else "",
                    name,
                    str(model.element_identifiers[element]),
                    airframe.definition.zones[airframe.element_zone[element]].name,
                    place,
                    f"{stress / 1e6:.3f}",
                    "" if index == 0 else f"{100 * (stress / maximum.stresses[0] - 1):+.2f}",
                    "" if index == 0 else f"{away:.3f}",
                    f"{maximum.critical_factor:.2f}" if index == 0 else "",
                    f"{maximum.panel / 1e6:.2f}" if index == 0 else "",
                )
            )
    return Table(
        f"Largest stress, {one.title}",
        (
            "time [s]",
            "analysis",
            "element",
            "zone",
            "x, y, z [m]",
            "stress [MPa]",
            "difference from nonlinear [%]",
            "distance [m]",
            "critical factor",
            "panel [MPa]",
        ),
        tuple(rows),
        "Places are centroids of elements in structural axes: x aft, y to starboard, z up. The "
        "critical factor is that at which the stresses of linear analysis buckle the panels "
        f"within {REACH:g} m of the nonlinear analysis's element, everything beyond held. Panel: "
        "stress of that element in nonlinear statics of what is within "
        f"{submodel.REACH:g} m, driven by the displacements and loads of full-order EIR.",
    )


def _maximum_comparisons(one: Followed, largest: list[Maximum]) -> list[Comparison]:
    rows = []
    for maximum in largest:
        title = f"{one.title}, {maximum.time:.3f} s"
        _, full, fast = maximum.stresses
        rows.append(_nonlinear_comparison(title, maximum))
        rows.append(
            Comparison(
                f"{title}: reduced EIR",
                fast / 1e6,
                full / 1e6,
                REDUCED_TOLERANCE,
                "MPa",
                "full-order EIR of the same landing",
                "a hundredth of the largest stress is far below the uncertainty of any allowable",
            )
        )
    return rows


def _nonlinear_comparison(title: str, maximum: Maximum) -> Comparison:
    """Compare the sizes, on a steep flank those of the swing, in a bowed panel its own statics."""
    if _is_flank(maximum):
        reference, found = maximum.crests
        return Comparison(
            f"{title}: full-order EIR, same element, crest of its swing",
            found.stress / 1e6,
            reference.stress / 1e6,
            TOLERANCE,
            "MPa",
            "nonlinear analysis of the same landing",
            "the instant lies on the flank of a swing, where a small difference of phase or decay "
            f"counts; the crests are {1e3 * abs(found.time - reference.time):.0f} ms apart. Axial "
            "load stiffens or softens what bends under it, which eq (15) does not know",
        )
    if not _is_apart(maximum):
        element = "same element" if maximum.is_same else "another element"
        return Comparison(
            f"{title}: full-order EIR, {element}",
            maximum.stresses[1] / 1e6,
            maximum.stresses[0] / 1e6,
            TOLERANCE,
            "MPa",
            "nonlinear analysis of the same landing",
            "Lee et al. report 2.1 to 3.7 %; with the same steps and damping, linear analysis "
            "should do better",
        )
    return Comparison(
        f"{title}: another element; full-order EIR with nonlinear statics of its panel",
        maximum.panel / 1e6,
        maximum.stresses[0] / 1e6,
        PANEL_TOLERANCE,
        "MPa",
        "nonlinear analysis of the same landing",
        "shows that the difference is the geometry of one panel; its edges follow the linear "
        "analysis and it does not vibrate by itself, which leaves some of the difference",
    )


def _is_flank(maximum: Maximum) -> bool:
    return maximum.is_same and abs(maximum.difference) > TOLERANCE


def _of_flank(one: Followed, maximum: Maximum) -> str:
    reference, found = maximum.crests
    return (
        f"{one.title}, {maximum.time:.3f} s lies on the flank of a swing of that element, whose "
        f"crest is {reference.stress / 1e6:.1f} MPa at {reference.time:.3f} s in the nonlinear "
        f"analysis and {found.stress / 1e6:.1f} MPa at {found.time:.3f} s in EIR "
        f"({100 * (found.stress / reference.stress - 1):+.1f} %)."
    )


def _is_apart(maximum: Maximum) -> bool:
    return not maximum.is_same and abs(maximum.difference) > TOLERANCE


def _explanation(pairs: list[tuple[Followed, list[Maximum]]]) -> str:
    every = [maximum for _, largest in pairs for maximum in largest]
    same = [100 * abs(maximum.difference) for maximum in every if maximum.is_same]
    words = [
        f"Here the same element is critical at {len(same)} of {len(every)} instants"
        + (f", where the sizes differ by {min(same):.2f} to {max(same):.2f} %." if same else ".")
    ]
    for one, largest in pairs:
        words += [_of_flank(one, maximum) for maximum in largest if _is_flank(maximum)]
        words += [_of_other_element(one, maximum) for maximum in largest if not maximum.is_same]
    apart = [maximum for maximum in every if _is_apart(maximum)]
    if apart:
        explained = sum(
            abs(maximum.panel / maximum.stresses[0] - 1.0) <= PANEL_TOLERANCE for maximum in apart
        )
        words.append(
            f"At {len(apart)} instants another element is critical and the sizes differ by more "
            f"than {TOLERANCE:.0%}. Stiffened skin there is in compression at a share of its "
            "buckling load that the critical factor says; the panel bows and its stringers "
            "bend with it, which no linear analysis shows. Nonlinear statics of the "
            "panel alone, driven by full-order EIR, has the linear stress at small loads and at "
            f"the whole load comes within {PANEL_TOLERANCE:.0%} of the nonlinear analysis at "
            f"{explained} of these instants. What it leaves out is that the panel vibrates, and "
            "that one which has buckled earlier in the landing may stay in its new shape. Extended "
            "inertia relief, at full order or reduced, understates stresses in such panels."
        )
    return " ".join(words)


def _of_other_element(one: Followed, maximum: Maximum) -> str:
    return (
        f"{one.title}, {maximum.time:.3f} s: the element that full-order EIR finds largest has "
        f"{100 * maximum.standing:.1f} % of the largest stress in the nonlinear analysis; in the "
        f"nonlinear analysis's own most stressed element EIR differs by "
        f"{100 * (maximum.at_same / maximum.stresses[0] - 1):+.1f} %, and by "
        f"{100 * (maximum.panel / maximum.stresses[0] - 1):+.1f} % with nonlinear statics of the "
        f"panel around it, whose critical factor is {maximum.critical_factor:.2f}."
    )
