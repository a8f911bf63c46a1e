"""Writing the example aircraft into a folder."""

from collections.abc import Mapping
from pathlib import Path

from solver.aircraft.bizjet.assembly import Parts, assemble
from solver.aircraft.bizjet.catalogue import Bay, Catalogue, read_gauges
from solver.aircraft.bizjet.definition_text import DISCLAIMER, definition_text
from solver.aircraft.bizjet.masses import MassGroupRange, add_masses
from solver.aircraft.definition import DEFINITION_FILE
from solver.aircraft.nastran_writer import write_bulk_data
from solver.progress import Progress, silent

BULK_DATA_FILE = "airframe.bdf"


def build_bizjet(
    folder: Path,
    refinement: float = 1.0,
    progress: Progress = silent,
    gauges: Mapping[Bay, float] | None = None,
) -> None:
    """Generate the example aircraft: ``definition.toml`` and ``airframe.bdf``.

    The same arguments give the same bytes.

    Parameters
    ----------
    folder : Path
        Made if it is not there; files of these names in it are replaced.
    refinement : float
        1 is the full model; below, bays are wider and fewer; from 2, each is divided.
    gauges : mapping, optional
        Thickness [m] or area [m2] of each bay instead of the sizing table.

    Raises
    ------
    ModelError
        The refinement is out of range, or the structure is too heavy for the empty mass.
    """
    folder.mkdir(parents=True, exist_ok=True)
    progress("meshing the airframe", 0.0)
    parts, groups = mesh_bizjet(refinement, gauges)
    progress("writing the airframe", 0.6)
    write_bizjet(parts, groups, folder, refinement)
    progress("writing the airframe", 1.0)


def write_bizjet(
    parts: Parts, groups: list[MassGroupRange], folder: Path, refinement: float
) -> None:
    """Write a mesh that is there already."""
    write_bulk_data(
        parts.mesh.model(),
        folder / BULK_DATA_FILE,
        comments=[f"Example business jet EBJ-19, refinement {refinement:g}", *_wrapped(DISCLAIMER)],
    )
    text = definition_text(parts, groups, BULK_DATA_FILE)
    (folder / DEFINITION_FILE).write_text(text, encoding="utf-8")


def mesh_bizjet(
    refinement: float, gauges: Mapping[Bay, float] | None = None
) -> tuple[Parts, list[MassGroupRange]]:
    """Mesh with all masses, and its tanks and bays."""
    parts = assemble(refinement, Catalogue(read_gauges() if gauges is None else gauges))
    return parts, add_masses(parts)


def _wrapped(text: str) -> list[str]:
    return [sentence.strip() + "." for sentence in text.rstrip(".").split(". ")]
