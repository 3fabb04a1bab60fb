"""Execution by the domain itself: the state after an action is what its program says of one step."""
