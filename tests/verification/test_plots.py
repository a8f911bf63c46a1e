from itertools import pairwise

import numpy as np
import pytest

from tests.solver.aircraft.mini import mini_model
from verification.plots import COLOURS, Line, Panel, _spread, airframe_plot, line_plot
from verification.report.page import inline_svg

X = np.linspace(0.0, 1.0, 50)


def drawn(name: str = "curve") -> bytes:
    lines = [Line(X, X**2, "square"), Line(X, X**3, "cube", "dashed")]
    panels = [Panel("x [m]", "y [m]", lines, "Powers", levels=[(0.5, "half")])]
    return line_plot(name, "Powers of x.", panels).image


def test_same_input_gives_the_same_bytes() -> None:
    assert drawn() == drawn()


def test_drawing_carries_no_date() -> None:
    assert b"<dc:date>" not in drawn()
    assert b"Matplotlib" not in drawn()


def test_lines_of_one_label_share_a_colour_over_the_panels() -> None:
    panels = [
        Panel("x", "y", [Line(X, X, "a"), Line(X, -X, "b")]),
        Panel("x", "y", [Line(X, X, "b")]),
    ]
    text = line_plot("shared", "Two panels.", panels).image.decode()
    assert COLOURS[1] in text
    assert COLOURS[2] not in text


@pytest.mark.parametrize("places", [[0.5, 0.5, 0.5], [0.0, 0.01, 1.0], [1.0, 0.99, 0.98, 0.97]])
def test_labels_move_apart_and_stay_inside(places: list[float]) -> None:
    spread = _spread(places, 0.1)
    assert min(spread) >= 0.0
    assert max(spread) <= 1.0
    ordered = sorted(spread)
    assert min(high - low for low, high in pairwise(ordered)) >= 0.1 - 1e-2


def test_labels_that_have_room_stay_where_they_are() -> None:
    assert _spread([0.2, 0.8], 0.1) == [0.2, 0.8]


def test_thousands_of_points_are_a_picture() -> None:
    many = np.random.default_rng(0).random((2, 20_000))
    panel = Panel("x", "y", [Line(many[0], many[1], stroke="points")])
    drawing = line_plot("cloud", "Many points.", [panel]).image
    assert len(drawing) < 400_000
    assert b"data:image/png" in drawing


def test_inline_drawing_keeps_its_ids_to_itself() -> None:
    one, other = (inline_svg(name, drawn(name).decode()) for name in ("one", "other"))
    assert 'id="one-' in one
    assert 'id="other-' in other
    assert 'href="#one-' in one
    assert "http" not in one


def test_airframe_is_drawn_with_the_fields_side_by_side() -> None:
    model = mini_model()
    values = np.linspace(0.0, 1.0, len(model.element_identifiers))
    plot = airframe_plot("mini", "Stress.", model, [("one", values), ("other", values)], "[MPa]")
    assert plot.image.startswith(b"\x89PNG")
    again = airframe_plot("mini", "Stress.", model, [("one", values), ("other", values)], "[MPa]")
    assert plot.image == again.image
