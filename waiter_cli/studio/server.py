"""The studio's server: what a browser may ask for, on the loopback address alone. Entry point `serve_studio`.

==================  =============================================================================
``GET /``           the empty shell, for anybody
``GET /healthz``    ``ok``, for anybody
``POST /token``     ``{"token": …}`` from the address's fragment → the cookie, once
``GET /page/NAME``  a file of the page
``/live``           the WebSocket of `waiter_cli.studio.live.live_sockets`
``GET /keep/NAME``  a keepsake of `waiter_cli.studio.keepsakes`
``POST /do/anew``   an evening begins in the layout as it was saved
``POST /do/NAME``   an action of `waiter_cli.studio.page_actions`
==================  =============================================================================
"""

from __future__ import annotations

import asyncio
import json
import socket
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.files.documents import fault_document
from waiter_cli.studio.begin import CurrentEvening
from waiter_cli.studio.gate import Gate, Keys, TokenRefused
from waiter_cli.studio.keepsakes import KEEPSAKES
from waiter_cli.studio.live.live_world import LiveWorld
from waiter_cli.studio.opened import Opened
from waiter_cli.studio.page_actions import ACTIONS
from waiter_cli.studio.page_files import page_files
from waiter_cli.studio.page_requests import BadRequest

if TYPE_CHECKING:
    from types import FrameType

    import uvicorn
    from starlette.requests import Request
    from starlette.responses import Response

    from waiter_cli.studio.live.live_sockets import LiveSockets

__all__ = ["bind_port", "make_app", "serve_studio"]

GRACE = 0.3
"""Seconds that answers under way have once the studio is to end."""


def bind_port(port: int) -> socket.socket:
    """Returns a socket of this machine; raises `InputError` where the port cannot be had."""
    # The protocol is named, or asyncio would leave TCP_NODELAY out, and answers wait 40 ms for the client.
    found = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        found.bind(("127.0.0.1", port))
        found.listen(128)
    except OSError as error:
        found.close()
        why = (error.strerror or str(error)).lower()
        hint = "choose another port; without --port any that is free is taken"
        raise InputError([Fault(Where("--port"), f"cannot listen there: {why}", hint)]) from None
    return found


def make_app(current: CurrentEvening, port: int, keys: Keys, sockets: LiveSockets) -> Gate:
    """Returns the ASGI application behind its gate."""
    from starlette.applications import Starlette
    from starlette.concurrency import run_in_threadpool
    from starlette.responses import JSONResponse, PlainTextResponse, Response
    from starlette.routing import Route, WebSocketRoute

    async def shell(request: Request) -> Response:
        answer = _file("index.html")
        if keys.admits(request.headers.get("cookie", "")):
            answer.headers["set-cookie"] = keys.cookie()
        return answer

    async def start(request: Request) -> Response:
        return _file("start.js")

    async def icon(request: Request) -> Response:
        return _file("icon.svg")

    async def health(request: Request) -> Response:
        return PlainTextResponse("ok")

    async def token(request: Request) -> Response:
        given = _object(await request.body()) or {}
        try:
            return JSONResponse({}, headers={"set-cookie": keys.trade(given.get("token"))})
        except TokenRefused as refused:
            return _fault(403, refused.message, refused.hint)

    async def page(request: Request) -> Response:
        return _file(request.path_params["name"])

    async def keep(request: Request) -> Response:
        name = request.path_params["name"]
        found, opened = KEEPSAKES.get(name), current.opened
        if found is None or opened.live is None:
            return _fault(404, "there is nothing of that name to keep")
        try:
            text = await run_in_threadpool(found.make, opened, opened.live)
        except BadRequest as fault:
            return _fault(400, fault.message, fault.hint)
        told = {"content-disposition": f'attachment; filename="{name}"'}
        return Response(text, media_type=found.media, headers=told)

    async def do(request: Request) -> Response:
        name = request.path_params["name"]
        action = ACTIONS.get(name)
        if action is None and name != "anew":
            return _fault(404, "there is no such action")
        given = _object(await request.body())
        if given is None:
            return _fault(400, "the body must be a JSON object")
        try:
            if action is None:
                await run_in_threadpool(current.begin_anew)
                return JSONResponse({})
            return JSONResponse(await run_in_threadpool(action, current.opened, given))
        except BadRequest as fault:
            return _fault(fault.status, fault.message, fault.hint)
        except InputError as error:
            faults = [fault_document(fault) for fault in error.faults]
            return JSONResponse({"error": {**faults[0], "faults": faults}}, 400)

    routes = [
        Route("/", shell),
        Route("/start.js", start),
        Route("/icon.svg", icon),
        Route("/healthz", health),
        Route("/token", token, methods=["POST"]),
        Route("/page/{name}", page),
        Route("/keep/{name}", keep),
        Route("/do/{name}", do, methods=["POST"]),
        WebSocketRoute("/live", sockets.serve),
    ]
    return Gate(Starlette(routes=routes), port, keys)


def _make_server(config: uvicorn.Config, sockets: LiveSockets) -> uvicorn.Server:
    """Returns a server that sees off those who are connected as soon as it is told to end."""
    import uvicorn

    class StudioServer(uvicorn.Server):
        def handle_exit(self, sig: int, frame: FrameType | None) -> None:
            super().handle_exit(sig, frame)
            sockets.close()

    return StudioServer(config)


def serve_studio(
    opened: Opened, live: LiveWorld, listening: socket.socket, announce: Callable[[str], None]
) -> None:
    """Serves until the process is told to end; ``announce`` is told the address first.

    Whoever comes meanwhile waits in the queue of ``listening``: a browser starts while the server is loaded.
    """
    port = listening.getsockname()[1]
    keys = Keys(port)
    announce(f"http://127.0.0.1:{port}/#{keys.token}")
    import uvicorn

    from waiter_cli.studio.live.live_sockets import LiveSockets

    sockets = LiveSockets(live)

    def end() -> None:
        server.should_exit = True
        sockets.close_soon()

    current = CurrentEvening(opened, live, sockets.change, end)
    config = uvicorn.Config(
        make_app(current, port, keys, sockets),
        log_config=None,
        access_log=False,
        lifespan="off",
        server_header=False,
        date_header=False,
        ws_max_size=1 << 20,
        ws_per_message_deflate=False,
        timeout_graceful_shutdown=GRACE,  # type: ignore[arg-type]
    )
    server = _make_server(config, sockets)
    with current:
        asyncio.run(server.serve([listening]))


def _file(name: str) -> Response:
    from starlette.responses import PlainTextResponse, Response

    found = page_files().get(name)
    if found is None:
        return PlainTextResponse("there is no such file\n", 404)
    return Response(found[0], media_type=found[1])


def _object(body: bytes) -> dict[str, Any] | None:
    """Returns the JSON object of a body, None where it is none."""
    try:
        found = json.loads(body)
    except (ValueError, RecursionError):
        return None
    return found if isinstance(found, dict) else None


def _fault(status: int, message: str, hint: str | None = None) -> Response:
    from starlette.responses import JSONResponse

    return JSONResponse({"error": {"message": message, "hint": hint}}, status)
