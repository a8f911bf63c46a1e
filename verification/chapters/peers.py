"""Independent peers: the airframe in another structural code, the landing in a multibody code."""

from verification.chapter import Chapter, Item, Text
from verification.peers import exudyn_landing, kratos_model
from verification.peers.airframe_items import bulk_data_model, modes_items, written_items
from verification.peers.element_items import (
    panel_figures,
    panel_items,
    quadrilateral_items,
    torsion_items,
)
from verification.peers.multibody import drop_test_items, landing_items
from verification.peers.transient_items import transient_items
from verification.run import Run

HOW_TO_INSTALL = (
    "is not installed, so that nothing is compared with it here. The peers are an optional group "
    "of packages: make verify installs them in its complete form, or "
    "pip install -r requirements-peers.lock."
)


def chapter(run: Run) -> Chapter:
    """Compute and describe."""
    items: list[Item] = [
        Text(
            "Two codes that share nothing with the solver compute the same: Kratos "
            "Multiphysics (BSD licence) the structure, exudyn (BSD licence) gear and landing. "
            "They run in processes of their own and are needed by nothing else."
        )
    ]
    items += _structure(run) if kratos_model.is_installed() else [_missing("Kratos Multiphysics")]
    items += _multibody(run) if exudyn_landing.is_installed() else [_missing("exudyn")]
    return Chapter("peers", "Independent peers", tuple(items))


def _missing(name: str) -> Text:
    return Text(f"{name} {HOW_TO_INSTALL}")


def _structure(run: Run) -> list[Item]:
    items = panel_items(panel_figures(run)) + torsion_items(run)
    if run.quick:
        return [*items, Text("The full-size airframe is left to the complete form.")]
    items += quadrilateral_items()
    model = bulk_data_model(run)
    return items + written_items(model) + modes_items(run, model) + transient_items(run, model)


def _multibody(run: Run) -> list[Item]:
    items = drop_test_items(run)
    if run.quick:
        return [*items, Text("The landings are left to the complete form.")]
    return items + landing_items(run)
