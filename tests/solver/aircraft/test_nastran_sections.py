"""Cross-sections against closed forms and against brute-force integration over the area."""

import math

import numpy as np
import pytest

from solver.aircraft.nastran import parse_bulk_data
from solver.aircraft.nastran_sections import SHAPES, rectangle_torsion, section_property
from solver.errors import ModelError

EXAMPLES = {
    "ROD": [0.03],
    "TUBE": [0.05, 0.046],
    "BAR": [0.03, 0.08],
    "BOX": [0.06, 0.1, 0.004, 0.003],
    "I": [0.1, 0.06, 0.04, 0.004, 0.005, 0.006],
    "T": [0.05, 0.07, 0.004, 0.003],
    "CHAN": [0.04, 0.09, 0.003, 0.005],
    "HAT": [0.04, 0.002, 0.05, 0.02],
}


def filled(shape, dimensions, y, z):
    """Whether points belong to a section, straight from the Quick Reference Guide's pictures."""
    if shape == "ROD":
        return y**2 + z**2 <= dimensions[0] ** 2
    if shape == "TUBE":
        outer, inner = dimensions
        return (y**2 + z**2 <= outer**2) & (y**2 + z**2 >= inner**2)
    if shape == "BAR":
        return (abs(z) <= dimensions[0] / 2) & (abs(y) <= dimensions[1] / 2)
    if shape == "BOX":
        width, height, flange, web = dimensions
        outside = (abs(z) <= width / 2) & (abs(y) <= height / 2)
        return outside & ~((abs(z) < width / 2 - web) & (abs(y) < height / 2 - flange))
    if shape == "I":
        height, lower, upper, web, low, high = dimensions
        bottom = (y >= 0) & (y <= low) & (abs(z) <= lower / 2)
        top = (y >= height - high) & (y <= height) & (abs(z) <= upper / 2)
        return bottom | top | ((y >= 0) & (y <= height) & (abs(z) <= web / 2))
    if shape == "T":
        width, height, flange, web = dimensions
        top = (y >= height - flange) & (y <= height) & (abs(z) <= width / 2)
        return top | ((y >= 0) & (y <= height) & (abs(z) <= web / 2))
    if shape == "CHAN":
        width, height, web, flange = dimensions
        inside = (z >= 0) & (z <= width) & (y >= 0) & (y <= height)
        return inside & ((z <= web) | (y <= flange) | (y >= height - flange))
    height, wall, width, lip = dimensions
    top = (abs(z) <= width / 2) & (y >= height - wall) & (y <= height)
    webs = (abs(z) <= width / 2) & (abs(z) >= width / 2 - wall) & (y >= 0) & (y <= height)
    lips = (abs(z) >= width / 2 - wall) & (abs(z) <= width / 2 + lip) & (y >= 0) & (y <= wall)
    return top | webs | lips


@pytest.mark.parametrize("shape", SHAPES)
def test_area_and_second_moments_are_those_of_the_picture(shape):
    dimensions = EXAMPLES[shape]
    # midpoint rule on a grid whose points miss all edges; walls are 25 cells thick or more
    axis = (np.arange(3000) + 0.5) / 3000 * 0.2401237 - 0.12003
    y, z = np.meshgrid(axis, axis, indexing="ij")
    inside = filled(shape, dimensions, y, z)
    cell = (axis[1] - axis[0]) ** 2
    area = inside.sum() * cell
    centre_y, centre_z = y[inside].mean(), z[inside].mean()
    section = section_property(1, 1, shape, dimensions)
    assert section.area == pytest.approx(area, rel=0.02)
    assert section.inertia_1 == pytest.approx(((y[inside] - centre_y) ** 2).sum() * cell, rel=0.02)
    assert section.inertia_2 == pytest.approx(((z[inside] - centre_z) ** 2).sum() * cell, rel=0.02)
    assert section.stress_points[:, 0].max() == pytest.approx(y[inside].max() - centre_y, abs=2e-4)
    assert section.stress_points[:, 0].min() == pytest.approx(y[inside].min() - centre_y, abs=2e-4)
    assert section.stress_points[:, 1].max() == pytest.approx(z[inside].max() - centre_z, abs=2e-4)
    assert section.stress_points[:, 1].min() == pytest.approx(z[inside].min() - centre_z, abs=2e-4)


