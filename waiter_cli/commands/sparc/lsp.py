"""``waiter sparc lsp``: a language server for SPARC over standard input and output."""

from __future__ import annotations

__all__ = ["lsp"]


def lsp() -> int:
    """Serve an editor: faults while typing, hover, completion, renaming, formatting.

    An editor starts it and talks to it over standard input and output, by the Language Server
    Protocol.

    \b
    Examples:
      waiter sparc lsp
    """
    from waiter_cli import __version__
    from waiter_cli.errors import MissingError
    from waiter_cli.optional_packages import extra_line

    try:
        from sparc.language_server.server import serve
    except ModuleNotFoundError as error:
        raise MissingError("the language server needs pygls", extra_line("lsp")) from error
    serve(__version__)
    return 0
