"""The same models in independent codes, which share nothing with the solver but the data."""
