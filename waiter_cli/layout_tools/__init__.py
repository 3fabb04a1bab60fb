"""Advice on layouts; layouts made, converted, measured and improved."""
