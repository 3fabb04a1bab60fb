"""Frames, films and pages of a simulated run."""
