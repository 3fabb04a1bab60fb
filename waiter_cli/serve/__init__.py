"""The live loop: observations in as JSON lines, plans out as JSON lines.

`protocol` reads lines and writes answers, `loop` goes from one to the other, `journal` keeps what
was accepted, `replaying` prints it again, `inbox` and `sockets` are the two ways in, `thinking`
finds plans, `timing` measures.
"""
