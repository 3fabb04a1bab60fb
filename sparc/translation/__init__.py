"""Translates a checked program into clingo's language, with the place of each rule."""
