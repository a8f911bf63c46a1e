"""The drawn fleet stands for service: weights, densities, and the facts it is made after."""

import numpy as np
import pytest
from scipy.integrate import quad

from verification.judging.population import FEET_PER_MINUTE, KINDS, DrawnLanding, draw_landing


@pytest.fixture(scope="module")
def fleet() -> list[DrawnLanding]:
    return [draw_landing(number, 11) for number in range(3000)]


def test_shares_add_up_to_all_landings() -> None:
    assert sum(kind.share for kind in KINDS) == pytest.approx(1.0)
    assert sum(kind.flown for kind in KINDS) == pytest.approx(1.0)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_densities_integrate_to_one(kind: object) -> None:
    for rates in (kind.service, kind.enriched):  # type: ignore[attr-defined]
        total, _ = quad(rates.density, rates.least, rates.most, limit=200)
        assert total == pytest.approx(1.0, abs=1e-6)


def test_weights_add_up_to_the_shares_of_service(fleet: list[DrawnLanding]) -> None:
    """Mean weight 1, and of each kind its share: what importance sampling promises."""
    total = sum(each.weight for each in fleet) / len(fleet)
    assert total == pytest.approx(1.0, abs=0.05)
    for kind in KINDS:
        share = sum(each.weight for each in fleet if each.kind == kind.name) / len(fleet)
        assert share == pytest.approx(kind.share, rel=0.15)


def test_ordinary_landings_have_the_mean_and_spread_of_the_airliner_fleet(
    fleet: list[DrawnLanding],
) -> None:
    """1,218 landings: mean 126 ft/min, standard deviation 68."""
    ordinary = [each for each in fleet if each.kind == "ordinary"]
    weights = np.array([each.weight for each in ordinary])
    sinks = np.array([each.contact.sink_rate for each in ordinary]) / FEET_PER_MINUTE
    mean = np.average(sinks, weights=weights)
    sd = np.sqrt(np.average((sinks - mean) ** 2, weights=weights))
    assert mean == pytest.approx(126.0, rel=0.05)
    assert sd == pytest.approx(68.0, rel=0.08)


def test_many_landings_are_flown_near_the_limit(fleet: list[DrawnLanding]) -> None:
    """In service less than one in a hundred is above 2.4 m/s; here more than one in five."""
    near = [each for each in fleet if each.contact.sink_rate > 2.4]
    assert len(near) > 0.2 * len(fleet)
    assert sum(each.weight for each in near) < 0.01 * len(fleet)


def test_nose_first_landings_are_nose_down(fleet: list[DrawnLanding]) -> None:
    assert all(each.contact.pitch < 0.0 for each in fleet if each.kind == "nose first")


def test_a_number_and_a_seed_give_one_landing() -> None:
    assert draw_landing(5, 1) == draw_landing(5, 1)
    assert draw_landing(5, 1) != draw_landing(5, 2)
