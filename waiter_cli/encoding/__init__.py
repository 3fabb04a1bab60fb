"""`Problem` → a SPARC program: the domain's template, filled with facts."""
