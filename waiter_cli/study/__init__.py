"""Plays many evenings, stores each result, and tells which differences the data support."""
