"""What the reader does not honour it refuses, by card, line and field; never a half-read model."""

from pathlib import Path

import pytest

from solver.aircraft.nastran import parse_bulk_data, read_bulk_data
from solver.errors import ModelError

#: Lines 1 to 9; a tested card starts at line 10.
SOUND = """\
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
MAT1,1,7.+10,,.3,2800.
PSHELL,1,1,.002,1,,1
PBAR,2,1,1.-4,2.-8,3.-8,4.-8
CQUAD4,1,1,1,2,3,4
CONM2,2,1,,5.
"""


def test_the_sound_deck_is_read():
    model = parse_bulk_data(SOUND).model
    assert (model.node_count, model.element_identifiers.tolist()) == (4, [1])


@pytest.mark.parametrize(
    "card",
    [
        "CQUAD8,5,1,1,2,3,4", "CTRIAR,5,1,1,2,3", "CBEAM,5,2,1,2,0.,0.,1.", "CROD,5,2,1,2",
        "CBUSH,5,2,1,2", "CELAS2,5,1.,1,1", "PCOMP,5", "PBEAM,5", "MAT2,5", "MAT8,5", "SPC1,5",
        "FORCE,5", "CORD2C,5", "GRDSET,,,,,,,123", "BAROR,,2", "ASET1,1,1", "MPC,5", "PARAM,G,.02",
        "PARAM,WTMASS,.00259", "SUPORT,1", "CONM1,5", "PLOTEL,5,1,2", "RBAR,5,1,2", "DMIG,K",
    ],
)  # fmt: skip
def test_a_card_that_is_not_supported_is_named_with_its_line(card):
    name = card.split(",")[0]
    with pytest.raises(ModelError, match=rf"^deck line 10: {name}.*(not supported|harmless)"):
        parse_bulk_data(SOUND + card, "deck")


