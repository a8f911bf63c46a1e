"""Every limit that makers published, as the rules of the package give it back.

Boeing: FlightDataAnalyzer, LoadFactorThresholdAtTouchdown (github.com/geolffrey/FlightDataAnalyzer
at d089550), whose curves are arrays over whole degrees of roll: flat to 2 degrees (overweight to
1), then equal steps to 6.  Airbus: aviationhunt.com/airbus-a320-ata-05; severe: Flight Global,
8 October 2019.  Embraer: AMM 2134, task 200-802-A/600, as in FlightDataAnalyzer.  Gulfstream: G550
operating manual 2A-31-100, page 61.
"""

import itertools
import math

import pytest

from solver.assessment import Verdict
from solver.verdict.makers_rule_reader import packaged_rule, packaged_rules
from tests.solver.verdict.rule_cases import (
    CANNOT_TELL,
    EXCEEDED,
    LANDING_MASS,
    PASSED,
    POUND,
    contact,
    finding,
    held,
)

OVER = 1.2 * LANDING_MASS
NZ = "normal load factor"

#: rule, rate [Hz], overweight, limits [g] at 0, 1, 2, ... degrees of roll
BOEING = [
    ("boeing-737", 16, False, [2.20, 2.20, 2.20, 2.05, 1.90, 1.75, 1.60]),
    ("boeing-737", 8, False, [2.10, 2.10, 2.10, 1.9625, 1.825, 1.6875, 1.55]),
    ("boeing-737", 16, True, [1.85, 1.85, 1.766, 1.682, 1.598, 1.514, 1.43]),
    ("boeing-737", 8, True, [1.80, 1.80, 1.72, 1.64, 1.56, 1.48, 1.40]),
    ("boeing-757", 16, False, [1.90, 1.90, 1.90, 1.7875, 1.675, 1.5625, 1.45]),
    ("boeing-757", 8, False, [1.80, 1.80, 1.80, 1.70, 1.60, 1.50, 1.40]),
    ("boeing-757", 16, True, [1.55, 1.55, 1.498, 1.446, 1.394, 1.342, 1.29]),
    ("boeing-757", 8, True, [1.50, 1.50, 1.45, 1.40, 1.35, 1.30, 1.25]),
    ("boeing-767", 16, False, [1.90, 1.90, 1.90, 1.7875, 1.675, 1.5625, 1.45]),
    ("boeing-767", 8, False, [1.80, 1.80, 1.80, 1.70, 1.60, 1.50, 1.40]),
    ("boeing-767", 16, True, [1.55, 1.55, 1.498, 1.446, 1.394, 1.342, 1.29]),
    ("boeing-767", 8, True, [1.50, 1.50, 1.45, 1.40, 1.35, 1.30, 1.25]),
    ("boeing-777", 16, False, [2.10, 2.10, 2.10, 1.9625, 1.825, 1.6875, 1.55, 1.55, 1.55]),
    ("boeing-777", 8, False, [1.90, 1.90, 1.90, 1.7875, 1.675, 1.5625, 1.45, 1.45, 1.45]),
    ("boeing-777", 16, True, [1.70, 1.70, 1.63, 1.56, 1.49, 1.42, 1.35, 1.35, 1.35]),
    ("boeing-777", 8, True, [1.55, 1.55, 1.496, 1.442, 1.388, 1.334, 1.28, 1.28, 1.28]),
]


