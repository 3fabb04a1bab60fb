"""Builds commands, their help, their numbers and their completion on Typer."""
