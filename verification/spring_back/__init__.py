"""Wheel spin-up and spring-back against closed forms, and in a landing of the example aircraft."""
