"""Runs the cases of a domain: what holds, what happens, and what must follow."""
