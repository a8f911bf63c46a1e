"""A chapter with a comparison that does not hold."""

from verification.chapter import Chapter, Comparisons
from verification.comparison import Comparison
from verification.run import Run


def chapter(run: Run) -> Chapter:
    row = Comparison("ten per cent off", 1100.0, 1000.0, 0.01, "N", "arithmetic", "one per cent")
    return Chapter("missed", "What does not hold", (Comparisons("One figure", (row,)),))
