"""Words, texts in quotes and punctuation of an input file, in order.

The grammar matches the programs (``src/io/namelist_tokens.f90``). A differential test holds both
readers to the same verdicts, messages and values.
"""

import re
from dataclasses import dataclass

from ehlwave.errors import SurfaceError

END, WORD, QUOTED = "end", "word", "quoted"
"""Kinds of tokens; the others are their own character."""
PUNCTUATION = b"&/,=("
MARK = b"\xef\xbb\xbf"
"""Byte order mark, which editors put before UTF-8."""
MOST_SHOWN = 60

_BLANKS = re.compile(rb"[ \t\n\r]*")
_LINE_REST = re.compile(rb"[^\n\r]*")
_WORD = re.compile(rb"[^ \t\n\r'\",/=!(]*")
_NOT_PLAIN = re.compile(rb"[^\x20-\x7e]")
_LETTER = re.compile(
    rb"[\x20-\x7e]+|\xc2[\xa0-\xbf]|[\xc3-\xdf][\x80-\xbf]|[\xe0-\xef][\x80-\xbf]{2}"
    rb"|[\xf0-\xf4][\x80-\xbf]{3}"
)


@dataclass(frozen=True)
class Token:
    """A word, a text in quotes, a punctuation mark or the end of the file."""

    kind: str
    text: bytes
    """As written, without quotes."""
    line: int
    is_attached: bool
    """Whether no blank separates this token from the previous one."""


def shown(text: bytes) -> str:
    """Return a text for a message: short, without bytes that a terminal obeys or cannot show."""
    kept, at = text[:MOST_SHOWN], 0
    clean = b""
    while at < len(kept):
        found = _LETTER.match(kept, at)
        clean += found[0] if found else b"?"
        at = found.end() if found else at + 1
    return clean.decode("utf-8", "replace") + ("..." if len(text) > MOST_SHOWN else "")


class Tokens:
    """A place in the text of an input file."""

    def __init__(self, path: str, text: bytes) -> None:
        self.path, self.text = path, text
        self.at, self.line = 0, 1

    def fail(self, line: int, message: str) -> SurfaceError:
        """Return the error about a line."""
        return SurfaceError(f"{self.path}:{line}: {message}")

    def take(self) -> Token:
        """Return the next token; comments, blanks and a byte order mark are passed over."""
        if self.at == 0 and self.text.startswith(MARK):
            self.at = len(MARK)
        first = self.at
        self._skip_blanks()
        attached, line = self.at == first, self.line
        mark = self.text[self.at : self.at + 1]
        if not mark:
            return Token(END, b"the end of the file", line, attached)
        if mark in PUNCTUATION:
            self.at += 1
            return Token(mark.decode(), mark, line, attached)
        if mark in b"'\"":
            return Token(QUOTED, self._take_quoted(mark), line, attached)
        return Token(WORD, self._take_word(), line, attached)

    def _skip_blanks(self) -> None:
        """Pass blanks, line ends and comments; CR LF, LF and CR each end a line once."""
        first = self.at
        while True:
            self.at = self._end_of(_BLANKS)
            if self.text[self.at : self.at + 1] != b"!":
                break
            self.at = self._end_of(_LINE_REST)
        passed = self.text[first : self.at]
        self.line += passed.count(b"\n") + passed.count(b"\r") - passed.count(b"\r\n")

    def _end_of(self, pattern: re.Pattern[bytes]) -> int:
        """Return the end of a match at the current place, of a pattern that may match nothing."""
        found = pattern.match(self.text, self.at)
        return found.end() if found else self.at

    def _take_word(self) -> bytes:
        """Return the characters up to a separator."""
        first, self.at = self.at, self._end_of(_WORD)
        word = self.text[first : self.at]
        if _NOT_PLAIN.search(word):
            raise self.fail(
                self.line,
                "a character that is not plain ASCII stands outside quotes and comments: retype it "
                "(often a pasted quote, dash or blank)",
            )
        return word

    def _take_quoted(self, mark: bytes) -> bytes:
        """Return the text between quotes; a doubled quote gives a single quote."""
        parts, start, line_end = [], self.at + 1, self._end_of(_LINE_REST)
        while True:
            stop = self.text.find(mark, start, line_end)
            if stop < 0:
                raise self.fail(
                    self.line,
                    f"quote without its partner: close the text with {mark.decode()} on the line "
                    "where it begins",
                )
            parts.append(self.text[start:stop])
            self.at = stop + 1
            if self.text[stop + 1 : stop + 2] != mark:
                return b"".join(parts)
            parts.append(mark)
            start = stop + 2
