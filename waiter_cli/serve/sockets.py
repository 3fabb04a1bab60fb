"""Serves the lines over a local socket: one client writes, many listen. Entry point `listen_on`.

The address is a port of the loopback interface or the path of a UNIX socket; others are refused.
The first client that sends a line is the writer until it hangs up; then another one may write.
Every client is told every answer.  One that does not listen is dropped, so that nobody waits for it.

One thread serves all clients, the loop answers in another, and neither waits for the other: while
the inbox is full the thread reads no more of the writer, and what the loop tells is put down for the
thread.  Whoever hangs up is removed at once; where the house is full, the client that has been silent
longest makes room for the next.
"""

from __future__ import annotations

import errno
import os
import selectors
import socket
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING

from waiter_cli.serve.addresses import bind, parse_address
from waiter_cli.serve.clients import Client, foreign
from waiter_cli.serve.inbox import Inbox, ReceivedLine
from waiter_cli.serve.protocol import error_document, to_json

if TYPE_CHECKING:
    from waiter_cli.serve.session import Session

__all__ = ["listen_on"]

MAX_UNSENT = 4 << 20
"""So many bytes may wait for a client that does not read."""
MAX_CLIENTS = 256
_CHUNK = 1 << 16
_FAREWELL = 2.0
"""Seconds that a stranger has to read why it was refused."""


def listen_on(address: str, session: Session, greeting: str, warn: Callable[[str], None]) -> None:
    """Serves clients until the process is told to end; raises `InputError` at a bad address."""
    from waiter_cli.serve.session import serve_lines

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


