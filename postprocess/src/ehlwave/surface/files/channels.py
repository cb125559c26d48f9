"""The choice of the channel of heights in files that hold several."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ehlwave.errors import SurfaceError, printable
from ehlwave.surface.files.words import heading_of, words_of

_PLAIN = ("default", "channel", "data", "main", "raw")
"""Names without information."""


def chosen_channel(file: Path, channels: Sequence[Any], wanted: str | None = None) -> Any:  # noqa: ANN401
    """Return the channel of heights.

    Parameters
    ----------
    file : path
        Begins every message.
    channels : sequence
        Of a reader of SurfaceTopography, with names.
    wanted : str or None
        The name of the channel.

    Raises
    ------
    SurfaceError
        If no channel, or several, can be the heights.
    """
    if not channels:
        raise SurfaceError(f"{file}: holds no channel of heights")
    if wanted is not None:
        same = [one for one in channels if str(one.name).casefold() == wanted.strip().casefold()]
        if len(same) == 1:
            return same[0]
        raise SurfaceError(
            f"{file}: channel={wanted!r} is {'none' if not same else 'several'} of its channels "
            f"{_listed(channels)}"
        )
    heights = [one for one in channels if getattr(one, "is_height_channel", True)] or channels
    named = [one for one in heights if _is_height(str(one.name))]
    plain = [one for one in heights if str(one.name).casefold().startswith(_PLAIN)]
    for found in (named, plain if len(heights) == 1 else [], _unnamed(heights)):
        if len(found) == 1:
            return found[0]
        if found:
            break
    raise SurfaceError(
        f"{file}: which channel holds the heights? It has {_listed(channels)}: choose by channel="
    )


def _unnamed(heights: Sequence[Any]) -> list[Any]:
    """Return the only channel, unless its name belongs to another quantity."""
    if len(heights) != 1:
        return []
    other = {"amplitude", "phase", "error", "deflection", "friction", "lateral", "current"}
    name = str(heights[0].name)
    is_other = heading_of(name).role == "other" or {*words_of(name)} & other
    return [] if is_other else [heights[0]]


def _is_height(name: str) -> bool:
    return heading_of(name).role == "z" and not {*words_of(name)} & {"amplitude", "raw", "error"}


def _listed(channels: Sequence[Any]) -> str:
    return ", ".join(repr(printable(str(one.name))[:40]) for one in list(channels)[:12])
