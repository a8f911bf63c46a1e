"""The same cards in every field format give the same model."""

import numpy as np
import pytest

from solver.aircraft.nastran import parse_bulk_data
from solver.aircraft.nastran_cards import Card, read_cards
from solver.errors import ModelError

BAR_NODES = """\
GRID,1,,0.,0.,0.
GRID,2,,2.,0.,0.
GRID,3,,0.,0.,1.
MAT1,1,7.+10,,.3,2800.
PBAR,5,1,1.-4,2.-8,3.-8,4.-8
"""


def only(text: str) -> Card:
    (card,) = read_cards(text, "deck")
    return card


class TestFieldFormats:
    def test_small_field_takes_eight_characters_each(self):
        card = only("GRID          10       2     1.5    -2.5    1.+2                            ")
        assert (card.integer(0, "ID"), card.integer(1, "CP")) == (10, 2)
        assert card.vector(2, ("X1", "X2", "X3")) == (1.5, -2.5, 100.0)

    def test_small_fields_may_touch(self):
        # columns of a public deck: "-2.0669-2.18802  7.3152"
        card = only("GRID          27         -2.0669-2.18802  7.3152")
        assert card.vector(2, ("X1", "X2", "X3")) == (-2.0669, -2.18802, 7.3152)

    def test_large_field_takes_sixteen_characters_and_continues(self):
        lines = [
            f"{'GRID*':8}{'10':>16}{'':16}{'1.2345678901234':>16}{'-2.5':>16}{'*A':8}",
            f"{'*A':8}{'.125':>16}",
        ]
        card = only("\n".join(lines))
        assert card.vector(2, ("X1", "X2", "X3")) == (1.2345678901234, -2.5, 0.125)

    def test_free_field_is_separated_by_commas(self):
        card = only("grid, 10 ,, 1.5,-2.5 , 1.+2")
        assert card.vector(2, ("X1", "X2", "X3")) == (1.5, -2.5, 100.0)

    def test_free_large_field_holds_four_fields_a_line(self):
        card = only("GRID*,10,,1.5,-2.5,+\n*,7.25")
        assert card.vector(2, ("X1", "X2", "X3")) == (1.5, -2.5, 7.25)

    def test_a_tab_stands_for_blanks_up_to_the_next_field(self):
        card = only("GRID\t10\t\t1.5\t-2.5\t1.0")
        assert card.vector(2, ("X1", "X2", "X3")) == (1.5, -2.5, 1.0)

    @pytest.mark.parametrize(
        "text",
        [
            "RBE2           1       2  123456       3       4       5       6       7\n"
            "               8       9",
            "RBE2           1       2  123456       3       4       5       6       7+R1\n"
            "+R1            8       9",
            "RBE2,1,2,123456,3,4,5,6,7\n,8,9",
            "RBE2,1,2,123456,3,4,5,6,7,+X\n+X,8,9",
            "RBE2*                  1               2          123456               3\n"
            "*                      4               5               6               7\n"
            "*                      8               9",
            "RBE2           1       2  123456       3       4       5       6       7\n"
            "*                      8               9",
        ],
    )
    def test_continuations_are_automatic_named_or_mixed(self, text):
        assert [field for field in only(text).fields if field] == [
            "1", "2", "123456", *"3456789",
        ]  # fmt: skip

    def test_half_of_a_large_field_pair_is_filled_up_before_a_small_line(self):
        text = f"{'PBAR*':8}{'5':>16}{'1':>16}{'1.':>16}{'2.':>16}\n{'':8}{'9.5':>8}"
        assert only(text).real(8, "C1") == 9.5

    def test_comments_and_blank_lines_are_no_cards(self):
        cards = list(read_cards("$ title\n\nGRID,1,,0.,0.,0. $ here\n   \n$\nGRID,2", "deck"))
        assert [(card.line, card.text(0)) for card in cards] == [(3, "1"), (6, "2")]
        assert cards[0].text(4) == "0."


class TestNumbers:
    @pytest.mark.parametrize(
        ("text", "value"),
        [
            ("1.", 1.0), (".5", 0.5), ("-.5", -0.5), ("+1.5", 1.5), ("1.5-3", 1.5e-3),
            ("1.5+3", 1.5e3), ("7.59-16", 7.59e-16), ("1.5E-3", 1.5e-3), ("1.5e3", 1.5e3),
            ("1.5D+2", 1.5e2), ("0.0", 0.0), ("-7.0D-1", -0.7),
        ],
    )  # fmt: skip
    def test_every_nastran_real_is_read(self, text, value):
        assert only(f"GRID,1,,{text}").real(2, "X1") == value

    @pytest.mark.parametrize(
        "text", ["1", "1e5", "1.5.2", "1. 5", "1_0.", "nan", "inf", "x", "1.5E", "1.E999", "--1."]
    )
    def test_what_is_no_real_is_refused_with_line_and_field(self, text):
        with pytest.raises(ModelError, match=r"deck line 1: GRID 1: field X1: .* (real|large)"):
            only(f"GRID,1,,{text}").real(2, "X1")

    @pytest.mark.parametrize("text", ["1.", "-3", "0", "12x", "123456789"])
    def test_what_is_no_identifier_is_refused(self, text):
        with pytest.raises(ModelError, match="field PID"):
            only(f"CQUAD4,1,{text}").integer(1, "PID")


