"""The server of the page: one process, a session for each browser tab, threads for the work."""

import html
import socket
from collections.abc import Sequence
from typing import Any

import panel as pn
from bokeh.server.server import Server
from panel.io.resources import LOCAL_DIST
from tornado.web import RequestHandler

from ehlwave.app.doors import BUSY, guard
from ehlwave.app.page import TITLE, Page
from ehlwave.app.task import silence_extrapolation
from ehlwave.app.uploads import LARGEST_MB
from ehlwave.app.work import Pools
from ehlwave.errors import ResultsError

MOST_SESSIONS = 40
"""Browsers at once; a session with its socket holds about 9 MB."""

MESSAGE_BYTES = 4 * 2**20
"""Largest message of a browser; files come in smaller parts."""

UNUSED_MS = 120_000
"""Until a session without a browser ends: slow computers take a while to connect."""

LOOPBACK = ("127.0.0.1", "localhost")

SERVED = r"/|/ws|/favicon\.ico|/static/(js|extensions/panel)(/([\w@^.+-]|%5E)+)+"
"""Served paths: the page, its socket, and files of Panel and Bokeh for browsers."""


class _Refused(RequestHandler):
    """Answers that there is nothing, whatever is asked."""

    def prepare(self) -> None:
        """Answer."""
        self.send_error(404)


def serve(address: str, port: int, hosts: Sequence[str] = ()) -> None:
    """Serve pages until interrupted.

    Parameters
    ----------
    address : str
        Network address to listen on.
    port : int
        0: any that is free.
    hosts : sequence of str
        Names that browsers reach it by, besides the address.

    Raises
    ------
    ResultsError
        If the address or port cannot be had.
    """
    pools = Pools()
    server = make_server(address, port, hosts, pools)
    try:
        shown = "127.0.0.1" if address in ("0.0.0.0", "") else address
        names = ", ".join(f"http://{name}:{server.port}" for name in [*hosts, shown])
        print(
            f"ehlwave app: {names} (files of {LARGEST_MB} MB at most; Ctrl+C ends it)", flush=True
        )
        server.run_until_shutdown()
    finally:
        pools.close()


def make_server(address: str, port: int, hosts: Sequence[str], pools: Pools) -> Server:
    """Return a server on a listening socket."""
    silence_extrapolation()
    pn.extension("filedropper", loading_indicator=False)
    pn.config.inline = False
    names = {*hosts, address, *(LOOPBACK if address in (*LOOPBACK, "0.0.0.0", "::") else ())}
    sessions: set[Any] = set()

    def page() -> pn.viewable.Viewable | pn.Template:
        if len(sessions) >= MOST_SESSIONS:
            return pn.pane.HTML(f"<p>{BUSY}</p>")
        document = pn.state.curdoc
        session = document.session_context.id
        sessions.add(session)
        # Set before widgets are made: sessions restarted by a socket have no page that sets it,
        # and would load their styles from elsewhere.
        document.template_variables["dist_url"] = LOCAL_DIST
        document.on_session_destroyed(lambda _: sessions.discard(session))
        return Page(pools).template()

    try:
        port = port or _free_port(address)
        server = pn.io.server.get_server(
            {"/": page},
            port=port,
            address=address,
            title=html.escape(TITLE),
            websocket_origin=[f"{name}:{port}" for name in names if name],
            websocket_max_message_size=MESSAGE_BYTES,
            unused_session_lifetime=UNUSED_MS,
        )
    except OSError as error:
        raise ResultsError(
            f"app: cannot listen on {address}, port {port} ({error.strerror or error}): name "
            "others by --address and --port"
        ) from error
    # Checked before all others: Panel serves more paths than the page needs.
    server._tornado.add_handlers(".*", [(rf"(?!(?:{SERVED})$)(.*)|(.*\.\..*)", _Refused)])
    guard(server._tornado, {name.lower() for name in names}, lambda: len(sessions) >= MOST_SESSIONS)
    return server


def _free_port(address: str) -> int:
    """Return a port that is free: origins of sockets need it before the server has one."""
    with socket.create_server((address, 0)) as found:
        return int(found.getsockname()[1])
