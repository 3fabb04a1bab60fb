"""The commands ``waiter sparc …``."""
