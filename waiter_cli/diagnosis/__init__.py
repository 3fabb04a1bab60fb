"""Finds the unseen events that explain what was observed against what was believed."""
