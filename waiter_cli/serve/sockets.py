"""The same lines over a local socket: one client writes, many listen. Entry point `listen_on`.

The address is a port of the loopback interface or the path of a UNIX socket; others are refused.
The first client that sends a line is the writer until it hangs up; then another one may write.
Every client is told every answer.  One that does not listen is dropped, so that nobody waits for it.
"""

from __future__ import annotations

import os
import selectors
import socket
import stat
import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from waiter_cli.exits import Fault, InputError
from waiter_cli.serve.inbox import Inbox, Line
from waiter_cli.serve.protocol import MAX_LINE, error_document, to_json
from waiter_cli.situation import Where

if TYPE_CHECKING:
    from waiter_cli.serve.loop import Session

__all__ = ["listen_on", "parse_address"]

MAX_UNSENT = 4 << 20
"""So many bytes may wait for a client that does not read."""
MAX_CLIENTS = 256
_BROWSER = (b"GET ", b"POST ", b"PUT ", b"HEAD ", b"OPTIONS ")


def parse_address(address: str) -> tuple[str, int] | str:
    """Host and port, or the path of a UNIX socket; raises `InputError` for any other machine's.

    >>> parse_address("localhost:7311"), parse_address("/tmp/waiter.sock")
    (('127.0.0.1', 7311), '/tmp/waiter.sock')
    """
    where = Where("--listen")
    host, colon, port = address.rpartition(":")
    if not colon or "/" in address:
        if not address or "\0" in address:
            raise InputError([Fault(where, "no address", "give 127.0.0.1:PORT or a path")])
        return address
    host = {"localhost": "127.0.0.1", "[::1]": "::1"}.get(host, host)
    if not port.isascii() or not port.isdigit() or int(port) > 65535:
        raise InputError([Fault(where, f"no port: {port[:20]}", "a number from 0 to 65535")])
    parts = host.split(".")
    numeric = len(parts) == 4 and all(p.isascii() and p.isdigit() and int(p) < 256 for p in parts)
    if host != "::1" and not (numeric and parts[0] == "127"):
        hint = "only this machine may connect: 127.0.0.1:PORT, or the path of a UNIX socket"
        raise InputError([Fault(where, f"{host or 'every interface'} is not this machine", hint)])
    return host, int(port)


def listen_on(address: str, session: Session, greeting: str, warn: Callable[[str], None]) -> None:
    """Serves clients until the process is told to end; raises `InputError` at a bad address."""
    from waiter_cli.serve.loop import serve_lines

    place = parse_address(address)
    server = _unix(place) if isinstance(place, str) else _loopback(place)
    shown = place if isinstance(place, str) else ":".join(map(str, server.getsockname()[:2]))
    warn(f"listening on {shown}")
    hall = _Hall(server, greeting)
    worker = threading.Thread(target=hall.run, daemon=True)
    worker.start()
    try:
        serve_lines(session, hall.inbox, hall.tell)
    finally:
        hall.stop()
        worker.join(2)
        if isinstance(place, str):
            os.unlink(place)


def _loopback(place: tuple[str, int]) -> socket.socket:
    family = socket.AF_INET6 if ":" in place[0] else socket.AF_INET
    server = socket.socket(family, socket.SOCK_STREAM)
    server.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        server.bind(place)
        server.listen()
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
        server.listen()
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


@dataclass
class _Client:
    """One connection: what came in of an unfinished line, and what still has to go out."""

    socket: socket.socket
    unread: bytearray = field(default_factory=bytearray)
    unsent: bytearray = field(default_factory=bytearray)
    lines: int = 0
    awaiting: int = 0
    """So many of its lines are not answered yet."""
    skipping: bool = False
    """The rest of a line that was too long is left out."""
    finished: bool = False
    """It will send nothing more; it may still listen."""