@pytest.mark.parametrize(
    ("card", "message"),
    [
        ("GRID,9,,0.,0.,0.,7", "GRID 9: field CD = 7"),
        ("GRID,9,,0.,0.,0.,,123", "GRID 9: field PS = 123"),
        ("GRID,9,,0.,0.,0.,,,2", "GRID 9: field SEID = 2"),
        ("GRID,4,,0.,0.,0.", "GRID 4: is defined twice"),
        ("GRID,,,0.,0.,0.", "field ID is blank"),
        ("GRID,9,,0.,0.,0.\n,5", "unexpected '5' after field 9"),
        ("CQUAD4,2,1,1,2,3,4", "CONM2 2: its element number is used before"),
        ("CQUAD4,5,1,1,2,3,3", "CQUAD4 5: a node is repeated"),
        ("CQUAD4,5,1,1,2,3,9", "CQUAD4 5: names GRID 9, which is missing"),
        ("CQUAD4,5,8,1,2,3,4", "CQUAD4 5: names PSHELL 8, which is missing"),
        ("CQUAD4,5,2,1,2,3,4", "CQUAD4 5: names PSHELL 2, which is missing"),
        ("CQUAD4,5,1,1,2,3,4,0.,.01", "field ZOFFS = .01"),
        ("CQUAD4,5,1,1,2,3,4\n,,,.1", "unexpected '.1'"),
        ("CTRIA3,5,1,1,2,3,0.,.01", "field ZOFFS = .01"),
        ("CBAR,5,2,1,2", "CBAR 5: fields X1, X2, X3 are blank"),
        ("CBAR,5,2,1,2,1.,0.,0.", "CBAR 5: its orientation vector is zero or lies along"),
        ("CBAR,5,2,1,2,0.,0.,0.", "CBAR 5: its orientation vector is zero or lies along"),
        ("CBAR,5,2,1,1,0.,0.,1.", "CBAR 5: its ends coincide"),
        ("CBAR,5,2,1,2,0.,0.,1.,GGO", "field OFFT = 'GGO'"),
        ("CBAR,5,2,1,2,0.,0.,1.\n,45", "field PA = 45: released ends"),
        ("CBAR,5,1,1,2,0.,0.,1.", r"names PBAR\(L\) 1, which is missing"),
        ("CONM2,5,1,-1,2.", "field CID = -1"),
        ("CONM2,5,1,4,2.", "field CID = 4: this CORD2R is missing"),
        ("CONM2,5,1,,-2.", "field M = -2 must not be negative"),
        ("CONM2,5,1,,2.\n,1.,2.,1.", "negative principal value -1"),
        ("RBE2,5,1,123,2", "field CM = '123': only 123456"),
        ("RBE2,5,1,123456,1", "names a node twice"),
        ("RBE2,5,1,123456", "names no dependent node"),
        ("RBE2,5,1,123456,2,6.5-6", "'6.5-6' is not a whole number"),
        ("RBE3,5,,1,123,1.,123,2,3\n,4", "field REFC = '123'"),
        ("RBE3,5,,1,123456,1.,3,2,3\n,4", "field C = '3': only 123"),
        ("RBE3,5,,1,123456,1.,123,2,3", "at least three nodes, has 2"),
        ("RBE3,5,,1,123456,1.,123,2,3\n,4,UM,1,123", "UM is not supported"),
        ("RBE3,5,,1,123456,2,3,4", "names nodes before a weight"),
        ("PSHELL,5,1,.002", "field MID2 must be 1"),
        ("PSHELL,5,1,.002,1,2.", r"12I/T\*\*3 must be 1.0"),
        ("PSHELL,5,1,.002,1,,1,.5", "field TS/T must be 0.8333"),
        ("PSHELL,5,1,.002,1,,2", "field MID3 must be 1"),
        ("PSHELL,5,1,.002,1,,1,,\n,,,9", "field MID4 = 9"),
        ("PSHELL,5,1,.002,1,,1,,0.,\n,x", "field Z1: 'X' is not a real"),
        ("PSHELL,5,1,,1", "field T is blank"),
        ("PSHELL,5,1,-.002,1", "field T = -0.002 must be above zero"),
        ("PSHELL,5,4,.002,4", "property 5 names MAT1 4, which is missing"),
        ("PSHELL,2,1,.002,1", r"PSHELL and PBAR\(L\) are both numbered 2"),
        ("PBAR,5,1,1.-4,1.-8,1.-8,1.-8\n\n,0.\n,,,1.-9", "field I12 = 1.-9"),
        ("PBAR,5,1,-1.", "field A = -1 must not be negative"),
        ("PBARL,5,1,,Z\n,.1,.1,.1,.1", "cross-section 'Z' is not supported"),
        ("PBARL,5,1,,L\n,.1,.1,.1,.1", "cross-section 'L' is not supported"),
        ("PBARL,5,1,,BAR\n,.1", "BAR needs 2 dimensions, has 1"),
        ("PBARL,5,1,,BAR\n,.1,.1,0.,2.", "BAR needs 2 dimensions, has 4"),
        ("PBARL,5,1,,TUBE\n,.1,.2", "inner radius 0.2 must be less"),
        ("PBARL,5,1,,BAR\n,.1,-.2", "BAR DIM2 = -0.2 must be above zero"),
        ("PBARL,5,1,MYGROUP,BAR\n,.1,.2", "field GROUP = 'MYGROUP'"),
        ("PBARL,2,1,,BAR\n,.1,.2", "PBAR and PBARL are both numbered 2"),
        ("MAT1,5,7.+10", "two of E, G and NU are needed"),
        ("MAT1,5,7.+10,,.6", "NU above -1 and not above 0.5"),
        ("MAT1,5,7.+10,,.3,-1.", "field RHO = -1 must not be negative"),
        ("MAT1,5,7.+10,,.3,1.,,,.02", "field GE = .02: damping is stated"),
        ("INCLUDE 'wing.bdf'", "deck line 10: INCLUDE is not supported"),
        ("+A,5", "line 10"),
        ("CQUAD4,5,1,1,2,3,4,,,+B\n+C,1.", "line 11 does not continue it: 'B' is expected"),
        ("CQUAD4,5,1,1,2,3,4,,,+B", "its continuation 'B' does not follow"),
        ("CQUAD4,5,1,1,2,3,4,,,,,,", "12 free fields after 'CQUAD4'"),
        ("123,5,1", "'123' starts no card"),
    ],
)  # fmt: skip
def test_a_field_that_is_not_honoured_is_refused(card, message):
    with pytest.raises(ModelError, match=message):
        parse_bulk_data(SOUND + card, "deck")


def test_an_include_in_the_executive_section_is_refused():
    with pytest.raises(ModelError, match="deck line 2: INCLUDE"):
        parse_bulk_data("SOL 101\ninclude 'x.bdf'\nCEND\nBEGIN BULK\n" + SOUND, "deck")


def test_a_second_bulk_section_is_refused():
    with pytest.raises(ModelError, match="deck line 11: a second BEGIN"):
        parse_bulk_data("BEGIN BULK\n" + SOUND + "BEGIN BULK", "deck")


def test_superelement_sections_are_refused():
    with pytest.raises(ModelError, match="deck line 1: only BEGIN BULK"):
        parse_bulk_data("BEGIN SUPER=1\n" + SOUND, "deck")


def test_a_file_without_nodes_is_refused():
    with pytest.raises(ModelError, match="holds no GRID"):
        parse_bulk_data("$ nothing\n")


def test_a_missing_file_is_named(tmp_path: Path):
    with pytest.raises(ModelError, match=r"gone\.bdf: cannot be read"):
        read_bulk_data(tmp_path / "gone.bdf")
