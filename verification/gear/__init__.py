"""Drop test of NACA Report 1154 by other means, and the force laws of strut and tyre."""
