"""The two translators from SPARC to clingo's language, and where sparc.jar is kept."""
