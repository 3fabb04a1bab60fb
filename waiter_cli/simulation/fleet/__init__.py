"""Plays plans of several robots at once, each at its own pace, in one simulated room."""
