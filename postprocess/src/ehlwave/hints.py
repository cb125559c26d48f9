"""What errors say besides: the nearest known word, and the page of the manual."""

import difflib
from collections.abc import Iterable

MANUAL = "postprocess/manual"
"""The folder of the pages; the site of ``scripts/manual`` has them by the same names."""

PAGES = {
    "atlas": "howto.md#know-what-the-atlas-covers",
    "bodies": "howto.md#enter-two-bodies",
    "keys": "howto.md#enter-a-contact",
    "oil": "howto.md#enter-an-oil-from-its-data-sheet",
    "slip": "howto.md#enter-a-slide-to-roll-ratio",
    "units": "howto.md#enter-units",
}
"""Pages by what they are about; a test looks whether the manual has them."""


def see(topic: str) -> str:
    """Return the end of a message: which page of the manual explains."""
    return f" (manual: {MANUAL}/{PAGES[topic]})"


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Return a question for the nearest known word, in brackets; '' when none is near."""
    near = difflib.get_close_matches(word, list(known), n=1, cutoff=0.6)
    return f" (did you mean {near[0]}?)" if near else ""
