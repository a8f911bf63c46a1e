"""Published element benchmarks and patch tests, computed with the solver's own elements."""
