"""The choice of the columns of positions and heights by their headings."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ehlwave.errors import SurfaceError, printable
from ehlwave.surface.files.words import Heading


@dataclass(frozen=True)
class Chosen:
    """Columns of a table.

    ``positions`` has none, one (along the trace) or two (x and y); ``note`` names them.
    """

    positions: tuple[int, ...]
    height: int
    note: str


def chosen_columns(
    file: Path, headings: Sequence[Heading], channel: str | None = None
) -> Chosen | None:
    """Return columns by their headings; None if these do not name any.

    Headings with a unit of length come first. Times, numbers of rows, forces and the like are
    neither positions nor heights.

    Raises SurfaceError if headings name several columns of heights or of positions, and `channel`
    does not select the height.
    """
    everything = range(len(headings))
    if channel is None and not any(one.role or one.unit for one in headings):
        return None
    x, y, z, free = (
        [k for k in everything if headings[k].role == role] for role in ("x", "y", "z", None)
    )
    if channel is not None:
        z = [_named(file, headings, channel)]
        x, y, free = ([k for k in held if k not in z] for held in (x, y, free))
    z = _with_units(headings, z)
    with_unit = [k for k in free if headings[k].unit]
    if not z and x and len(y) == 1:
        z, y = y, []
    elif not z and len(with_unit or free) == 1:
        z = with_unit or free
        free = []
    if not z:
        if not x and not y and len(free) == len(headings):
            return None
        raise SurfaceError(
            f"{file}: no column of heights among {_listed(headings, everything)}: name it by "
            "channel=, or put a heading such as z [um] above it"
        )
    if len(z) > 1:
        raise SurfaceError(
            f"{file}: several columns can be the height, {_listed(headings, z)}: say which by "
            "channel="
        )
    positions = _positions(file, headings, x, y, [k for k in free if k not in z])
    names = [printable(headings[k].text)[:40] for k in (*positions, z[0])]
    places = " and ".join(repr(name) for name in names[:-1]) or "none"
    return Chosen(positions, z[0], f"columns: positions {places}, heights {names[-1]!r}")


def _positions(
    file: Path, headings: Sequence[Heading], x: list[int], y: list[int], free: list[int]
) -> tuple[int, ...]:
    """Return a column of positions, two columns of x and y, or none."""
    x, y = _with_units(headings, x), _with_units(headings, y)
    if not x and not y:
        with_unit = [k for k in free if headings[k].unit]
        x = with_unit or (free if len(headings) == 2 else [])
    for held in (x, y):
        if len(held) > 1:
            raise SurfaceError(
                f"{file}: several columns can be the position, {_listed(headings, held)}: remove "
                "the others"
            )
    return (*x, *y)


def _with_units(headings: Sequence[Heading], held: list[int]) -> list[int]:
    """Return the columns with a unit of length, or all if none has a unit of length."""
    return [k for k in held if headings[k].unit] or held


def _named(file: Path, headings: Sequence[Heading], channel: str) -> int:
    """Return the column that a user names, by its heading or the beginning of it."""
    wanted = channel.strip().casefold()
    texts = [one.text.strip().casefold() for one in headings]
    for found in (
        [k for k, text in enumerate(texts) if text == wanted],
        [k for k, text in enumerate(texts) if text.startswith(wanted)],
    ):
        if len(found) == 1:
            return found[0]
    raise SurfaceError(
        f"{file}: channel={channel!r} is none of its columns"
        + (
            f" {_listed(headings, range(len(headings)))}"
            if headings
            else ", which have no headings"
        )
    )


def _listed(headings: Sequence[Heading], held: Sequence[int] | range) -> str:
    names = [repr(printable(headings[k].text)[:40]) for k in list(held)[:12]]
    return ", ".join(names)
