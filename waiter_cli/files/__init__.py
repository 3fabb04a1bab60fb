"""The user's files: layouts, scenarios, plans and programs, read and written."""