class TestBoeing:
    @pytest.mark.parametrize(("rule", "rate", "is_overweight", "limits"), BOEING)
    def test_every_point_of_every_curve(
        self, rule: str, rate: float, is_overweight: bool, limits: list[float]
    ) -> None:
        mass = OVER if is_overweight else LANDING_MASS
        for roll, limit in enumerate(limits):
            for side in (roll, -roll):
                at, above = (
                    held(rule, contact(nz, rate, roll=side), mass=mass)
                    for nz in (limit, limit + 0.001)
                )
                assert at.findings[0].limit == pytest.approx(limit)
                assert (at.status, above.status) == (PASSED, EXCEEDED)
                assert (at.verdict, above.verdict) == (Verdict.NORMAL, Verdict.INSPECT)

    @pytest.mark.parametrize(("rule", "rate", "is_overweight", "limits"), BOEING)
    def test_halfway_between_points(
        self, rule: str, rate: float, is_overweight: bool, limits: list[float]
    ) -> None:
        mass = OVER if is_overweight else LANDING_MASS
        for roll, (left, right) in enumerate(itertools.pairwise(limits)):
            verdict = held(rule, contact(1.0, rate, roll=roll + 0.5), mass=mass)
            assert verdict.findings[0].limit == pytest.approx((left + right) / 2)

    @pytest.mark.parametrize(
        ("rule", "last"),
        [("boeing-737", 6), ("boeing-757", 6), ("boeing-767", 6), ("boeing-777", 8)],
    )
    def test_beyond_the_last_roll_the_limit_is_zero(self, rule: str, last: float) -> None:
        for nz in (1.05, None):
            beyond = held(rule, contact(nz, roll=last + 0.1))
            assert beyond.status is EXCEEDED
            assert beyond.verdict is Verdict.INSPECT
            assert beyond.findings[0].limit == 0.0
            assert "whatever was recorded" in beyond.findings[0].text
        assert held(rule, contact(1.05, roll=last)).status is PASSED

    @pytest.mark.parametrize(
        ("rule", "margin"),
        [
            ("boeing-737", 1000 * POUND),
            ("boeing-757", 2500 * POUND),
            ("boeing-767", 2500 * POUND),
            ("boeing-777", 1800.0),
        ],
    )
    def test_the_weight_margin_still_counts_as_landing_mass(self, rule: str, margin: float) -> None:
        within = held(rule, contact(1.0), mass=LANDING_MASS + margin)
        beyond = held(rule, contact(1.0), mass=LANDING_MASS + margin + 50.0)
        assert within.findings[0].limit > beyond.findings[0].limit

    def test_the_landing_at_narita_hangs_on_the_recorder(self) -> None:
        """ANA 956, JA610A, 20 June 2012 (JTSB AA2016-6): 1.58, 1.72 and 1.82 g.

        The third peak is over the 767's limit for 8 Hz and under that for 16 Hz; the fuselage was
        wrinkled all round.
        """
        slow, fast = (
            held("boeing-767", *(contact(nz, hz) for nz in (1.58, 1.72, 1.82))) for hz in (8, 16)
        )
        assert [f.status for f in slow.findings] == [PASSED, PASSED, EXCEEDED]
        assert {f.limit for f in slow.findings} == {1.80}
        assert [f.status for f in fast.findings] == [PASSED] * 3
        assert {f.limit for f in fast.findings} == {1.90}
        assert (slow.verdict, fast.verdict) == (Verdict.INSPECT, Verdict.NORMAL)
        assert slow.findings[2].text == (
            "contact 3, normal load factor: 1.82 g at 8 Hz exceeds the limit of 1.8 g for 8 Hz "
            "(roll 0 deg, up to landing mass)"
        )

    def test_at_narita_the_nose_touched_first_where_no_limit_holds(self) -> None:
        """The makers' limits hold for a main gear first; the second contact was on the nose."""
        contacts = (contact(1.58), contact(1.72, nose_first=True), contact(1.82, nose_first=True))
        assert held("boeing-767", *contacts).status is CANNOT_TELL

    def test_at_houston_the_rule_is_blind(self) -> None:
        """United 767-300 N671UA, 29 July 2023: 1.4, 1.6 and 1.6 g, crown damage, nose first."""
        first = contact(1.4)
        others = (contact(1.6, nose_first=True), contact(1.6, nose_first=True))
        assert held("boeing-767", first, *others).status is CANNOT_TELL

    def test_at_exeter_it_is_not(self) -> None:
        """737-400F G-JMCY, 19 January 2021: 3.8 g, written off (b737.org.uk/incident_g-jmcy)."""
        assert held("boeing-737", contact(3.8, 8)).verdict is Verdict.INSPECT

    def test_rates_between_and_above(self) -> None:
        """The manuals say 'at least 8' and 'at least 16 samples per second'."""
        for rate, limit in ((8, 1.9), (10, 1.9), (15.9, 1.9), (16, 2.1), (64, 2.1)):
            assert held("boeing-777", contact(1.0, rate)).findings[0].limit == limit


class TestAirbus:
    RULE = "airbus-a320-classic"

    @pytest.mark.parametrize(("mass", "limit"), [(LANDING_MASS, 2.6), (OVER, 1.7)])
    def test_load_factor(self, mass: float, limit: float) -> None:
        for nz, status in ((limit, PASSED), (limit + 0.01, EXCEEDED)):
            found = finding(held(self.RULE, contact(nz, 8, sink_rate=1.0), mass=mass), NZ)
            assert (found.limit, found.status) == (limit, status)

    @pytest.mark.parametrize(("mass", "ft_min"), [(LANDING_MASS, 600), (OVER, 360)])
    def test_vertical_speed(self, mass: float, ft_min: float) -> None:
        for speed, status in ((ft_min, PASSED), (ft_min + 1, EXCEEDED)):
            sink_rate = speed * 0.3048 / 60
            verdict = held(self.RULE, contact(1.2, 8, sink_rate=sink_rate), mass=mass)
            assert finding(verdict, "vertical speed").status is status
            assert verdict.status is status
        assert f"{ft_min} ft/min" in finding(verdict, "vertical speed").text

    def test_severe(self) -> None:
        hard, severe = (held(self.RULE, contact(nz, 8, sink_rate=1.0)) for nz in (2.8, 2.9))
        assert (hard.verdict, severe.verdict) == (Verdict.INSPECT, Verdict.HARD)

    def test_a330_at_caracas(self) -> None:
        """2.74 g and 1,260 ft/min (Airbus Safety First): over both limits of the family."""
        verdict = held(self.RULE, contact(2.74, 8, sink_rate=1260 * 0.3048 / 60))
        assert [f.status for f in verdict.findings] == [EXCEEDED, EXCEEDED, PASSED]

    def test_a321_at_fuerteventura(self) -> None:
        """D-ASTP, 16 July 2016: 3.32 g (aerossurance.com, a320-flown-after-damage)."""
        assert held(self.RULE, contact(3.32, 8)).verdict is Verdict.HARD


