"""One connection: its input and output buffers, and whether it speaks the protocol.

Entry points `Client` and `foreign`.  A web page can make a browser connect to any port of this
machine and send what it likes behind a request line.  So the first byte that is no white space must
begin a JSON object, and no line may look like a request line or a header of HTTP.
"""

from __future__ import annotations

import re
import socket
from dataclasses import dataclass, field

from waiter_cli.serve.protocol import MAX_LINE

__all__ = ["Client", "foreign"]

_BOM = b"\xef\xbb\xbf"
_REQUEST = re.compile(rb"\s*[!-~]{1,40} +\S{1,65536} +HTTP/\d", re.IGNORECASE)
_HEADER = re.compile(
    rb"\s*(host|origin|referer|user-agent|content-(type|length)|connection|cookie|accept"
    rb"|transfer-encoding|upgrade|sec-[a-z-]+)\s*:",
    re.IGNORECASE,
)


@dataclass(eq=False)
class Client:
    """One connection; ``heard`` is when it last sent something or took what it was told."""

    socket: socket.socket
    heard: float
    unread: bytearray = field(default_factory=bytearray)
    unsent: bytearray = field(default_factory=bytearray)
    lines: int = 0
    awaiting: int = 0
    """So many of its lines are not answered yet."""
    skipping: bool = False
    """The rest of a line that was too long is left out."""
    known: bool = False
    """It began as a client begins."""
    ended: bool = False
    """It will send nothing more; some of that may be unread still."""
    refused: bool = False
    """It is no client of ours: whatever else it sends is thrown away."""
    _searched: int = 0

    def next_line(self) -> bytes | None:
        """Takes the next whole line out of what came in, without its end; None when there is none.

        Of a line that is too long only so much is kept that this can be seen.
        """
        while True:
            end = self.unread.find(b"\n", self._searched)
            if end >= 0:
                line = bytes(self.unread[:end])
                del self.unread[: end + 1]
                self._searched = 0
                if self.skipping:
                    self.skipping = False
                    continue
                return line.rstrip(b"\r")[: MAX_LINE + 1]
            if len(self.unread) > MAX_LINE:
                line = bytes(self.unread[: MAX_LINE + 1])
                self.unread.clear()
                self._searched = 0
                if self.skipping:
                    return None
                self.skipping = True
                return line
            self._searched = len(self.unread)
            if self.ended and self.unread and not self.skipping:
                line = bytes(self.unread)
                self.unread.clear()
                self._searched = 0
                return line
            return None

    def stranger(self) -> bool:
        """Returns whether the first input is no JSON object; it may be too early to tell."""
        if self.known:
            return False
        if _BOM.startswith(self.unread[:3]):
            if len(self.unread) < 3:
                return False
            del self.unread[:3]
        begun = self.unread.lstrip()
        self.known = begun.startswith(b"{")
        return bool(begun) and not self.known


def foreign(line: bytes) -> bool:
    """Returns whether a line is one of HTTP: a request line, or a header that browsers send.

    >>> foreign(b"GET / HTTP/1.1"), foreign(b"Origin: null"), foreign(b'{"ask": "plan"}')
    (True, True, False)
    """
    return bool(_REQUEST.match(line) or _HEADER.match(line))
