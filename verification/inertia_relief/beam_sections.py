"""Sections of the chapter on inertia relief about beams, bars and plates with closed forms."""

import numpy as np

from verification.chapter import Comparisons, Item, Text
from verification.comparison import Comparison
from verification.elements import meshes
from verification.inertia_relief.beam_dynamics import (
    LENGTH,
    spin_frequencies,
    spinning_step_response,
    step_response,
)
from verification.inertia_relief.statics import (
    BAR_LENGTH,
    FREE_BEAM_CASES,
    bar_extension,
    largest_moment,
    plate_supports,
    spinning_bar,
)
from verification.plots import Line, Panel, line_plot

#: Side of the spinning beam's section over its length.
SLENDERNESS = (0.005, 0.01, 0.025, 0.05, 0.1)


def static_section() -> list[Item]:
    """Free beams, a free plate on several supports, and the spinning bar."""
    rows = []
    for case in FREE_BEAM_CASES:
        moment, _ = largest_moment(case.loads)
        rows.append(
            Comparison(
                f"free beam, {case.name}: largest moment",
                moment,
                case.moment,
                2e-3,
                "N m",
                "closed form, d'Alembert load of a rigid beam",
                "0.2 %: 48 elements, each misses its own inertia load",
            )
        )
    choice = plate_supports()
    for what, value in (("stress", choice.stress), ("displacement", choice.displacement)):
        rows.append(
            Comparison(
                f"free plate on four supports: difference of {what}",
                value,
                0.0,
                1e-8,
                "1",
                "balanced loads call up no reaction",
                "rounding, amplified by the condition of the stiffness",
                scale=1.0,
            )
        )
    substance = meshes.material()
    speed = np.sqrt(substance.young_modulus / substance.density)
    # k = w / c; the softened closed form has its pole at k L = pi
    shares = np.linspace(0.02, 0.7, 12)
    rates = shares * np.pi / BAR_LENGTH * speed
    found = np.array([spinning_bar(float(rate)) for rate in rates])
    linear, softened = np.array([bar_extension(float(rate)) for rate in rates]).T
    for index, reference, words in (
        (0, linear, "μ w² L³ / (24 E A)"),
        (len(rates) - 1, softened, "tan(k L/2)/k − L/2"),
    ):
        rows.append(
            Comparison(
                f"spinning bar at {rates[index]:.0f} rad/s: tip extension",
                float(found[index]),
                float(reference[index]),
                1e-3,
                "m",
                f"closed form {words}",
                "0.1 %: 60 elements" + ("; softening is left out" if index == 0 else ""),
            )
        )
    plot = line_plot(
        "spinning-bar",
        "Free bar spinning about a transverse axis: extension of each half. The centrifugal term"
        " of u softens the bar, since what moves outward is pulled harder; the linear formula"
        " leaves it out.",
        [
            Panel(
                "rate × L / (π c) (1)",
                "extension of a half (m)",
                [
                    Line(shares, softened, "closed form with softening"),
                    Line(shares, linear, "without", "dashed"),
                    Line(shares, found, "inertia relief", "points"),
                ],
            )
        ],
        columns=1,
    )
    return [Comparisons("Statics of free bodies", tuple(rows)), plot]


def dynamic_section(quick: bool) -> list[Item]:
    """Step load on a free beam, at rest and spinning about its axis."""
    time, found, exact = step_response()
    rows = [
        Comparison(
            "free beam under a step load: largest difference of any node",
            float(np.abs(found - exact).max() / np.abs(exact).max()),
            0.0,
            5e-3,
            "1",
            "modal series of five symmetric modes",
            "0.5 % of the largest deflection: the series is cut off, shear is left out of it",
            scale=1.0,
        )
    ]
    turning, tip, tip_exact = spinning_step_response(substeps=8 if quick else 20)
    rows.append(
        Comparison(
            "spinning beam under a step load: largest difference of the tip",
            float(np.abs(tip - tip_exact).max() / np.abs(tip_exact).max()),
            0.0,
            1e-2,
            "1",
            "every mode by its matrix exponential in turning axes",
            "1 %: series cut off, second-order time step",
            scale=1.0,
        )
    )
    plots = line_plot(
        "free-beam-step-load",
        "Free beam under a force at its middle that rises within one sample. Left: at rest."
        " Right: spinning about its axis, where the Coriolis force drives it out of the plane of"
        " the load; seen from axes that spin with it.",
        [
            Panel(
                "time (s)",
                "deflection (mm)",
                [
                    Line(time, 1e3 * exact[0], "tip"),
                    Line(time[::4], 1e3 * found[0, ::4], "", "points", colour=0),
                    Line(time, 1e3 * exact[found.shape[0] // 2], "middle"),
                    Line(time[::4], 1e3 * found[found.shape[0] // 2, ::4], "", "points", colour=1),
                ],
                title="at rest; points: inertia relief",
            ),
            Panel(
                "time (s)",
                "deflection of the tip (mm)",
                [
                    Line(turning, 1e3 * tip_exact.imag, "along the load"),
                    Line(turning[::3], 1e3 * tip.imag[::3], "", "points", colour=2),
                    Line(turning, 1e3 * tip_exact.real, "across it"),
                    Line(turning[::3], 1e3 * tip.real[::3], "", "points", colour=3),
                ],
                title="spinning; points: inertia relief",
            ),
        ],
    )
    return [*_spin_about_axis(rows), plots]


def _spin_about_axis(rows: list[Comparison]) -> list[Item]:
    errors = []
    for share in SLENDERNESS:
        found, target = spin_frequencies(share * LENGTH)
        without, _ = spin_frequencies(share * LENGTH, rotary_rates=False)
        errors.append([np.abs(found / target - 1).max(), np.abs(without / target - 1).max()])
        if share == SLENDERNESS[1]:
            rows += [
                Comparison(
                    f"beam spinning about its axis: frequency |ω_n ± Ω|, {k + 1} of 6",
                    float(found[k]),
                    float(target[k]),
                    1e-9,
                    "rad/s",
                    "exact: in space the beam vibrates at ω_n whatever it spins at",
                    "rounding of the eigenvalues",
                )
                for k in range(len(found))
            ]
    both, translations = np.array(errors).T
    plot = line_plot(
        "spin-about-axis",
        "Beam spinning about its axis at 0.4 of its lowest frequency: largest error of the"
        " frequencies |ω_n ± Ω|. With W on translations and rotations the equation is exact; with"
        " W on translations alone the error grows with the square of depth over length.",
        [
            Panel(
                "depth / length (1)",
                "error of frequency (1)",
                [
                    Line(np.array(SLENDERNESS), translations, "translations only", "marked"),
                    Line(np.array(SLENDERNESS), both, "rotations too", "marked"),
                ],
                log="xy",
                x_limits=(1e-3, 1.0),
            )
        ],
        columns=1,
    )
    note = Text(
        f"With W on the translations alone the spinning beam of depth L/{1 / SLENDERNESS[1]:.0f}"
        f" misses its frequencies by {translations[1]:.1e}, that of depth"
        f" L/{1 / SLENDERNESS[-1]:.0f} by {translations[-1]:.1e}; with W on the rotations as well"
        f" both are exact ({both.max():.0e})."
    )
    return [Comparisons("Dynamics of free beams", tuple(rows)), note, plot]
