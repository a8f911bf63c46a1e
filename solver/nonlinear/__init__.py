"""Geometrically nonlinear dynamics of the whole free airframe: the reference analysis."""
