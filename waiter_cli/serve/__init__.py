"""The live loop: observations in as JSON lines, plans out as JSON lines.

`startup` opens it, `inbox` and `sockets` are the two ways in.  `protocol` reads lines and writes
answers, `line_hints` guesses what a wrong line meant, `session` acts on lines in their order,
`supersede` drops searches that a later line makes idle, `memory` and `journal` keep what was
accepted, `journal_replay` prints it again, `latency` measures.
"""
