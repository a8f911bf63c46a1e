"""Properties, gauges and damping derivatives of the example aircraft."""

import math
from pathlib import Path

import numpy as np
import pytest

from solver.aircraft.bizjet import dimensions as dim
from solver.aircraft.bizjet.aerodynamics import FIN_CENTRE, damping, lift_slope, weathercock
from solver.aircraft.bizjet.catalogue import (
    Bay,
    Catalogue,
    beam_property,
    read_gauges,
    write_gauges,
)
from solver.aircraft.bizjet.families import FAMILIES, FAMILY, MATERIALS
from solver.aircraft.bizjet.loading import REFERENCE_CENTRE

STRINGER = FAMILY["wing stringers"]


@pytest.mark.parametrize("share", [0.4, 1.0, 2.0, 5.0])
def test_beam_section_has_its_area_and_depth(share: float) -> None:
    area = share * STRINGER.gauge
    section = beam_property(7, STRINGER, area)
    assert section.area == pytest.approx(area, rel=1e-3)
    depth = np.ptp(section.stress_points[:, 0])
    if share < 2.2:
        assert depth == pytest.approx(STRINGER.depth, rel=1e-4)
    else:
        assert depth > STRINGER.depth
    # An I is stiffer than a solid square of its area, and softer than all of it at its flanges.
    assert area**2 / 12 < section.inertia_1 < area * depth**2 / 4


def test_port_and_starboard_share_a_gauge_but_not_a_property() -> None:
    catalogue = Catalogue({Bay("wing ribs", "a"): 2e-3})
    sides = [catalogue.property("wing ribs", "a", np.array([9.0, y, 1.0])) for y in (-2, 0, 2)]
    assert len(set(sides)) == 3
    shells = catalogue.shell_properties()
    assert {shells[number].thickness for number in sides} == {2e-3}
    assert [side for _, side in catalogue.zone_ranges()] == ["centre", "port", "starboard"]


def test_gauges_survive_the_table(tmp_path: Path) -> None:
    gauges = {
        Bay("wing ribs", "strip 03 rear"): 1.35e-3,
        Bay("wing stringers", "upper strip 01 front"): 142e-6,
        Bay("cabin floor", "station 08"): 1.2e-3,
    }
    path = tmp_path / "sized.toml"
    write_gauges(gauges, path)
    assert read_gauges(path) == pytest.approx(gauges)
    assert read_gauges(tmp_path / "absent.toml") == {}


def test_sized_gauges_keep_to_their_minimum() -> None:
    sized = read_gauges()
    assert sized
    for bay, gauge in sized.items():
        assert gauge >= FAMILY[bay.family].minimum - 1e-9


def test_allowables_stay_below_the_alloys() -> None:
    limits = {material.identifier: limit for _, material, limit in MATERIALS}
    for family in FAMILIES:
        assert 0 < family.allowable <= limits[family.material]


def test_lift_slope_has_its_known_limits() -> None:
    # Two-dimensional: 2 pi; slender wing (R. T. Jones): pi A / 2.
    assert lift_slope(1e6, 0.0) == pytest.approx(2 * math.pi, rel=1e-5)
    assert lift_slope(1e-3, 0.0) == pytest.approx(math.pi / 2 * 1e-3, rel=1e-3)


def test_roll_damping_is_strip_theory_of_the_trapezoid() -> None:
    # Integral of c y^2 over the half span, chord linear: h^3 (c_root / 12 + c_tip / 4).
    span, area = dim.WING_SPAN, dim.WING_AREA
    integral = dim.HALF_SPAN**3 * (dim.WING_ROOT_CHORD / 12 + dim.WING_TIP_CHORD / 4)
    root = dim.WING_APEX + dim.WING_ROOT_CHORD / 2
    tip = dim.WING_APEX + dim.HALF_SPAN * math.tan(dim.WING_SWEEP) + dim.WING_TIP_CHORD / 2
    slope = lift_slope(span**2 / area, math.atan2(tip - root, dim.HALF_SPAN))
    assert damping().roll == pytest.approx(-4 * slope * integral / (area * span**2), abs=1e-4)
    # Textbook sizes of transport aircraft.
    assert -1.0 < damping().roll < -0.3
    assert -30.0 < damping().pitch < -8.0
    assert -0.3 < damping().yaw < -0.03


def test_yaw_damping_and_weathercock_stability_come_from_one_fin() -> None:
    """Both are the fin's side force on its lever: C_nr = -2 (l / b) C_n_beta."""
    lever = FIN_CENTRE[0] - REFERENCE_CENTRE[0]
    assert damping().yaw == pytest.approx(-2 * lever / dim.WING_SPAN * weathercock(), abs=2e-4)
