"""What the recorded responses make of the contacts of a window, for `hardlanding flight-data`."""

from typing import Any

from rich.console import Console
from rich.table import Table

from app.flight_data.contact_answers import response_compared
from solver.assimilation.assimilate import Assimilation, ContactUpdate

#: Parameters that are always shown; of the others those that the response says something about.
_ALWAYS = ("sink_rate", "pitch", "roll", "lift_fraction")

#: Share of its deviation that a parameter keeps, below which it is shown.
_LEARNED = 0.9


def response_document(update: ContactUpdate) -> dict[str, Any]:
    """Plain JSON values of one contact's update."""
    compared = response_compared(update)
    return {
        "kind": str(update.found.kind),
        "time_s": update.found.time,
        "is_used": update.is_corrected,
        "unused_because": update.unchanged_because or None,
        "compared": None if compared is None else compared.model_dump(),
    }


def show_responses(responses: Assimilation, console: Console) -> None:
    """Print for a reader how each response fits, and what it changes."""
    for number, update in enumerate(responses.updates, 1):
        head = f"response to contact {number} ({update.found.kind.replace('_', ' ')})"
        if update.corrected is None:
            console.print(f"{head} not compared: {update.unchanged_because}", markup=False)
            continue
        console.print(f"{head}: {update.corrected.misfit.text}", markup=False)
        if update.unchanged_because:
            console.print(f"not used: {update.unchanged_because}", markup=False)
        console.print(_table(update))


def _table(update: ContactUpdate) -> Table:
    table = Table(title="Before and after the response", title_justify="left")
    for heading in ("parameter", "unit", "before", "after", "pull"):
        table.add_column(heading)
    parameters = () if update.corrected is None else update.corrected.parameters
    for each in parameters:
        if each.name in _ALWAYS or each.posterior_sd < _LEARNED * each.prior_sd:
            table.add_row(
                each.name.replace("_", " "),
                each.unit,
                f"{each.prior:.3f}±{each.prior_sd:.3f}",
                f"{each.posterior:.3f}±{each.posterior_sd:.3f}",
                f"{each.pull:+.1f}",
            )
    return table
