"""The rules of the restaurant in plain Python: actions, observations, the validator."""
