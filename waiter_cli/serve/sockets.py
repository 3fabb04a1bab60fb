"""The same lines over a local socket: one client writes, many listen. Entry point `listen_on`.

The address is a port of the loopback interface or the path of a UNIX socket; others are refused.
The first client that sends a line is the writer until it hangs up; then another one may write.
Every client is told every answer.  One that does not listen is dropped, so that nobody waits for it.
"""

from __future__ import annotations

import os
import selectors
import socket
import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from waiter_cli.serve.addresses import bind, parse_address
from waiter_cli.serve.inbox import Inbox, Line
from waiter_cli.serve.protocol import MAX_LINE, error_document, to_json

if TYPE_CHECKING:
    from waiter_cli.serve.loop import Session

__all__ = ["listen_on"]

MAX_UNSENT = 4 << 20
"""So many bytes may wait for a client that does not read."""
MAX_CLIENTS = 256
_BROWSER = (b"GET ", b"POST ", b"PUT ", b"HEAD ", b"OPTIONS ")


def listen_on(address: str, session: Session, greeting: str, warn: Callable[[str], None]) -> None:
    """Serves clients until the process is told to end; raises `InputError` at a bad address."""
    from waiter_cli.serve.loop import serve_lines

    place = parse_address(address)
    server = bind(place)
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
