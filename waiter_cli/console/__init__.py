"""The terminal: text, colour, progress, and the three streams."""
