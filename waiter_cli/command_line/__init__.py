"""Makes commands, their help, their numbers and their completion of what Typer gives."""
