"""Sizing of the example aircraft: design cases, stresses, and the iteration of its gauges."""
