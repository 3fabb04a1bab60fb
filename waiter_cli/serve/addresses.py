"""Parses and binds the address of a loop: a port of this machine or a UNIX socket.
Entry points `parse_address`, `bind`.
"""

from __future__ import annotations

import os
import socket
import stat

from sparc.numerals import whole
from waiter_cli.errors import Fault, InputError, Where

__all__ = ["bind", "parse_address"]

_BACKLOG = 128
"""So many may knock at once."""


def parse_address(address: str) -> tuple[str, int] | str:
    """Returns host and port, or the path of a UNIX socket; raises `InputError` for other machines.

    >>> parse_address("localhost:7311"), parse_address("/tmp/waiter.sock")
    (('127.0.0.1', 7311), '/tmp/waiter.sock')
    """
    where = Where("--listen")
    host, colon, port = address.rpartition(":")
    if not colon or "/" in address:
        if not address or "\0" in address:
            raise InputError([Fault(where, "no address", "give 127.0.0.1:PORT or a path")])
        if address == "localhost" or address.replace(".", "").isdigit():
            half = "port" if "." in address or address == "localhost" else "host"
            hint = "give 127.0.0.1:PORT; for a UNIX socket of that name write ./" + address
            raise InputError([Fault(where, f"{address} has no {half}", hint)])
        return address
    host = {"localhost": "127.0.0.1", "[::1]": "::1"}.get(host, host)
    number = whole(port)
    if number is None or not 0 <= number <= 65535 or not port.isdigit():
        raise InputError([Fault(where, f"no port: {port[:20]}", "a number from 0 to 65535")])
    parts = host.split(".")
    numeric = len(parts) == 4 and all(p.isdigit() and (whole(p, 255) is not None) for p in parts)
    if host != "::1" and not (numeric and parts[0] == "127"):
        hint = "only this machine may connect: 127.0.0.1:PORT, or the path of a UNIX socket"
        raise InputError([Fault(where, f"{host or 'every interface'} is not this machine", hint)])
    return host, number


def bind(place: tuple[str, int] | str) -> socket.socket:
    """Returns a socket that listens there; raises `InputError` where that cannot be had."""
    return _unix(place) if isinstance(place, str) else _loopback(place)


def _loopback(place: tuple[str, int]) -> socket.socket:
    family = socket.AF_INET6 if ":" in place[0] else socket.AF_INET
    server = socket.socket(family, socket.SOCK_STREAM)
    server.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        server.bind(place)
        server.listen(_BACKLOG)
    except OSError as error:
        server.close()
        raise _refused(error, "choose another port; 0 takes any that is free") from None
    return server


def _unix(path: str) -> socket.socket:
    if not hasattr(socket, "AF_UNIX"):
        raise InputError([Fault(Where("--listen"), "no UNIX sockets here", "127.0.0.1:PORT")])
    server = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        _remove_stale(path)
        mask = os.umask(0o177)
        try:
            server.bind(path)
        finally:
            os.umask(mask)
        server.listen(_BACKLOG)
    except OSError as error:
        server.close()
        raise _refused(error, "choose another path") from None
    return server


def _remove_stale(path: str) -> None:
    """Takes a socket away that nobody serves any more; raises `OSError` where one does."""
    try:
        if not stat.S_ISSOCK(os.lstat(path).st_mode):
            raise OSError(17, "there is a file of that name")
    except FileNotFoundError:
        return
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as probe:
        try:
            probe.connect(path)
        except ConnectionRefusedError:
            os.unlink(path)
            return
    raise OSError(98, "somebody listens there already")


def _refused(error: OSError, hint: str) -> InputError:
    message = f"cannot listen there: {(error.strerror or str(error)).lower()}"
    return InputError([Fault(Where("--listen"), message, hint)])
