"""What a person sees on a terminal: text, colour, progress, and the three streams."""
