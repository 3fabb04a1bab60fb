"""The files that ``--watch`` looks at. Entry point `watched_files`."""

from __future__ import annotations

__all__ = ["watched_files"]


def watched_files(
    layout: str | None, scenario: str | None = None, plan: str | None = None
) -> list[str]:
    """Returns the paths to watch; raises `InputError` for standard input, which cannot be."""
    from waiter_cli.errors import InputError, Where
    from waiter_cli.file_access.locate import find

    if "-" in (layout, scenario, plan):
        raise InputError("standard input cannot be watched", "name a file, or leave out --watch")
    paths = [find(layout, "layout", where=Where("LAYOUT"))] if layout is not None else []
    paths += [find(scenario, "scenario")] if scenario is not None else []
    return paths + ([plan] if plan is not None else [])
