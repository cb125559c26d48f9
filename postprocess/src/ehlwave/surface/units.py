"""Units of length, as names and in headers."""

import re
import unicodedata

from ehlwave.errors import SurfaceError, did_you_mean

_NAMES = {
    1.0: "m meter meters metre metres mètre mètres",
    1e-2: "cm centimeter centimeters centimetre centimetres",
    1e-3: "mm millimeter millimeters millimetre millimetres millimètre millimètres MM мм",
    1e-6: "um μm Âμm Îμm UM μM μ μ-m micron microns micrometer micrometers micrometre micrometres"
    " mikrometer mikrometers micromètre micromètres мкм",
    1e-9: "nm NM nanometer nanometers nanometre nanometres nanomètre nanomètres нм",
    1e-10: "Å angstrom angstroms ångström ångströms ångstrom",
    1e-12: "pm picometer picometers picometre",
    0.0254: "in inch inches",
    2.54e-5: "mil mils thou",
    2.54e-8: "uin μin microinch microinches uinch μinch",
}
METRES = {name: metres for metres, names in _NAMES.items() for name in names.split()}
CHOICES = ("m", "mm", "um", "nm", "inch")
LONGEST_HEADING = 200
"""Characters of a heading that are looked at."""

_OTHER = {
    *("s", "ms", "us", "sec", "secs", "second", "seconds", "sek", "min", "h", "hz", "khz"),
    *("n", "mn", "un", "nn", "kn", "v", "mv", "uv", "a", "ma", "na", "pa", "kpa", "mpa", "gpa"),
    *("deg", "rad", "mrad", "urad", "°", "°c", "k", "%", "px", "pixel", "pixels", "counts"),
    *("lsb", "a.u.", "au", "-", "1", "1/0", "0/1", "mm/s", "um/s", "m/s", "db", "lux", "digit"),
    *("digits", "gf", "g", "kg", "nm/s", "grad", "1/mm", "mm/min", "um/mm", "μm/mm", "秒", "초"),
    *("degc", "degf", "°f", "bar", "w", "j", "сек", "мс", "н", "\u0441"),
}
"""Units, in small letters, of quantities that are no lengths."""


_BEHIND_A_DASH = ("s", "ms", "mn", "mv", "deg")
"""Other units that end names such as ``time_s``."""


def known_unit(text: str) -> str | None:
    """Return a unit of length by its name, None if it is none."""
    bare = unicodedata.normalize("NFKC", text).replace("µ", "μ").strip().strip(".")
    if bare in METRES:
        return bare
    return bare.lower() if len(bare) > 2 and bare.lower() in METRES else None


def is_other_unit(text: str) -> bool:
    """Return whether a text is a unit of something else than a length."""
    bare = unicodedata.normalize("NFKC", text).replace("µ", "μ").strip().lower()
    return bare in _OTHER and known_unit(text) is None


def metres(unit: str, place: str) -> float:
    """Return the length of a unit in metres.

    Raises SurfaceError if the unit is not known.
    """
    known = known_unit(unit) if isinstance(unit, str) else None
    if known is None:
        near = did_you_mean(unit.lower(), CHOICES) if isinstance(unit, str) else ""
        raise SurfaceError(
            f"{place}: unknown unit of length {unit!r}{near}; use one of {', '.join(CHOICES)}"
        )
    return METRES[known]


_BRACKETS = re.compile(r"[\[({<]([^\[\](){}<>]*)[\])}>]")
_FACTOR = re.compile(
    r"[\u00d7*·]\s?\d|\d\s?[\u00d7*·]|\b\d+ ?x\b|(?:^|[\s(\[])x ?10+\b"
    r"|\b10(?:\^|[-\u2212]\d)|\d[eE][-+\u2212]?\d"
)
"""A number that multiplies what a heading names: ``x 1000``, ``10^-3``, ``*1e3``."""


def split_unit(heading: str) -> tuple[str, str | None]:
    """Return the words and the unit of a heading, None if it has none.

    Units are in brackets (``x [um]``, ``height (nm)``), behind a mark (``x/mm``, ``x_m``, ``Weg,
    mm``) or as last word (``Lateral um``, ``z in um``). A unit may be of no length. A multiple of
    a unit, such as ``[10^-3 mm]`` or ``in 10 nm``, is none.
    """
    text = unicodedata.normalize("NFKC", heading[:LONGEST_HEADING]).strip()
    if _FACTOR.search(text):
        return text, None
    for found in _BRACKETS.finditer(text):
        inside = found[1].strip().removeprefix("in ")
        if known_unit(inside) or is_other_unit(inside):
            return f"{text[: found.start()]} {text[found.end() :]}".strip(), inside
    for mark in ("/", "_", ",", " in ", " "):
        before, _, last = text.rpartition(mark)
        last = last.strip("[](){} ")
        if not before.strip():
            continue
        if mark in (" ", " in ") and before[-1].isdigit():
            return text, None
        if known_unit(last) and (mark != " " or last.lower() not in ("m", "in", "a", "mil")):
            return before.strip(" _-,"), last
        if is_other_unit(last) and (mark in "/," or last.lower() in _BEHIND_A_DASH):
            return before.strip(" _-,"), last
    return text, None
