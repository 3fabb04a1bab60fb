"""Explains why a program is inconsistent, and why a literal is in an answer set or not."""
