"""Landing simulation, airframe stress by extended inertia relief, and the verdict.

A library of its own: no HTTP, no SQL, no task queue.  The one call most users need is
:func:`solver.assess.assess_landing`.
"""

import hashlib
import os
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

try:
    __version__ = version("hardlanding")
except PackageNotFoundError:  # a source tree that was never installed
    __version__ = "0+unknown"


def _keep_kernels_per_source() -> None:
    """Cache compiled kernels under a name that holds the digest of the solver's sources.

    Numba's own cache compares one file's date: after a change in a kernel that others inline, the
    others would keep running the old machine code.
    """
    package = Path(__file__).parent
    digest = hashlib.sha256()
    for source in sorted(package.rglob("*.py")):
        text = source.read_bytes()
        if b"numba" in text:
            digest.update(text)
    kernels = package / "__pycache__" / f"kernels-{digest.hexdigest()[:16]}"
    try:
        kernels.mkdir(parents=True, exist_ok=True)
    except OSError:  # an installation that cannot be written to: numba finds a place of its own
        return
    os.environ.setdefault("NUMBA_CACHE_DIR", str(kernels))


_keep_kernels_per_source()
