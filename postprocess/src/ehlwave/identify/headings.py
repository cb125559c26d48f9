"""Headings of rigs' tables: a quantity in words, and its unit in brackets."""

import re
import unicodedata

from ehlwave.errors import ArgumentError
from ehlwave.quantities import ZERO_CELSIUS_K

_SPEED = ({"m/s": 1.0, "mm/s": 1e-3}, "mean_speed_m_per_s")
_FILM = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
_SHARE = {"1": 1.0, "-": 1.0, "%": 1e-2}
_CENTRAL, _SMALLEST = (_FILM, "central_film_m"), (_FILM, "minimum_film_m")
_FRICTION = ({"": 1.0, **_SHARE}, "friction_coefficient")
_SLIDE = (_SHARE, "slide_to_roll_ratio")
_HEAT = ({"c": 1.0, "degc": 1.0, "deg c": 1.0, "k": 1.0}, "temperature_k")

QUANTITIES = {
    **dict.fromkeys(("speed", "mean speed", "entrainment speed", "entrainment velocity"), _SPEED),
    **dict.fromkeys(("srr", "slide to roll ratio", "slide roll ratio"), _SLIDE),
    **dict.fromkeys(("load", "normal load", "normal force"), ({"n": 1.0, "kn": 1e3}, "load_n")),
    **dict.fromkeys(("temperature", "oil temperature", "temp"), _HEAT),
    **dict.fromkeys(("film", "film thickness", "central film", "central film thickness"), _CENTRAL),
    **dict.fromkeys(
        ("minimum film", "minimum film thickness", "smallest film", "min film thickness"), _SMALLEST
    ),
    **dict.fromkeys(
        ("traction coefficient", "friction coefficient", "coefficient of friction", "cof"),
        _FRICTION,
    ),
}
"""Words of a heading: factors of units, and the key or result in SI units."""

_UNIT = re.compile(r"^(?P<words>[^\[(]*?)\s*[\[(](?P<unit>[^\])]*)[\])]\s*$")


def rig_heading(heading: str, place: str) -> tuple[str, float, float] | None:
    """Return key or result of a heading in words, with factor and offset; None: not of a rig.

    Raises
    ------
    ArgumentError
        If the quantity is known and its unit is not.

    Examples
    --------
    >>> rig_heading("Film thickness (nm)", "table")
    ('central_film_m', 1e-09, 0.0)
    >>> rig_heading("SRR [%]", "table")
    ('slide_to_roll_ratio', 0.01, 0.0)
    """
    text = unicodedata.normalize("NFKC", heading).lower().replace("μ", "u").replace("°", "")
    parts = _UNIT.match(text)
    words, unit = (parts["words"], parts["unit"].strip()) if parts else (text, "")
    words = " ".join(re.split(r"[\s_-]+", words.strip()))
    if words not in QUANTITIES:
        return None
    units, name = QUANTITIES[words]
    if unit not in units:
        known = ", ".join(f"[{one}]" for one in units if one)
        given = f"has the unit {unit}" if unit else "has no unit"
        raise ArgumentError(f"{place}: column {heading} {given}: write one of {known} behind it")
    return name, units[unit], ZERO_CELSIUS_K if name == "temperature_k" and unit != "k" else 0.0
