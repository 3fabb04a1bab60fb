"""Solves a program by clingo, or by the original translator and clingo: answer sets and queries."""
