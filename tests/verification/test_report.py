import re
from collections import Counter
from pathlib import Path

import pytest

from tests.verification.sample_chapters import held, missed
from verification.chapter import Chapter, Plot
from verification.comparison import Comparison
from verification.outcome import Outcome
from verification.report import Document, build_document, write_page, write_pages, write_print
from verification.report.document import ComparisonBlock, PlotBlock
from verification.report.numerals import aligned, compared, power_of_ten, short, typeset
from verification.run import Run, StoredResult


def outcome(chapter: Chapter | None, failure: str = "") -> Outcome:
    taken = (StoredResult("long", 3600.0, is_earlier=True),)
    return Outcome(chapter.name if chapter else "broken", chapter, failure, 2.0, taken)


@pytest.fixture
def document(tmp_path: Path) -> Document:
    run = Run(tmp_path)
    outcomes = [
        outcome(held.chapter(run)),
        outcome(missed.chapter(run)),
        outcome(None, "Traceback\nRuntimeError: <the bridge> is out"),
    ]
    return build_document(outcomes, [("Date", "today"), ("Processor", "2 cores & more")])


@pytest.fixture
def page(document: Document, tmp_path: Path) -> str:
    path = tmp_path / "report.html"
    write_page(document, path)
    return path.read_text()


def test_headline_counts_what_misses_and_fails(document: Document) -> None:
    assert document.headline == "1 of 3 comparisons does not hold; 1 chapter failed"
    assert not document.holds


def test_worst_comparison_comes_first(document: Document) -> None:
    assert [row.name for row in document.rows] == [
        "ten per cent off",
        "a residual",
        "four <thirds>",
    ]
    assert [row.holds for row in document.rows] == [False, True, True]


def test_time_of_a_chapter_counts_what_earlier_runs_spent(document: Document) -> None:
    assert document.sections[0].time == "60 min 02 s"


def test_page_needs_nothing_else(page: str) -> None:
    assert "http" not in page
    assert "<script" not in page
    assert "<link" not in page
    assert "@import" not in page
    for place in re.findall(r'\b(?:src|href)="([^"]*)"', page):
        assert place.startswith(("#", "data:"))
    assert re.findall(r"url\((?!#)", page) == []


def test_ids_of_the_page_are_unique_and_its_references_lead_somewhere(page: str) -> None:
    ids = Counter(re.findall(r'\bid="([^"]+)"', page))
    assert ids.most_common(1)[0][1] == 1
    references = set(re.findall(r'href="#([^"]+)"', page)) | set(
        re.findall(r"url\(#([^)]+)\)", page)
    )
    assert references <= ids.keys()


def test_page_shows_every_comparison_with_its_figures(page: str, document: Document) -> None:
    blocks = [
        block
        for section in document.sections
        for block in section.blocks
        if isinstance(block, ComparisonBlock)
    ]
    rows = [row for block in blocks for row in block.rows]
    assert len(rows) == 3
    for row in (*rows, *document.rows):
        name = row.name.replace("<", "&lt;").replace(">", "&gt;")
        assert f'<th scope="row">{name}' in page
        for cell in row.cells:
            assert cell.text in page
    assert page.count('class="missed"') == 2 + 2  # in both tables; two chapters of the contents
    assert "four decimals &amp; more" in page


def test_page_escapes_what_it_shows(page: str) -> None:
    assert "&lt;angle brackets&gt;" in page
    assert "RuntimeError: &lt;the bridge&gt; is out" in page
    assert "2 cores &amp; more" in page


def test_plots_take_the_inks_of_the_page(page: str) -> None:
    assert "var(--ink)" in page.partition("<svg")[2]


def test_print_is_one_pdf_of_its_pages(document: Document, tmp_path: Path) -> None:
    path = tmp_path / "report.pdf"
    write_print(document, path)
    data = path.read_bytes()
    assert data.startswith(b"%PDF-")
    # Summary with contents and all comparisons, then a page for each chapter.
    assert len(re.findall(rb"/Type\s*/Page\b", data)) == 4


def test_pages_for_the_docs_show_every_comparison_and_mark_what_misses(
    document: Document, tmp_path: Path
) -> None:
    write_pages(document, tmp_path / "pages", Path("../figures"))
    for section in document.sections:
        text = (tmp_path / "pages" / f"{section.name}.md").read_text()
        rows = [line for line in text.splitlines() if line.startswith("|")]
        for block in section.blocks:
            for row in block.rows if isinstance(block, ComparisonBlock) else ():
                (line,) = [line for line in rows if row.name in line]
                assert row.used in line
                assert ("(missed)" in line) != row.holds
            if isinstance(block, PlotBlock):
                assert f"](../figures/{block.file})" in text
        widths = {line.count("|") - line.count("\\|") for line in rows}
        assert len(widths) <= len(section.blocks)


def test_figures_of_one_name_are_refused() -> None:
    plot = Plot("twice", "A plot.", b"<svg/>", "svg")
    chapter = Chapter("held", "Twice", (plot, plot))
    with pytest.raises(ValueError, match="2 figures are named twice"):
        build_document([outcome(chapter)], [])


def test_digits_follow_the_tolerance() -> None:
    def figures(tolerance: float) -> tuple[str, str, str]:
        row = Comparison("F", 28872.1057, 28872.3333, tolerance, "N", "", "")
        found = compared(row)
        return found.found, found.target, found.unit

    assert figures(1e-2) == ("28.87", "28.87", "kN")
    assert figures(1e-6) == ("28.872106", "28.872333", "kN")


def test_differences_are_shares_unless_the_scale_is_one() -> None:
    relative = compared(Comparison("F", 101.0, 100.0, 0.05, "N", "", ""))
    assert (relative.difference, relative.tolerance) == ("1.0 %", "5.0 %")
    absolute = compared(Comparison("T", 0.5, 0.0, 2.0, "kg", "", "", scale=1.0))
    assert (absolute.difference, absolute.tolerance) == ("0.50 kg", "2.0 kg")


def test_decimal_points_of_a_column_stand_above_each_other() -> None:
    (column,) = aligned([["1.25", "−10.5", "7", "1.2 × 10⁻³", "10⁻³", "–"]])
    assert [cell.hidden for cell in column] == ["", "0", ".00", "", "", ""]
    widths = {len((cell.text + cell.hidden).partition(".")[2]) for cell in column[:2]}
    assert widths == {2}
    assert all(cell.is_number for cell in column)


def test_words_that_begin_with_a_digit_are_words() -> None:
    (column,) = aligned([["3 degrees of roll", "level"]])
    assert not any(cell.is_number for cell in column)


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0"), (0.012, "0.012"), (-3.14159, "−3.1"), (1.5e-7, "1.5 × 10⁻⁷"), (123.4, "123")],
)
def test_short_figures(value: float, text: str) -> None:
    assert short(value) == text


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("to 1e-12 each", "to 10⁻¹² each"),
        ("2.09e-08", "2.09 × 10⁻⁸"),
        ("1.5e+6 N", "1.5 × 10⁶ N"),
        ("type 2e4b and 3e", "type 2e4b and 3e"),
    ],
)
def test_exponents_in_texts_are_raised(text: str, printed: str) -> None:
    assert typeset(text) == printed


def test_powers_of_ten() -> None:
    assert power_of_ten(-2.53e12, 3) == "−2.53 × 10¹²"