class TestSections:
    def test_executive_and_case_control_are_skipped(self):
        deck = f"SOL 101\nCEND\nTITLE = GRID,7,,x\nBEGIN BULK\n{BAR_NODES}ENDDATA\nGRID,9,,x\n"
        assert parse_bulk_data(deck).model.node_identifiers.tolist() == [1, 2, 3]

    def test_a_punch_file_without_begin_is_all_bulk_data(self):
        assert parse_bulk_data(BAR_NODES).model.node_count == 3

    def test_harmless_parameters_are_passed_over_and_listed(self):
        deck = parse_bulk_data("PARAM,POST,-1\nPARAM,WTMASS,1.\n" + BAR_NODES)
        assert deck.ignored_parameters == ("POST (line 1)", "WTMASS (line 2)")

    def test_nodes_are_sorted_by_number(self):
        model = parse_bulk_data("GRID,20,,2.,0.,0.\nGRID,10,,1.,0.,0.").model
        assert model.node_identifiers.tolist() == [10, 20]
        np.testing.assert_array_equal(model.coordinates[:, 0], [1.0, 2.0])


class TestCoordinateSystems:
    def test_chained_systems_carry_nodes_to_basic_axes(self):
        # 5 has its origin at (1, 0, 0), z along basic x and x along basic y; 6 sits in 5, moved by
        # 2 along its z: a point at local (1, 0, 3) of 6 is basic (1 + 2 + 3, 1, 0)
        deck = (
            "CORD2R,6,5,0.,0.,2.,0.,0.,3.\n,1.,0.,2.\n"
            "CORD2R,5,0,1.,0.,0.,2.,0.,0.\n,1.,1.,0.\n"
            "GRID,1,6,1.,0.,3.\n"
        )
        np.testing.assert_allclose(
            parse_bulk_data(deck).model.coordinates, [[6.0, 1.0, 0.0]], atol=1e-15
        )

    def test_a_lumped_mass_is_turned_from_its_own_axes(self):
        # local x is basic y, local y is basic -x, local z is basic z
        deck = (
            "CORD2R,3,0,0.,0.,0.,0.,0.,1.\n,0.,1.,0.\nGRID,1,,0.,0.,0.\n"
            "CONM2,9,1,3,2.,.5,.25,0.,,\n,4.,.5,6.,,,7.\n"
        )
        masses = parse_bulk_data(deck).model.point_masses
        np.testing.assert_allclose(masses.offsets, [[-0.25, 0.5, 0.0]], atol=1e-15)
        # tensor in local axes [[4, -.5, 0], [-.5, 6, 0], [0, 0, 7]], turned by hand
        np.testing.assert_allclose(
            masses.inertias[0], [[6.0, 0.5, 0.0], [0.5, 4.0, 0.0], [0.0, 0.0, 7.0]], atol=1e-14
        )

    @pytest.mark.parametrize(
        ("deck", "message"),
        [
            ("CORD2R,5,6,0.,0.,0.,0.,0.,1.\n,1.,0.,0.", "RID = 6 is missing"),
            ("CORD2R,5,5,0.,0.,0.,0.,0.,1.\n,1.,0.,0.", "leads back to 5"),
            ("CORD2R,5,0,0.,0.,0.,0.,0.,1.\n,0.,0.,2.", "one line"),
            ("GRID,2,4,0.,0.,0.", "CP = 4: this CORD2R is missing"),
        ],
    )
    def test_a_system_that_cannot_be_built_is_refused(self, deck, message):
        with pytest.raises(ModelError, match=message):
            parse_bulk_data("GRID,1,,0.,0.,0.\n" + deck)


class TestElements:
    def test_bar_orientation_by_node_is_the_vector_from_end_a(self):
        by_node = parse_bulk_data(BAR_NODES + "CBAR,1,5,2,1,3").model.beams
        np.testing.assert_array_equal(by_node.orientations, [[-2.0, 0.0, 1.0]])

    def test_bar_offsets_run_from_node_to_end(self):
        beams = parse_bulk_data(
            BAR_NODES + "CBAR,1,5,1,2,0.,0.,1.,GGG\n,,,.1,.2,.3,-.1,-.2,-.3"
        ).model.beams
        np.testing.assert_array_equal(beams.offsets, [[[0.1, 0.2, 0.3], [-0.1, -0.2, -0.3]]])

    def test_products_of_inertia_enter_the_tensor_with_the_other_sign(self):
        # Two half masses at +-(1, 2, 3): I21 = integral x1 x2 dm = 2 and so on, and the tensor
        # is the integral of r2 I - r r'
        place = np.array([1.0, 2.0, 3.0])
        tensor = place @ place * np.eye(3) - np.outer(place, place)
        deck = BAR_NODES + "CONM2,1,1,0,1.\n,13.,2.,10.,3.,6.,5."
        np.testing.assert_array_equal(parse_bulk_data(deck).model.point_masses.inertias[0], tensor)

    def test_mean_motion_weights_follow_their_groups(self):
        deck = BAR_NODES + "GRID,4,,1.,1.,0.\nRBE3,1,,4,123456,1.,123,1,2\n,2.5,123,3"
        (mean,) = parse_bulk_data(deck).model.interpolations
        assert (mean.reference, mean.nodes.tolist(), mean.weights.tolist()) == (
            3, [0, 1, 2], [1.0, 1.0, 2.5],
        )  # fmt: skip

    def test_two_elastic_constants_give_the_third(self):
        decks = ("MAT1,1,7.8,3.,,2.", "MAT1,1,7.8,,.3,2.", "MAT1,1,,3.,.3,2.")
        for deck in decks:
            material = parse_bulk_data("GRID,1\n" + deck).model.materials[1]
            assert (material.young_modulus, material.shear_modulus, material.poisson_ratio) == (
                pytest.approx((7.8, 3.0, 0.3), rel=1e-15)
            )
