"""The commands of ``waiter study``."""
