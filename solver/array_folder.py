"""Arrays kept in a folder of their own: written in one step, mapped by whoever reads them.

Mapped pages are the system's file cache: every process that maps a folder shares them, and they
can be dropped and read again when memory is short.
"""

import json
import os
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

_HEAD = "model.json"


def write_array_folder(
    folder: Path, head: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]
) -> None:
    """Write ``folder`` in one step: readers see all of it or nothing.

    A folder that is there with the same head is kept, so that processes that come to the same
    arrays at the same time share those of the first; any other is replaced.
    """
    folder.parent.mkdir(parents=True, exist_ok=True)
    draft = Path(tempfile.mkdtemp(prefix=".draft-", dir=folder.parent))
    try:
        for name, array in arrays.items():
            np.save(draft / f"{name}.npy", array)
        (draft / _HEAD).write_text(json.dumps(head, indent=1))
        try:
            os.replace(draft, folder)
        except OSError:  # not empty
            if read_head(folder) == head:
                return
            shutil.rmtree(folder)
            os.replace(draft, folder)
    finally:
        shutil.rmtree(draft, ignore_errors=True)


def read_head(folder: Path) -> dict[str, Any] | None:
    """Read what was said of a folder's arrays; None if there is no such folder."""
    try:
        head: dict[str, Any] = json.loads((folder / _HEAD).read_text())
    except FileNotFoundError:
        return None
    return head


def map_array(folder: Path, name: str) -> NDArray[Any]:
    """Map one array of a folder into memory, read-only."""
    # a plain view: arithmetic with a `memmap` makes more of its kind
    return np.asarray(np.load(folder / f"{name}.npy", mmap_mode="r"))
