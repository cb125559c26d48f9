"""``ehlwave app``."""

import argparse
from importlib.util import find_spec
from typing import Any

from ehlwave.errors import ResultsError
from ehlwave.extras import install

ADDRESS, PORT = "127.0.0.1", 5006

DESCRIPTION = f"""\
Serve a page that answers in a browser: contact, oil and a measured trace in; film, lambda ratio,
deformed profile, errors and parts not judged out. It saves JSON and a script that repeats it.

Only this computer can open the page unless --address is given. There is no password: whoever
reaches the address can compute. Nothing is kept, and no other host is asked for anything.

One server for an office, opened in browsers as http://ehl.example.com:{PORT}:
  ehlwave app --address 0.0.0.0 --host ehl.example.com"""


def add_app_command(commands: Any) -> None:  # noqa: ANN401 - argparse does not name this type
    """Add the command to the parsers of ``ehlwave``."""
    app = commands.add_parser(
        "app",
        help="serve a page that answers in a browser",
        description=DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    text = f"network address to listen on (default: {ADDRESS}, this computer alone)"
    app.add_argument("--address", default=ADDRESS, metavar="IP", help=text)
    text = f"default: {PORT}; 0: any that is free"
    app.add_argument("--port", type=_port, default=PORT, metavar="N", help=text)
    text = "name or address in the browser's address bar, where it is not --address; repeatable"
    app.add_argument("--host", action="append", default=[], metavar="NAME", help=text)
    app.set_defaults(run=_serve)


def _port(text: str) -> int:
    if not text.isdecimal() or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"{text!r} is not a port: give 0 to 65535")
    return int(text)


def _serve(options: argparse.Namespace) -> None:
    if find_spec("panel") is None:
        raise ResultsError(f"app: Panel is not installed: {install('app')}")
    from ehlwave.app.server import serve  # needs Panel

    serve(options.address, options.port, options.host)