class _Hall:
    """All clients, served by one thread; answers come from another through `tell`."""

    def __init__(self, server: socket.socket, greeting: str) -> None:
        self.inbox = Inbox(self._nudge)
        self._server = server
        self._greeting = greeting.encode() + b"\n"
        self._clients: dict[socket.socket, Client] = {}
        self._writer: Client | None = None
        self._lock = threading.Lock()
        self._wake, self._woken = socket.socketpair()
        self._selector = selectors.DefaultSelector()
        self._stopping = False
        self._outgoing: list[bytes] = []
        self._asked: deque[Client] = deque()  # whose lines are not answered yet, in order
        self._wake.setblocking(False)
        for each in (server, self._woken):
            each.setblocking(False)
            self._selector.register(each, selectors.EVENT_READ)

    # -- called by the loop's thread: nothing here waits --------------------------------------

    def tell(self, text: str) -> None:
        """Sends an answer to everybody; does not wait for anybody."""
        with self._lock:
            self._outgoing.append(text.encode() + b"\n")
        self._nudge()

    def stop(self) -> None:
        """Ends the thread, once what was told has been handed to the system."""
        self._stopping = True
        self._nudge()

    def _nudge(self) -> None:
        """Has the thread look around; where it has been nudged often already, once more is no more."""
        with suppress(BlockingIOError):
            self._wake.send(b"x")

    # -- the thread ---------------------------------------------------------------------------

    def run(self) -> None:
        """Serves until `stop`."""
        deadline = None
        while True:
            for key, events in self._selector.select(self._patience()):
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
            if self._writer is not None:
                self._take_lines(self._writer)  # there may be room again
            self._see_off()
            if self._stopping:
                deadline = deadline or time.monotonic() + 1
                waiting = any(client.unsent for client in self._clients.values())
                if not waiting or time.monotonic() > deadline:
                    break
        for client in list(self._clients.values()):
            self._drop(client)
        self._server.close()

    def _patience(self) -> float | None:
        """Returns seconds to wait for something to happen; None: however long that takes."""
        if self._stopping:
            return 0.05
        return 0.5 if any(client.refused for client in self._clients.values()) else None

    def _admit(self) -> None:
        if len(self._clients) >= MAX_CLIENTS:
            self._make_room()
        try:
            connection, _ = self._server.accept()
        except OSError as error:
            if error.errno in (errno.EMFILE, errno.ENFILE):
                self._make_room()
            return
        connection.setblocking(False)
        client = Client(connection, time.monotonic())
        self._clients[connection] = client
        self._selector.register(connection, selectors.EVENT_READ)
        self._queue(client, self._greeting)

    def _make_room(self) -> None:
        """Removes the client that has been silent longest, and tells it so; never the writer."""
        others = (client for client in self._clients.values() if client is not self._writer)
        silent = min(others, key=lambda client: client.heard, default=None)
        if silent is None:
            time.sleep(0.05)  # something else on this machine has to let go first
            return
        fault = error_document("too many clients; you were silent longest", "connect again")
        with suppress(OSError):
            silent.socket.send((to_json({"line": silent.lines + 1} | fault) + "\n").encode())
        self._drop(silent)

    def _hand_out(self) -> None:
        with self._lock:
            answers, self._outgoing = self._outgoing, []
        for data in answers:
            asker = self._asked.popleft()
            asker.awaiting -= 1
            for client in list(self._clients.values()):
                if not client.refused:
                    self._queue(client, data)
            self._dismiss(asker)

    def _dismiss(self, client: Client) -> None:
        """Hangs up on one that has said all, if that was anything, and was told all."""
        if client.ended and not (client.unread or client.awaiting or client.unsent):
            self._drop(client)

    def _queue(self, client: Client, data: bytes) -> None:
        client.unsent += data
        if len(client.unsent) > MAX_UNSENT:
            self._drop(client)
        else:
            self._send(client)

    def _send(self, client: Client) -> None:
        try:
            while client.unsent:
                sent = client.socket.send(client.unsent)
                del client.unsent[:sent]
                client.heard = time.monotonic()
            if client.refused:
                client.socket.shutdown(socket.SHUT_WR)
        except BlockingIOError:
            pass
        except OSError:
            self._drop(client)
            return
        if client.socket in self._clients:
            self._watch(client)
            self._dismiss(client)

    def _watch(self, client: Client) -> None:
        """Has the system say when there is something to be done for a client."""
        paused = client is self._writer and self.inbox.full
        events = 0 if client.ended or paused else selectors.EVENT_READ
        if client.unsent:
            events |= selectors.EVENT_WRITE
        known = client.socket in self._selector.get_map()
        if events and known:
            self._selector.modify(client.socket, events)
        elif events:
            self._selector.register(client.socket, events)
        elif known:
            self._selector.unregister(client.socket)

    # -- what clients say ---------------------------------------------------------------------

    def _receive(self, client: Client) -> None:
        try:
            data = client.socket.recv(_CHUNK)
        except BlockingIOError:
            return
        except OSError:
            self._drop(client)
            return
        if client.refused:
            if not data:
                self._drop(client)
            return
        client.heard = time.monotonic()
        client.ended = not data
        client.unread += data
        if client.stranger():
            self._refuse(client)
            return
        self._take_lines(client)

    def _take_lines(self, client: Client) -> None:
        """Takes over the whole lines that a client has sent, while there is room for them."""
        while client is not self._writer or not self.inbox.full:
            line = client.next_line()
            if line is None:
                if client.ended:
                    client.unread.clear()
                    if self._writer is client:
                        self._writer = None
                break
            if foreign(line):
                self._refuse(client)
                return
            self._line(client, line)
            if client.socket not in self._clients:
                return
        if client.socket in self._clients:
            self._watch(client)
            # Half closed: it may still read the answers to what it sent.
            self._dismiss(client)

    def _line(self, client: Client, data: bytes) -> None:
        client.lines += 1
        if self._writer is None:
            self._writer = client
        if self._writer is client:
            client.awaiting += 1
            self._asked.append(client)
            self.inbox.add(ReceivedLine(client.lines, data, time.perf_counter()))
            return
        fault = error_document("somebody else is writing", "listen, or try again later")
        self._queue(client, (to_json({"line": client.lines} | fault) + "\n").encode())

    def _refuse(self, client: Client) -> None:
        """Says that this is no place for browsers, and listens no more."""
        fault = error_document(
            "the connection is closed: this is no web server, and what came is no JSON object",
            'send one JSON object a line, such as {"ask": "state"}',
        )
        if self._writer is client:
            self._writer = None
        client.refused = True
        client.unread.clear()
        client.heard = time.monotonic()
        self._queue(client, (to_json({"line": client.lines + 1} | fault) + "\n").encode())

    def _see_off(self) -> None:
        """Closes the connections of strangers that do not hang up by themselves."""
        late = time.monotonic() - _FAREWELL
        for client in list(self._clients.values()):
            if client.refused and client.heard < late:
                self._drop(client)

    def _drop(self, client: Client) -> None:
        if self._clients.pop(client.socket, None) is None:
            return
        if client.socket in self._selector.get_map():
            self._selector.unregister(client.socket)
        if self._writer is client:
            self._writer = None
        client.socket.close()
