"""Text for the terminal, without the control sequences that names and files can hold."""

import contextlib
import io
import sys
import warnings
from collections.abc import Iterator
from typing import TextIO

from ehlwave.errors import printable


class PlainText(io.TextIOBase):
    """A stream that passes on lines and tabs, and every other control character as its number."""

    def __init__(self, stream: TextIO) -> None:
        """Write to another stream."""
        self._stream = stream

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """Return the stream's attribute."""
        return getattr(self._stream, "encoding", None) or "utf-8"

    def write(self, text: str) -> int:
        """Write text, characters that the stream's encoding lacks by their numbers."""
        shown = printable(text, kept="\n\t")
        self._stream.write(shown.encode(self.encoding, "backslashreplace").decode(self.encoding))
        return len(text)

    def flush(self) -> None:
        """Flush the stream."""
        self._stream.flush()

    def writable(self) -> bool:
        """Return that it takes text."""
        return True

    def isatty(self) -> bool:
        """Return whether the stream is a terminal."""
        return self._stream.isatty()

    def fileno(self) -> int:
        """Return the number of the stream's file."""
        return self._stream.fileno()


@contextlib.contextmanager
def plain_text_only() -> Iterator[None]:
    """Send all output, errors and warnings too, through :class:`PlainText`."""
    with (
        contextlib.redirect_stdout(PlainText(sys.stdout)),  # type: ignore[type-var]
        contextlib.redirect_stderr(PlainText(sys.stderr)),  # type: ignore[type-var]
        warnings.catch_warnings(),
    ):
        warnings.showwarning = _note_warning
        warnings.simplefilter("ignore", DeprecationWarning)  # between libraries
        yield


def _note_warning(message: Warning | str, *_: object) -> None:
    """Print a warning as a single line, like all messages of commands."""
    print(f"ehlwave: warning: {' '.join(str(message).split())}", file=sys.stderr)
