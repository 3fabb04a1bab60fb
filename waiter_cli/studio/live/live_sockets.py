"""The WebSocket ``/live``: everybody's lines to the evening, and what it says to everybody. Class `LiveSockets`.

A client first reads ``hello`` (as of ``waiter serve``) with its own number in ``you``, then the view and
the moment.  Its lines are answered in order; what one of them changed is told to the others with the
number of who said it in ``from``.  One that does not read is dropped, and nobody waits for it.
"""

from __future__ import annotations

import asyncio
import json
from typing import Any

from starlette.websockets import WebSocket, WebSocketDisconnect

from waiter_cli.serve.protocol import hello
from waiter_cli.studio.live.live_world import Ask, LiveWorld

__all__ = ["LiveSockets"]

MOST_CLIENTS = 32
MOST_UNSENT = 4 << 20
"""So many characters may wait for a client that does not read."""
MOST_UNANSWERED = 64
"""So many lines of a client may wait for their answers; no more are read before that."""
_FULL = 1013


class _Client:
    """Somebody who is connected, and what waits to be sent."""

    def __init__(self, number: int) -> None:
        self.number = number
        self.lines = 0
        self.unsent: asyncio.Queue[str | None] = asyncio.Queue()
        self.waiting = 0
        self.dropped = asyncio.Event()  # it does not read
        self.free = asyncio.Semaphore(MOST_UNANSWERED)

    def send(self, text: str) -> None:
        """Puts a text down to be sent."""
        if self.dropped.is_set():
            return
        if self.waiting + len(text) > MOST_UNSENT:
            self.dropped.set()
            return
        self.waiting += len(text)
        self.unsent.put_nowait(text)


class LiveSockets:
    """All clients of an evening; the evening speaks from a thread of its own."""

    def __init__(self, world: LiveWorld) -> None:
        self._world = world
        self._clients: dict[int, _Client] = {}
        self._admitted = 0
        self._count = 0
        self._loop: asyncio.AbstractEventLoop | None = None
        self._closing = asyncio.Event()
        world.teller.tell = self._tell

    def close(self) -> None:
        """Sees everybody off."""
        self._closing.set()
        for client in self._clients.values():
            client.unsent.put_nowait(None)

    def close_soon(self) -> None:
        """Sees everybody off; called by any thread."""
        self._soon(self.close)

    def change(self, world: LiveWorld) -> None:
        """Sends everybody to another evening; called by any thread."""
        self._world.teller.tell = lambda told: None
        self._world, world.teller.tell = world, self._tell
        self._soon(self._spread, json.dumps({"anew": True}))

    async def serve(self, socket: WebSocket) -> None:
        """Serves one client until it goes."""
        self._loop = asyncio.get_running_loop()
        if self._admitted >= MOST_CLIENTS:
            await socket.close(_FULL, "too many pages are open")
            return
        self._admitted += 1  # before anything is waited for: others come in meanwhile
        try:
            await socket.accept()
            await self._serve(socket)
        finally:
            self._admitted -= 1

    async def _serve(self, socket: WebSocket) -> None:
        """Serves a client that was let in."""
        self._count += 1
        client = _Client(self._count)
        first = {**hello(self._world.opened.layout), "you": client.number}
        client.send(json.dumps(first))
        await asyncio.to_thread(self._world.call, lambda: self._begin(client))
        reading = asyncio.create_task(self._read(socket, client))
        writing = asyncio.create_task(self._write(socket, client))
        dropped = asyncio.create_task(client.dropped.wait())
        tasks = reading, writing, dropped
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._clients.pop(client.number, None)
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)

    def _begin(self, client: _Client) -> None:
        """Tells a new client the whole of it; in the evening's thread, so nothing is missed between."""
        self._soon(self._join, client, [json.dumps(told) for told in self._world.whole()])

    def _join(self, client: _Client, texts: list[str]) -> None:
        for text in texts:
            client.send(text)
        self._clients[client.number] = client

    async def _read(self, socket: WebSocket, client: _Client) -> None:
        try:
            while True:
                message = await socket.receive()
                if message["type"] != "websocket.receive":
                    return
                text = message.get("text")
                data = message.get("bytes") or b"" if text is None else text.encode()
                await client.free.acquire()
                client.lines += 1
                self._world.ask(Ask(client.number, client.lines, data, self._answer(client)))
        except WebSocketDisconnect:
            return

    def _answer(self, client: _Client) -> Any:
        """Returns what the evening calls with the answer to a line of a client."""

        def answer(text: str, changed: bool) -> None:
            def hand_out() -> None:
                client.free.release()
                client.send(text)
                if changed and len(self._clients) > 1:
                    told = json.dumps({**json.loads(text), "from": client.number})
                    for other in self._clients.values():
                        if other is not client:
                            other.send(told)

            self._soon(hand_out)

        return answer

    async def _write(self, socket: WebSocket, client: _Client) -> None:
        while (text := await client.unsent.get()) is not None:
            client.waiting -= len(text)
            await socket.send_text(text)
        await socket.close(1001, "the studio is closed")

    def _tell(self, told: dict[str, Any]) -> None:
        """Says something to everybody; called by the evening's thread."""
        if self._clients:
            self._soon(self._spread, json.dumps(told))

    def _spread(self, text: str) -> None:
        for client in self._clients.values():
            client.send(text)

    def _soon(self, function: Any, *arguments: Any) -> None:
        if self._loop is None or self._loop.is_closed():
            return
        try:
            self._loop.call_soon_threadsafe(function, *arguments)
        except RuntimeError:  # the loop was closed just now
            return
