"""Answers of the server before a session begins: names, origins, the page, full houses.

Apart from its token a page is the same for everybody, so it is made once. A session, some megabytes
of widgets, begins when a browser opens the socket of its page.
"""

import asyncio
from collections.abc import Callable, Collection
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import urlsplit

from bokeh.util.token import generate_jwt_token, generate_session_id
from panel.io.server import DocHandler
from tornado.httputil import HTTPServerRequest
from tornado.routing import Matcher, PathMatches, Rule
from tornado.web import RequestHandler

SOCKET = "/ws"
BUSY = "The server is busy: try again in a minute."


@dataclass
class Kept:
    """The page as it was made, with the token that it was made with."""

    page: str = ""
    token: str = ""
    lock: asyncio.Lock = field(default_factory=asyncio.Lock)


class _Page(DocHandler):
    """Answers with the page and a token of its own."""

    def __init__(self, tornado_app: Any, *args: Any, kept: Kept, **kw: Any) -> None:  # noqa: ANN401
        self._kept, self._written = kept, ""
        self._is_first = False
        super().__init__(tornado_app, *args, **kw)

    async def get(self, *args: Any, **kwargs: Any) -> None:  # noqa: ANN401
        """Make the page the first time; then put a new token into it."""
        async with self._kept.lock:
            if not self._kept.page:
                self._is_first = True
                await super().get(*args, **kwargs)  # type: ignore[misc]
                self._is_first = False
                self._kept.page = self._written
        app = self.application
        token = generate_jwt_token(
            generate_session_id(secret_key=app.secret_key, signed=app.sign_sessions),
            secret_key=app.secret_key,
            signed=app.sign_sessions,
            expiration=app.session_token_expiration,
            extra_payload=dict(self._generate_token_payload()),
        )
        self.set_header("Content-Type", "text/html")
        self.set_header("Cache-Control", "no-store")
        self.write(self._kept.page.replace(self._kept.token, token))

    async def get_session(self) -> Any:  # noqa: ANN401
        """Return the session that the page is made with."""
        session = await super().get_session()
        self._kept.token = session.token
        return session

    def write(self, chunk: Any) -> None:  # noqa: ANN401
        """Keep cached parts, send the rest."""
        if self._is_first:
            self._written += chunk
        else:
            super().write(chunk)


class _Refused(RequestHandler):
    """Answers with a status and a line of text."""

    def initialize(self, status: int, text: str) -> None:
        """Take them."""
        self._status, self._text = status, text

    def prepare(self) -> None:
        """Answer."""
        self.set_status(self._status)
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(self._text)


@dataclass
class _Foreign(Matcher):
    """Matches requests under a name that is not the server's, or from a page of another server."""

    names: Collection[str]

    def match(self, request: HTTPServerRequest) -> dict[str, Any] | None:
        origin = request.headers.get("Origin")
        known = _name(f"//{request.host}") in self.names
        return None if known and (origin is None or _name(origin) in self.names) else {}


@dataclass
class _Full(Matcher):
    """Matches sockets when there are as many sessions as may be."""

    is_full: Callable[[], bool]

    def match(self, request: HTTPServerRequest) -> dict[str, Any] | None:
        return {} if request.path == SOCKET and self.is_full() else None


def guard(tornado: Any, names: Collection[str], is_full: Callable[[], bool]) -> None:  # noqa: ANN401
    """Put these answers before Panel's.

    Parameters
    ----------
    tornado : BokehTornado
        With a single application, at ``/``.
    names : collection of str
        Hosts that browsers reach the server by.
    is_full : callable
        Returns whether no more sessions may begin.
    """
    context = tornado.applications["/"] if hasattr(tornado, "applications") else None
    context = context or tornado._applications["/"]
    page = {"application_context": context, "bokeh_websocket_path": SOCKET, "kept": Kept()}
    text = "no page of this name: start ehlwave app with --host and the name in the address bar"
    rules = tornado.default_router.rules
    rules[:0] = [
        Rule(_Foreign(frozenset(names)), _Refused, {"status": 403, "text": text}),
        Rule(_Full(is_full), _Refused, {"status": 503, "text": BUSY}),
        Rule(PathMatches("/$"), _Page, page),
    ]


def _name(address: str) -> str:
    """Return the host of an address, '' if it has none."""
    try:
        return (urlsplit(address).hostname or "").lower()
    except ValueError:
        return ""
