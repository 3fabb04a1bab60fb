"""`waiter`: plans for a robot waiter, from a restaurant in YAML to a proof that none is shorter."""

__version__ = "0.1.0"
