"""The values that all stages share: layouts, states, goals, scenarios, problems, plans."""
