"""Self-verification of the nonlinear analysis, before it serves as a reference for others."""
