"""The commands ``waiter layout …``."""
