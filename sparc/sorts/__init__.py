"""Sorts: what their definitions mean, and the ground terms in them."""
