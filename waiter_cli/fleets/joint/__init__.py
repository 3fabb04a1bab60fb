"""Joint states of several robots with jobs: searched by layers, and best first for the least length."""
