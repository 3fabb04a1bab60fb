"""Requests of the page: what they hold is read, what cannot be is refused. Entry points `BadRequest`, `text_of`."""

from __future__ import annotations

from typing import Any

__all__ = ["BadRequest", "text_of"]


class BadRequest(Exception):
    """A request that cannot be understood, or cannot be; ``status`` is that of the answer."""

    def __init__(self, message: str, hint: str | None = None, status: int = 400) -> None:
        super().__init__(message)
        self.status = status
        self.message = message
        self.hint = hint


def text_of(given: dict[str, Any], key: str) -> str:
    """Returns a text of a request; raises `BadRequest` where there is none."""
    value = given.get(key)
    if not isinstance(value, str):
        raise BadRequest(f"{key} must be a text")
    return value
