"""Checks a program: sorts, predicates, rules, and what is legal and probably a mistake."""
