"""The loading solver: what a record states is kept, the rest is found or refused."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.aircraft.loading import balance, spread
from solver.errors import RecordError

EMPTY, TANK, BAY = 8235.0, 2545.5, 1200.0


class TestFillFactors:
    def test_stated_masses_are_shares_of_the_capacity_and_the_rest_is_default(self, mini):
        factors = mini.fill_factors({"wing_left": TANK}, {"cabin": 300.0})
        np.testing.assert_allclose(factors, [1.0, 0.6, 0.25], rtol=1e-12)

    @pytest.mark.parametrize(
        ("fuel", "payload", "message"),
        [
            ({"wing_left": 2546.0}, {}, r"fuel\.wing_left = 2546\.0 kg is outside 0 to 2545\.5 kg"),
            ({"wing_left": -1.0}, {}, r"fuel\.wing_left = -1\.0 kg is outside"),
            ({"wing_left": float("nan")}, {}, r"fuel\.wing_left = nan kg is outside"),
            ({"centre": 1.0}, {}, r"fuel\.centre: unknown; .* has wing_left, wing_right"),
            ({}, {"cabin": 1200.5}, r"payload\.cabin = 1200\.5 kg is outside 0 to 1200 kg"),
            ({}, {"wing_left": 1.0}, r"payload\.wing_left: unknown; this aircraft has cabin"),
        ],
    )  # fmt: skip
    def test_impossible_masses_are_refused(self, mini, fuel, payload, message):
        with pytest.raises(RecordError, match=message):
            mini.fill_factors(fuel, payload)


class TestLoadingForARecord:
    def test_nothing_stated_gives_the_defaults_and_says_so(self, mini):
        loading = mini.loading_for()
        np.testing.assert_allclose(loading.factors, [0.6, 0.6, 0.5], rtol=1e-12)
        assert loading.mass == pytest.approx(EMPTY + 1.2 * TANK + 0.5 * BAY, rel=1e-9)
        assert len(loading.notes) == 2

    def test_gross_mass_alone_is_met_by_payload_at_default_fuel(self, mini):
        loading = mini.loading_for(mass=12000.0)
        assert loading.mass == pytest.approx(12000.0, rel=1e-12)
        assert loading.fuel["wing_left"] == pytest.approx(0.6 * TANK)
        assert loading.payload["cabin"] == pytest.approx(12000.0 - EMPTY - 1.2 * TANK, rel=1e-6)

    def test_what_the_bays_cannot_hold_goes_to_the_tanks_alike(self, mini):
        loading = mini.loading_for(mass=13500.0)
        assert loading.payload["cabin"] == pytest.approx(BAY)
        fuel = (13500.0 - EMPTY - BAY) / 2
        assert list(loading.fuel.values()) == pytest.approx([fuel, fuel], rel=1e-6)

    def test_stated_fuel_is_never_changed(self, mini):
        fuel = {"wing_left": 700.0, "wing_right": 900.0}
        loading = mini.loading_for(mass=10500.0, fuel=fuel)
        assert loading.fuel == pytest.approx(fuel)
        assert loading.payload["cabin"] == pytest.approx(10500.0 - EMPTY - 1600.0, rel=1e-6)

    def test_stated_payload_leaves_the_difference_to_the_tanks(self, mini):
        loading = mini.loading_for(mass=11000.0, payload={"cabin": 200.0})
        assert loading.payload["cabin"] == pytest.approx(200.0)
        assert sum(loading.fuel.values()) == pytest.approx(11000.0 - EMPTY - 200.0, rel=1e-6)

    def test_a_small_disagreement_is_noted_and_the_sum_is_used(self, mini):
        stated = {"wing_left": 1000.0, "wing_right": 1000.0}
        loading = mini.loading_for(mass=10700.0, fuel=stated, payload={"cabin": 400.0})
        assert loading.mass == pytest.approx(10635.0, rel=1e-9)
        assert any("differs by +65 kg" in note for note in loading.notes)

    @pytest.mark.parametrize(
        ("arguments", "weighs"),
        [
            ({"mass": 20000.0}, "8235 to 14526 kg"),
            ({"mass": 7000.0}, "8235 to 14526 kg"),
            ({"mass": float("nan")}, "kg"),
            ({"mass": 12000.0, "fuel": {"wing_left": 0.0, "wing_right": 0.0}}, "8235 to 9435 kg"),
            (
                {
                    "mass": 12000.0,
                    "fuel": {"wing_left": 0.0, "wing_right": 0.0},
                    "payload": {"cabin": 100.0},
                },
                "8335 kg",
            ),
        ],
    )
    def test_a_mass_out_of_reach_is_refused_with_the_range(self, mini, arguments, weighs):
        with pytest.raises(RecordError, match=f"mass = .* cannot be met: .*{weighs}"):
            mini.loading_for(**arguments)

    def test_a_stated_centre_of_gravity_is_met_by_shifting_payload_against_fuel(self, mini):
        before = mini.loading_for(mass=12000.0)
        wanted = float(before.centre_of_gravity[0]) + 0.03
        loading = mini.loading_for(mass=12000.0, centre_of_gravity=wanted)
        assert loading.mass == pytest.approx(12000.0, rel=1e-12)
        assert loading.centre_of_gravity[0] == pytest.approx(wanted, abs=1e-9)
        # the cabin is ahead of the tanks: moving aft takes payload and adds fuel, both wings alike
        assert loading.payload["cabin"] < before.payload["cabin"]
        assert loading.fuel["wing_left"] == pytest.approx(loading.fuel["wing_right"], rel=1e-12)
        assert not any("centre of gravity" in note for note in loading.notes)

    def test_a_centre_of_gravity_out_of_reach_is_noted_with_both_figures(self, mini):
        loading = mini.loading_for(
            mass=12000.0, centre_of_gravity=9.5, fuel={"wing_left": 1500.0, "wing_right": 1500.0}
        )
        assert loading.fuel == {"wing_left": pytest.approx(1500), "wing_right": pytest.approx(1500)}
        assert any("9.500 m (10.0 % MAC) cannot be met" in note for note in loading.notes)

    def test_a_centre_of_gravity_that_agrees_is_not_mentioned(self, mini):
        found = float(mini.loading_for(mass=12000.0).centre_of_gravity[0])
        notes = mini.loading_for(mass=12000.0, centre_of_gravity=found).notes
        assert not any("centre of gravity" in note for note in notes)


MASSES = st.lists(st.floats(0.0, 100.0), min_size=4, max_size=4).map(np.array)
CAPACITIES = np.array([100.0, 100.0, 150.0, 120.0])
FREE = st.lists(st.booleans(), min_size=4, max_size=4).map(np.array)


class TestSpread:
    @settings(deadline=None)
    @given(MASSES, FREE, st.floats(-600.0, 600.0))
    def test_mass_is_conserved_within_bounds_and_fixed_groups_stay(self, masses, free, amount):
        after, left = spread(amount, masses, CAPACITIES, free)
        assert after.sum() + left == pytest.approx(masses.sum() + amount, abs=1e-9)
        assert np.all(after >= -1e-9)
        assert np.all(after <= CAPACITIES + 1e-9)
        np.testing.assert_array_equal(after[~free], masses[~free])
        room = CAPACITIES - after if left > 0 else after
        assert abs(left) < 1e-9 or np.all(room[free] < 1e-9)


class TestBalance:
    STATIONS = np.array([2.0, 5.0, 9.0, 12.0])

    @settings(deadline=None)
    @given(MASSES, FREE, st.floats(-3000.0, 3000.0))
    def test_total_is_kept_within_bounds_and_the_moment_never_overshoots(
        self, masses, free, moment
    ):
        after = balance(masses, CAPACITIES, self.STATIONS, free, moment)
        assert after.sum() == pytest.approx(masses.sum(), abs=1e-9)
        assert np.all((after >= 0.0) & (after <= CAPACITIES))
        np.testing.assert_array_equal(after[~free], masses[~free])
        gained = (after - masses) @ self.STATIONS
        assert min(0.0, moment) - 1e-9 <= gained <= max(0.0, moment) + 1e-9

    def test_a_moment_within_reach_is_met_with_the_least_shift(self):
        masses = np.full(4, 50.0)
        after = balance(masses, CAPACITIES, self.STATIONS, np.ones(4, dtype=bool), 100.0)
        # least norm with sum 0 and given moment: proportional to the lever about the mean station
        lever = self.STATIONS - 7.0
        np.testing.assert_allclose(after - masses, lever * 100.0 / (lever @ lever), rtol=1e-12)

    def test_a_group_at_its_bound_leaves_the_rest_to_the_others(self):
        masses = np.array([0.5, 50.0, 50.0, 50.0])
        after = balance(masses, CAPACITIES, self.STATIONS, np.ones(4, dtype=bool), 200.0)
        assert (after - masses) @ self.STATIONS == pytest.approx(200.0)
        assert after[0] == 0.0
