"""The user's layouts, scenarios, plans and JSON documents: YAML and JSON from and to values."""
