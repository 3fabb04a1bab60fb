"""A language server for SPARC: what an editor asks while a program is being written."""
