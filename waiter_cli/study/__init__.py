"""Runs many evenings, keeps what came of each, and tells which differences the data support."""
