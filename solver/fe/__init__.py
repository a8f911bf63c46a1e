"""Finite elements of the airframe: shells, beams, assembly, inertia and stress recovery."""
