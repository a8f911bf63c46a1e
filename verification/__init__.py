"""What the solver computes beside what is known by other means, and the report of it."""
