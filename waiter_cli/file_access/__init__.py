"""Files as text: where they and the built-ins lie, of what kind they are, how they are written."""
