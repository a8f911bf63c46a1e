"""Inertia relief: conventional, extended at full order, reduced, and the search for peaks."""