class _Hall:
    """All clients, served by one thread; answers come from another through `tell`."""

    def __init__(self, server: socket.socket, greeting: str) -> None:
        self.inbox = Inbox()
        self._server = server
        self._greeting = greeting.encode() + b"\n"
        self._clients: dict[socket.socket, _Client] = {}
        self._writer: _Client | None = None
        self._lock = threading.Lock()
        self._wake, self._woken = socket.socketpair()
        self._selector = selectors.DefaultSelector()
        self._stopping = False
        self._outgoing: list[bytes] = []
        self._asked: deque[_Client] = deque()  # whose lines are not answered yet, in order
        for each in (server, self._woken):
            each.setblocking(False)
            self._selector.register(each, selectors.EVENT_READ)

    def tell(self, text: str) -> None:
        """Sends an answer to everybody; does not wait for anybody."""
        with self._lock:
            self._outgoing.append(text.encode() + b"\n")
        self._wake.send(b"x")

    def stop(self) -> None:
        """Ends the thread, once what was told has been handed to the system."""
        self._stopping = True
        self._wake.send(b"x")

    def run(self) -> None:
        """Serves until `stop`."""
        deadline = None
        while True:
            for key, events in self._selector.select(0.05 if self._stopping else None):
                if key.fileobj is self._server:
                    self._admit()
                elif key.fileobj is self._woken:
                    self._woken.recv(4096)
                else:
                    assert isinstance(key.fileobj, socket.socket)
                    client = self._clients.get(key.fileobj)
                    if client is not None and events & selectors.EVENT_READ:
                        self._receive(client)
                    if client is not None and events & selectors.EVENT_WRITE:
                        self._send(client)
            self._hand_out()
            if self._stopping:
                deadline = deadline or time.monotonic() + 1
                waiting = any(client.unsent for client in self._clients.values())
                if not waiting or time.monotonic() > deadline:
                    break
        for client in list(self._clients.values()):
            self._drop(client)
        self._server.close()

    def _admit(self) -> None:
        try:
            connection, _ = self._server.accept()
        except OSError:
            return
        if len(self._clients) >= MAX_CLIENTS:
            connection.close()
            return
        connection.setblocking(False)
        client = _Client(connection)
        self._clients[connection] = client
        self._selector.register(connection, selectors.EVENT_READ)
        self._queue(client, self._greeting)

    def _hand_out(self) -> None:
        with self._lock:
            answers, self._outgoing = self._outgoing, []
        for data in answers:
            asker = self._asked.popleft()
            asker.awaiting -= 1
            for client in list(self._clients.values()):
                self._queue(client, data)
            self._dismiss(asker)

    def _dismiss(self, client: _Client) -> None:
        """Hangs up on a writer that has said all and was told all."""
        if client.finished and client.lines and not client.awaiting and not client.unsent:
            self._drop(client)

    def _queue(self, client: _Client, data: bytes) -> None:
        client.unsent += data
        if len(client.unsent) > MAX_UNSENT:
            self._drop(client)
        else:
            self._send(client)

    def _send(self, client: _Client) -> None:
        try:
            while client.unsent:
                sent = client.socket.send(client.unsent)
                del client.unsent[:sent]
        except BlockingIOError:
            pass
        except OSError:
            self._drop(client)
            return
        events = 0 if client.finished else selectors.EVENT_READ
        if client.unsent:
            events |= selectors.EVENT_WRITE
        if client.socket in self._clients:
            self._watch(client, events)
            self._dismiss(client)

    def _watch(self, client: _Client, events: int) -> None:
        known = client.socket in self._selector.get_map()
        if events and known:
            self._selector.modify(client.socket, events)
        elif events:
            self._selector.register(client.socket, events)
        elif known:
            self._selector.unregister(client.socket)

    def _receive(self, client: _Client) -> None:
        try:
            data = client.socket.recv(1 << 16)
        except BlockingIOError:
            return
        except OSError:
            self._drop(client)
            return
        if not data:
            if client.unread and not client.skipping:
                self._line(client, bytes(client.unread))
            client.finished = True
            if self._writer is client:
                self._writer = None
            # Half closed: it may still read the answers to what it sent.
            self._send(client)
            return
        if not client.lines and not client.unread and data.startswith(_BROWSER):
            self._drop(client)  # a web page must not write here
            return
        client.unread += data
        while (end := client.unread.find(b"\n")) >= 0:
            line = bytes(client.unread[:end])
            del client.unread[: end + 1]
            if client.skipping:
                client.skipping = False
            else:
                self._line(client, line)
        if len(client.unread) > MAX_LINE:
            if not client.skipping:
                self._line(client, bytes(client.unread))
                client.skipping = True
            client.unread.clear()

    def _line(self, client: _Client, data: bytes) -> None:
        client.lines += 1
        if self._writer is None:
            self._writer = client
        if self._writer is client:
            client.awaiting += 1
            self._asked.append(client)
            self.inbox.put(
                Line(client.lines, data.rstrip(b"\r")[: MAX_LINE + 1], time.perf_counter())
            )
            return
        fault = error_document("somebody else is writing", "listen, or try again later")
        self._queue(client, (to_json({"line": client.lines} | fault) + "\n").encode())

    def _drop(self, client: _Client) -> None:
        if self._clients.pop(client.socket, None) is None:
            return
        if client.socket in self._selector.get_map():
            self._selector.unregister(client.socket)
        if self._writer is client:
            self._writer = None
        client.socket.close()
