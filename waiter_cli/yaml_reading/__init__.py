"""Reads YAML with the place of every value, and tells its faults."""
