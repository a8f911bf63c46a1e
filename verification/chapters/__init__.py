"""The chapters of the report; each module has `chapter(run)`, which computes and describes."""

from importlib.util import find_spec

#: In the order of the report.
ORDER = (
    "gear",
    "spring_back",
    "flexible_airframe",
    "inertia_relief",
    "elements",
    "nonlinear_benchmarks",
    "tables",
    "reduced",
    "peers",
)

#: Those that take longest, begun first when several run at once.
LONGEST = ("tables", "reduced", "nonlinear_benchmarks", "flexible_airframe")


def existing() -> tuple[str, ...]:
    """Chapters whose module is there, in the order of the report."""
    return tuple(name for name in ORDER if find_spec(f"{__name__}.{name}") is not None)


def in_starting_order(names: tuple[str, ...]) -> tuple[str, ...]:
    """Names with the longest first."""
    rank = {name: index for index, name in enumerate(LONGEST)}
    return tuple(sorted(names, key=lambda name: rank.get(name, len(LONGEST))))
