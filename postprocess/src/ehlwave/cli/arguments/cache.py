"""Arguments of ``ehlwave cache``."""

import argparse
from typing import Any

from ehlwave.cli.arguments.shared import later

DESCRIPTION = """\
List or clear the kept results of computed contacts. Contacts that no law holds for are computed by
ehlwave-case and ehlwave-sweep, and the results are kept on disk, so that the same question is
answered at once.

Folder: EHLWAVE_CACHE, else ehlwave in XDG_CACHE_HOME or ~/.cache. It can be removed at any time."""


def add_cache_command(commands: Any) -> None:  # noqa: ANN401 - argparse does not name this type
    """Add the command to the parsers of ``ehlwave``."""
    parser = commands.add_parser(
        "cache",
        help="list or clear kept results of computed contacts",
        description=DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--clear", action="store_true", help="remove all kept results")
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    parser.set_defaults(run=later("ehlwave.cli.cache", "run_cache"))
