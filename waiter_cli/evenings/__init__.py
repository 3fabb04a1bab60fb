"""Guests who come by chance: what is drawn for them, how they behave, and what they waited."""
