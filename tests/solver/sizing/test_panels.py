"""Buckling of flat panels against the coefficients of Timoshenko and Gere, tables 9-1 to 9-10."""

import numpy as np
import pytest

from solver.fe.model import FiniteElementModel
from solver.sizing.panels import panels
from verification.elements.meshes import material, model

YOUNG, RATIO, THICKNESS, WIDTH = 70e9, 0.3, 1.5e-3, 0.2
#: pi^2 D / (b^2 t)
UNIT = np.pi**2 * YOUNG * THICKNESS**2 / (12 * (1 - RATIO**2)) / WIDTH**2


def plate(length: float) -> FiniteElementModel:
    corners = np.array([[0.0, 0, 0], [length, 0, 0], [length, WIDTH, 0], [0, WIDTH, 0]])
    return model(
        corners,
        quads=np.array([[0, 1, 2, 3]]),
        thickness=THICKNESS,
        substance=material(YOUNG, RATIO),
    )


def coefficient(length: float, *stress: float) -> float:
    """Critical factor of stresses x, y, xy that are shares of `UNIT`."""
    state = UNIT * np.array(stress)[None, :, None]
    return 1 / float(panels(plate(length)).utilisation(state)[0, 0])


@pytest.mark.parametrize(
    ("length", "k"), [(0.2, 4.0), (0.4, 4.0), (0.6, 4.0), (0.12, 5.14), (0.28, 4.47)]
)
def test_compression_along_the_panel(length: float, k: float) -> None:
    """Table 9-1: 5.14 at a / b = 0.6, 4 at whole numbers, 4.47 at 1.4."""
    assert coefficient(length, -1, 0, 0) == pytest.approx(k, rel=2e-3)


def test_equal_compression_both_ways_of_a_square() -> None:
    assert coefficient(WIDTH, -1, -1, 0) == pytest.approx(2.0, rel=1e-12)


def test_tension_across_holds_a_panel_back() -> None:
    assert coefficient(WIDTH, -1, 1, 0) > 4.0
    assert panels(plate(WIDTH)).utilisation(np.array([[[UNIT], [UNIT], [0.0]]]))[0, 0] == 0.0


@pytest.mark.parametrize(("length", "k"), [(0.2, 9.34), (0.4, 6.34), (0.1, 4 * 6.34)])
def test_shear_of_either_sign(length: float, k: float) -> None:
    """5.34 + 4 (b/a)^2 with b the shorter side: the third panel is the second one turned."""
    for sign in (1, -1):
        assert coefficient(length, 0, 0, sign) == pytest.approx(k, rel=1e-12)


def test_compression_and_shear_act_together() -> None:
    """At half of the critical shear three quarters of the critical compression are left."""
    assert coefficient(WIDTH, -0.75 * 4.0, 0, 0.5 * 9.34) == pytest.approx(1.0, rel=1e-12)
