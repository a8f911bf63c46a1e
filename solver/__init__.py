"""Landing simulation, airframe stress by extended inertia relief, and the verdict.

A library of its own: no HTTP, no SQL, no task queue.  The one call most users need is
:func:`solver.assess.assess_landing`.
"""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("hardlanding")
except PackageNotFoundError:  # a source tree that was never installed
    __version__ = "0+unknown"
