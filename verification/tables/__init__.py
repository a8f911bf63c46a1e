"""Whole landings by nonlinear dynamics, by full-order and by reduced extended inertia relief."""
