"""Plays plans in a simulated room, checks every step, and says how it went."""
