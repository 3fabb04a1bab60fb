"""Explains why there is no plan, what would help, and what another choice would cost."""
