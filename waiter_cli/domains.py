"""Finds domains: a built-in name, a template file, or a folder that holds ``domain.sparc``."""

from __future__ import annotations

import os

from sparc.source import Source
from waiter_cli.exits import Fault, InputError
from waiter_cli.resources import data_folder
from waiter_cli.search_types import Domain
from waiter_cli.situation import Where

__all__ = ["BUILT_IN", "find_domain"]

BUILT_IN = ("report", "restaurant")
_FILE = "domain.sparc"


def find_domain(name: str) -> Domain:
    """The domain of that name or at that path; a file of that name wins, a folder does not.

    Raises `InputError` where there is none, or where it cannot be read.
    """
    if os.path.isfile(name):
        return Domain(name, _read(name, name), built_in=False)
    if name in BUILT_IN:
        path = os.path.join(data_folder("domains"), name, _FILE)
        return Domain(name, _read(path, f"domains/{name}/{_FILE}"))
    path = os.path.join(name, _FILE)
    if os.path.isfile(path):
        return Domain(name, _read(path, path), built_in=False)
    raise InputError(
        [
            Fault(
                Where("--domain"),
                f"there is no domain {name}",
                f"give the path of a SPARC template, or one of {', '.join(BUILT_IN)}",
            )
        ]
    )


def _read(path: str, shown: str) -> Source:
    try:
        with open(path, encoding="utf-8") as file:
            return Source(shown, file.read())
    except OSError as error:
        raise InputError([Fault(Where(shown), f"cannot be read: {error.strerror}")]) from None
    except UnicodeDecodeError as error:
        raise InputError(
            [Fault(Where(shown), f"is not UTF-8 at byte {error.start}", "save it as UTF-8")]
        ) from None
