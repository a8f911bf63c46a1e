"""Sections of the chapter on elements with exact answers: patch tests, and beams."""

from collections.abc import Sequence

import numpy as np

from verification.chapter import Comparisons
from verification.comparison import Comparison
from verification.elements import beams, patch
from verification.elements.figures import Figure
from verification.elements.patch import invariants

MACNEAL = "MacNeal and Harder, Finite Elem. Anal. Des. 1, 1985"
ROUNDING = "solved exactly up to rounding, which bending amplifies by (l/t)² = 10⁴"


def compared(
    figure: Figure, source: str, tolerance: float, reason: str, name: str = "", unit: str = ""
) -> Comparison:
    """Compare a computed figure with its published one."""
    return Comparison(
        name or figure.case, figure.computed, figure.target, tolerance, unit, source, reason
    )


def patch_section() -> Comparisons:
    """Patch tests of shells and beams."""
    states = (
        ("constant membrane strain", patch.stretched(), patch.STRETCHED_STRESS, (1, 1)),
        ("constant shear and drilling", patch.sheared(), patch.SHEARED_STRESS, (1, 1)),
        ("constant bending and twist", patch.bent(), patch.BENT_STRESS, (1, -1)),
    )
    rows = []
    for state, motion, stress, faces in states:
        for shape in ("quads", "triangles", "both"):
            result = patch.solved_patch(shape, motion)
            exact = invariants(np.array([sign * stress for sign in faces]))
            error = float(np.abs(invariants(result.stress) - exact).max() / np.abs(exact).max())
            words = "quadrilaterals and triangles" if shape == "both" else _words(shape)
            for what, value in (("displacement", result.displacement_error), ("stress", error)):
                rows.append(
                    Comparison(
                        f"{state}, {words}: error of {what}",
                        value,
                        0.0,
                        1e-8,
                        "1",
                        f"{MACNEAL}, table 1: exact",
                        ROUNDING,
                        scale=1.0,
                    )
                )
    for thickness, words in ((1e-3, "thin"), (0.1, "moderate"), (10.0, "thick")):
        energy, exact_energy = patch.racked_rectangle(thickness)
        rows.append(
            Comparison(
                f"racked quadrilateral, {words}: energy",
                energy,
                exact_energy,
                1e-9,
                "",
                "closed form, 12 D b / (a³ (1 + φ)), clamped strip (Timoshenko)",
                "exact up to rounding, which membrane stiffness amplifies when thin",
            )
        )
    chain, expected = patch.solved_chain(1e-3, 2e-2, -1e-2, 3e-2)
    rows.append(
        Comparison(
            "constant section forces, unequal beams: error of stress",
            float(np.abs(chain.stress - expected).max() / np.abs(expected).max()),
            0.0,
            1e-9,
            "1",
            "closed form, E (ε − y κ₁ − z κ₂) and G r θ'",
            "exact up to rounding",
            scale=1.0,
        )
    )
    return Comparisons("Patch tests (distorted patch in a tilted plane)", tuple(rows))


def _words(shape: str) -> str:
    return {"quads": "quadrilaterals", "triangles": "triangles"}[shape]


def beam_section() -> Comparisons:
    """Beam elements against closed forms."""
    exact = "exact at the nodes for end loads, up to rounding"
    polygon = "0.1 %: polygon of straight beams, error falls with the square of their number"
    groups: Sequence[tuple[Sequence[Figure], str, float, str, str]] = (
        (beams.cantilever(1), "closed form, Timoshenko beam", 1e-9, exact, ""),
        (beams.offset_cantilever(), "closed form", 1e-9, exact, ""),
        (beams.curved_cantilever(48), "closed form, Castigliano", 1e-3, polygon, ""),
        (beams.twisted_cantilever(48), "closed form, integral of M²/(E I)", 1e-3, polygon, ""),
        (
            beams.free_beam_frequencies(),
            "closed form, cos βL cosh βL = 1",
            2e-4,
            "2e-4: 24 elements; shear and rotary inertia left out of the closed form",
            "rad/s",
        ),
        (
            beams.thick_beam_frequencies(),
            "T. C. Huang, J. Appl. Mech. 28, 1961",
            2e-3,
            "0.2 %: 60 elements, depth a tenth of the length",
            "rad/s",
        ),
    )
    return Comparisons(
        "Beam elements",
        tuple(
            compared(figure, source, tolerance, reason, unit=unit)
            for figures, source, tolerance, reason, unit in groups
            for figure in figures
        ),
    )
