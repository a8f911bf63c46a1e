"""``python -m solver.sizing``: size the example aircraft and write its table."""

from solver.sizing.iteration import main

main()