def test_stress_points_of_a_bar_run_clockwise_from_upper_right():
    # C, D, E, F of the Quick Reference Guide, y up and z to the right
    points = section_property(1, 1, "BAR", [0.02, 0.06]).stress_points
    np.testing.assert_allclose(points, [[0.03, 0.01], [-0.03, 0.01], [-0.03, -0.01], [0.03, -0.01]])


def test_round_sections_have_polar_torsion():
    rod = section_property(1, 1, "ROD", [0.02])
    assert rod.torsion_constant == pytest.approx(math.pi / 2 * 0.02**4, rel=1e-15)
    tube = section_property(1, 1, "TUBE", [0.02, 0.018])
    assert tube.torsion_constant == pytest.approx(math.pi / 2 * (0.02**4 - 0.018**4), rel=1e-15)
    assert tube.torsion_radius == 0.02


@pytest.mark.parametrize(
    ("ratio", "constant", "stress"),
    [(1.0, 0.1406, 0.208), (1.5, 0.196, 0.231), (2.0, 0.229, 0.246), (4.0, 0.281, 0.282),
     (10.0, 0.312, 0.312)],
)  # fmt: skip
def test_rectangles_twist_as_tabulated(ratio, constant, stress):
    # Timoshenko & Goodier, article 109, table of J = k1 a b^3 and tau = T / (k2 a b^2)
    found, radius = rectangle_torsion(0.01 * ratio, 0.01)
    assert found / (0.01 * ratio * 0.01**3) == pytest.approx(constant, abs=6e-4)
    assert found / radius / (0.01 * ratio * 0.01**2) == pytest.approx(stress, abs=6e-4)
    assert rectangle_torsion(0.01, 0.01 * ratio) == (found, radius)


def test_a_thin_box_twists_by_bredt():
    # square tube, side a to the middle of its wall t: J = a^3 t, tau = T / (2 a^2 t)
    a, t = 0.1, 0.001
    box = section_property(1, 1, "BOX", [a + t, a + t, t, t])
    assert box.torsion_constant == pytest.approx(a**3 * t, rel=1e-12)
    assert box.torsion_constant / box.torsion_radius == pytest.approx(2 * a**2 * t, rel=1e-12)


def test_open_sections_twist_as_the_sum_of_their_strips():
    channel = section_property(1, 1, "CHAN", [0.05, 0.1, 0.002, 0.003])
    strips = (2 * 0.05 * 0.003**3 + (0.1 - 0.006) * 0.002**3) / 3
    assert channel.torsion_constant == pytest.approx(strips, rel=1e-12)
    assert channel.torsion_radius == 0.003


@pytest.mark.parametrize("shape", SHAPES)
def test_principal_axes_are_the_element_axes(shape):
    """Where points are mirrored, so is the section: no product of inertia."""
    points = section_property(1, 1, shape, EXAMPLES[shape]).stress_points
    mirrored = {tuple(np.round(point, 12)) for point in points * [1.0, -1.0]}
    mirrored_y = {tuple(np.round(point, 12)) for point in points * [-1.0, 1.0]}
    own = {tuple(np.round(point, 12)) for point in points}
    assert own in (mirrored, mirrored_y)


def test_pbarl_reads_dimensions_and_nonstructural_mass():
    deck = "GRID,1\nMAT1,1,7.+10,,.3\nPBARL,4,1,,HAT\n,.04,.002,.05,.02,.75"
    section = parse_bulk_data(deck).model.beam_properties[4]
    assert (section.shape, section.dimensions) == ("HAT", (0.04, 0.002, 0.05, 0.02))
    assert section.nonstructural_mass == 0.75


@pytest.mark.parametrize(
    ("shape", "dimensions"),
    [
        ("BOX", [0.1, 0.1, 0.05, 0.01]), ("I", [0.01, 0.1, 0.1, 0.01, 0.005, 0.005]),
        ("T", [0.1, 0.01, 0.01, 0.01]), ("CHAN", [0.1, 0.01, 0.01, 0.005]),
        ("HAT", [0.01, 0.005, 0.05, 0.01]), ("TUBE", [0.1, 0.1]), ("BAR", [0.1, math.nan]),
    ],
)  # fmt: skip
def test_dimensions_that_close_no_section_are_refused(shape, dimensions):
    with pytest.raises(ModelError, match=shape):
        section_property(1, 1, shape, dimensions)
