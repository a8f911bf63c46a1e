"""Measurements on the full-size example aircraft: speed, and accuracy of the reduced path."""
