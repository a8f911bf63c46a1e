"""Recorder windows in, contacts and states with covariance out; and what a recorder would show."""