class TestEmbraer:
    RULE = "embraer-170-175"

    @pytest.mark.parametrize(
        ("mass", "low", "high"),
        [
            (20_000, 2.20, 2.42),
            (22_500, 2.20, 2.42),
            (24_000, 2.10, 2.31),
            (25_500, 2.00, 2.20),
            (30_000, 2.00, 2.20),
            (34_000, 2.00, 2.20),
            (34_010, 1.75, 1.93),
            (38_000, 1.75, 1.93),
        ],
    )
    def test_both_levels_by_weight(self, mass: float, low: float, high: float) -> None:
        for nz, verdict in (
            (low, Verdict.NORMAL),
            (low + 0.01, Verdict.INSPECT),
            (high, Verdict.INSPECT),
            (high + 0.01, Verdict.HARD),
        ):
            told = held(self.RULE, contact(nz, 8, roll_rate=0.0), mass=mass)
            levels = [finding(told, f"{NZ}, {level} level") for level in ("low", "high")]
            assert [level.limit for level in levels] == pytest.approx([low, high])
            if mass >= 21_800:
                assert told.verdict is verdict

    @pytest.mark.parametrize(
        ("mass", "limit", "onset"),
        [(21_800, 12.4, 1.83), (30_295, 9.35, 1.515), (38_790, 6.3, 1.20)],
    )
    def test_roll_rate_counts_from_a_load_factor(
        self, mass: float, limit: float, onset: float
    ) -> None:
        """Ends of both lines as published, and their middle."""

        def told(rate: float, nz: float) -> object:
            rolling = contact(nz, 8, roll_rate=math.radians(rate))
            return finding(held(self.RULE, rolling, mass=mass), "roll rate").status

        assert told(limit + 0.1, onset) is EXCEEDED
        assert told(-limit - 0.1, onset) is EXCEEDED
        assert told(limit, onset) is PASSED
        assert told(limit + 0.1, onset - 0.01) is PASSED

    def test_roll_rate_is_not_published_beyond_its_weights(self) -> None:
        for mass in (21_000.0, 39_000.0):
            rolling = contact(1.9, 8, roll_rate=math.radians(20.0))
            found = finding(held(self.RULE, rolling, mass=mass), "roll rate")
            assert found.status is CANNOT_TELL
            assert "beyond what the rule covers" in found.text


class TestGulfstream:
    RULE, LANDING, TAKEOFF = "gulfstream-g550", 75_300 * POUND, 90_000 * POUND

    def told(self, nz: float, mass: float) -> object:
        return held(self.RULE, contact(nz, 8), mass=mass, maximum_landing=self.LANDING).status

    def test_up_to_the_landing_weight(self) -> None:
        """Rises from 2.0 to 2.15 g, from which weight on was not read."""
        for nz, status in (
            (2.0, PASSED),
            (2.1, CANNOT_TELL),
            (2.15, CANNOT_TELL),
            (2.16, EXCEEDED),
        ):
            assert self.told(nz, self.LANDING) is status

    @pytest.mark.parametrize(("share", "limit"), [(0.001, 2.14945), (0.5, 1.875), (1.0, 1.60)])
    def test_overweight(self, share: float, limit: float) -> None:
        mass = self.LANDING + share * (self.TAKEOFF - self.LANDING)
        assert self.told(limit - 0.001, mass) is PASSED
        assert self.told(limit + 0.001, mass) is EXCEEDED


def test_every_limit_names_its_source_and_certainty() -> None:
    assert set(packaged_rules()) == {
        "airbus-a320-classic", "boeing-737", "boeing-757", "boeing-767", "boeing-777",
        "ebj-19", "embraer-170-175", "gulfstream-g550",
    }  # fmt: skip
    for name in packaged_rules():
        for criterion in packaged_rule(name).criteria:
            for limit in criterion.limits:
                assert len(limit.source.text) > 20
                assert limit.source.certainty in ("read", "assumed")
