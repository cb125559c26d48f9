"""Puts the manual page and the completion of ``ehlwave`` into its wheel."""

import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

HOMES = ("share/man/man1/ehlwave.1", "share/bash-completion/completions/ehlwave")


class Pages(BuildHookInterface):
    """Makes them in a temporary folder: the source is not written."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Make the files, and name their places below the prefix."""
        sys.path.insert(0, str(Path(self.root) / "manual"))
        sys.dont_write_bytecode = True
        from command_pages import write_pages

        folder = tempfile.mkdtemp(prefix="ehlwave-pages-")
        pages = write_pages(Path(folder), self.metadata.version)
        build_data["shared_data"].update(zip(map(str, pages), HOMES, strict=True))
