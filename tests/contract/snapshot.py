"""The interface description as committed: ``python -m tests.contract.snapshot`` writes it."""

import json
import tempfile
from pathlib import Path

from app.config import Settings
from app.main import create_app

SNAPSHOT = Path(__file__).with_name("openapi.json")


def interface() -> str:
    """The description of the program as it is now."""
    with tempfile.TemporaryDirectory() as folder:
        document = create_app(Settings(_env_file=None, var=Path(folder))).openapi()
    # The version changes with every release, the interface need not.
    document["info"]["version"] = "0"
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    SNAPSHOT.write_text(interface())
