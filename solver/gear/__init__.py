"""The landing gear: oleo strut, tyre, spring-back, pins, and the drop test."""
