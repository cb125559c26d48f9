"""Steps, extents and units above the numbers of a text, each in a line of its own."""

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from ehlwave.errors import SurfaceError, printable
from ehlwave.surface.units import METRES, known_unit, split_unit

LONGEST = 300
"""Characters of a line that can state something."""

_STEP = {
    *("step", "spacing", "pitch", "increment", "dx", "delta", "step size", "sampling interval"),
    *("sampling step", "sampling distance", "sample distance", "sample spacing", "sample interval"),
    *("sampling spacing", "sampling pitch", "data spacing", "point spacing", "point distance"),
    *("pixel size", "pixel pitch", "pixel spacing", "lateral resolution", "lateral step"),
    *("measurement pitch", "measuring pitch", "data pitch", "evaluation pitch", "xy calibration"),
    *("calibration", "punktabstand", "messpunktabstand", "schrittweite", "abtastschritt"),
    *("abtastintervall", "abtastabstand", "pixelgröße", "pixelgröss", "punkteabstand", "raster"),
    *("pas", "pas de mesure", "pas d echantillonnage", "pas d échantillonnage", "paso", "passo"),
    *("intervallo di campionamento", "ピッチ", "測定ピッチ", "サンプリングピッチ", "データピッチ"),
    *("サンプリング間隔", "測定間隔", "データ間隔"),
}
_ACROSS = {"line spacing", "line distance", "profile spacing", "profile distance", "dy"}
_ACROSS |= {"zeilenabstand", "profilabstand", "linienabstand", "track spacing", "row spacing"}
_WIDTH = {"width", "breite", "largeur", "larghezza", "anchura", "幅"}
_HEIGHT = {"height", "höhe", "hoehe", "hauteur", "altezza", "altura", "高さ"}
_UNIT = {"unit", "units", "einheit", "einheiten", "unité", "unités", "unite", "unites", "unità"}
_UNIT |= {"unidad", "unidades", "単位", "exported"}
_OF_HEIGHT = {"z", "y", "height", "heights", "vertical", "profile", "amplitude", "data", "value"}
_OF_HEIGHT |= {"values", "valeur", "hauteur", "höhen", "höhe", "export", "exported", "valore"}
_OF_HEIGHT |= {"ordinate", "高さ"}
_OF_LENGTH = {"x", "xy", "lateral", "length", "horizontal", "position", "längen", "weg", "abscissa"}
_SCALE = {"z scale", "zscale", "scale z", "height scale", "z factor", "height factor", "z scaling"}
_SCALE |= {"height conversion factor", "z multiplier", "multiplier", "bit2nm", "z calibration"}

_VALUE = re.compile(
    r"(?<![\w.])[-+]?(?:\d{1,20}(?:[.,]\d{1,20})?|\.\d{1,20})(?:[eEdD][-+]?\d{1,3})?"
)
_LETTER = re.compile(r"[^\W\d_]")
_MARKS = re.compile(r"[\s:=;,\"'|]+")


@dataclass
class Statements:
    """Text above the numbers.

    ``step`` and ``step_across`` are values with their units, ``extent`` the width and height of
    a map with units.
    """

    step: tuple[float, str | None] | None = None
    step_across: tuple[float, str | None] | None = None
    length_unit: str | None = None
    height_unit: str | None = None
    extent: dict[str, tuple[float, str]] = field(default_factory=dict)


def statements_of(file: Path, lines: Iterable[str]) -> Statements:
    """Return the statements of lines.

    Raises SurfaceError if two of them contradict each other, or heights are to be multiplied.
    """
    found = Statements()
    for line in lines:
        if len(line) <= LONGEST and _LETTER.search(line):
            _state(file, found, unicodedata.normalize("NFKC", line))
    return found


def _state(file: Path, found: Statements, line: str) -> None:
    """Take the statement of a line."""
    line = line.strip(" \t#%;*!/\\\"'")
    number = _VALUE.search(line)
    if number is None:
        _take_unit(file, found, line)
        return
    key, inside = split_unit(_MARKS.sub(" ", line[: number.start()]).strip())
    words = _plain(key)
    value = _number(number[0])
    last = _MARKS.sub(" ", line[number.end() :]).strip().split(" ")[0].strip("[](){}")
    unit = known_unit(last) or (None if inside is None else known_unit(inside))
    if last and not unit and (words in _WIDTH or words in _HEIGHT):
        return  # pixels
    if _is_step(words):
        if not last or unit:
            found.step = _once(file, "step", found.step, (value, unit))
    elif words in _ACROSS:
        if not last or unit:
            found.step_across = _once(file, "step across", found.step_across, (value, unit))
    elif words in _WIDTH and unit:
        found.extent["width"] = value, unit
    elif words in _HEIGHT and unit:
        found.extent["height"] = value, unit
    elif words in _SCALE and value != 1:
        raise SurfaceError(
            f"{file}: states '{printable(line)[:60]}': multiply the heights by it, and remove "
            "this line"
        )


def _plain(key: str) -> str:
    words = re.sub(r"[^\w°]+|_", " ", key.lower()).split()
    return " ".join(words)


def _is_step(words: str) -> bool:
    parts = words.split(" ")
    if parts[0] in ("x", "xy") or (len(parts) > 1 and parts[-1] in ("x", "xy")):
        parts = parts[1:] if parts[0] in ("x", "xy") else parts[:-1]
        if parts in (["scale"], ["size"], ["resolution"], ["interval"]):
            return True
    return " ".join(parts) in _STEP


def _take_unit(file: Path, found: Statements, line: str) -> None:
    """Take ``Z-Unit: nm`` and the like."""
    words = [word.strip("[](){}") for word in _MARKS.sub(" ", line).replace("-", " ").split()]
    words = [part for word in words for part in word.split("_") if part]
    if not 2 <= len(words) <= 5:
        return
    unit, keys = known_unit(words[-1]), {word.lower() for word in words[:-1]}
    if unit is None or not keys & _UNIT:
        return
    left = keys - _UNIT - {"of", "the", "for", "axis", "achse", "der", "des", "de"}
    if left and left <= _OF_LENGTH:
        found.length_unit = _same(file, "lengths", found.length_unit, unit)
    elif left <= _OF_HEIGHT:
        found.height_unit = _same(file, "heights", found.height_unit, unit)


def _same(file: Path, what: str, old: str | None, new: str) -> str:
    if old is not None and METRES[old] != METRES[new]:
        raise SurfaceError(
            f"{file}: states two units of its {what}, {old} and {new}: remove the wrong one"
        )
    return new


def _once(
    file: Path, what: str, old: tuple[float, str | None] | None, new: tuple[float, str | None]
) -> tuple[float, str | None]:
    if old is not None and old != new:
        said = " and ".join(f"{value:g} {unit or ''}".strip() for value, unit in (old, new))
        raise SurfaceError(f"{file}: states two values of its {what}, {said}: remove the wrong one")
    return new


def _number(text: str) -> float:
    return float(text.lower().replace("d", "e").replace(",", "."))
