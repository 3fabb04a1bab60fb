"""Poses a problem: a layout, a scenario and the command line → `Problem`."""
