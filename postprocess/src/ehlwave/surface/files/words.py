"""Roles of columns and channels by the words of their headings, in several languages."""

import re
import unicodedata
from dataclasses import dataclass
from typing import Literal

from ehlwave.surface.units import is_other_unit, known_unit, split_unit

Role = Literal["x", "y", "z", "other"]

_WORDS: dict[str, str] = {
    "x": "position positions pos length distance traverse lateral path travel abscissa lateralwert"
    " weg wege länge laenge strecke abstand verfahrweg tastweg messweg abszisse vorschub ort"
    " longueur distance abscisse déplacement deplacement course posición posicion longitud"
    " distancia recorrido posizione lunghezza distanza percorso horizontal arclength afstand lengte"
    " sträcka längd strækning længde avstand droga długość odległość délka dráha vzdálenost matka"
    " pituus etäisyys távolság hossz mesafe uzunluk distância comprimento длина расстояние путь",
    "z": "height heights höhe hoehe höhen hoehen hohe höhenwert höhenwerte hauteur altitude altura"
    " altezza quota elevation topography topographie topografie topo map depth tiefe profondeur"
    " roughness rauheit rauhigkeit rugosité rugosite rugosidad rugosità waviness welligkeit"
    " ondulation deviation abweichung écart ecart vertical ordinate ordonnée auslenkung zsensor"
    " heightsensor zsens profundidad profundidade profondità hoogte diepte ruwheid höjd djup højde"
    " høyde wysokość głębokość chropowatość výška hloubka drsnost korkeus syvyys magasság mélység"
    " yükseklik derinlik высота глубина шероховатость",
    "weak": "profile profil profils profiles profilo perfil profildaten amplitude level raw"
    " primary total data wert messwert value values signal surface oberfläche displacement",
    "count": "no nr nummer number num index idx zeile zeilennummer row line ligne spalte column col"
    " point points punkt punkte punktnummer messpunkt sample samples id count lfd lfdnr numéro"
    " numero n° nb pt pts rij rad wiersz lp řádek номер строка",
    "other": "time zeit temps tiempo tempo uhrzeit timestamp date datum intensity intensität"
    " intensitaet quality qualität valid gültig mask maske temperature temperatur force kraft load"
    " last friction reibung speed geschwindigkeit velocity vitesse error fehler phase voltage"
    " spannung current strom red green blue rgb weight gewicht brightness helligkeit confidence"
    " deflection lateralforce status flag valide valid stderr std sigma angle winkel slope steigung"
    " neigung pente gradient curvature krümmung krit err errors setpoint sollwert tid tijd czas čas"
    " aika idő zaman время siła síla сила fft psdf acf histogram difference differenz background"
    " untergrund noise rauschen",
}
_ROLES = {word: role for role, words in _WORDS.items() for word in words.split()}
_ENDS = {
    **dict.fromkeys(("weg", "länge", "laenge", "strecke", "position", "abstand"), "x"),
    **dict.fromkeys(("höhe", "hoehe", "höhen", "tiefe", "abweichung", "rauheit"), "z"),
    **dict.fromkeys(("profil", "profile", "wert"), "weak"),
    **dict.fromkeys(("nummer", "index", "zeile", "spalte", "nr"), "count"),
    **dict.fromkeys(("zeit", "kraft", "geschwindigkeit", "temperatur", "stempel"), "other"),
}
_IDEOGRAMS = {
    "z": (
        "高さ",
        "高度",
        "粗さ",
        "変位",
        "うねり",
        "深さ",
        "高低",
        "粗糙",
        "높이",
        "깊이",
        "거칠기",
    ),
    "x": ("位置", "距離", "距离", "長さ", "长度", "水平", "横方向", "送り", "거리", "위치", "길이"),
    "count": ("番号", "行番", "点数", "序号", "编号", "行号", "번호"),
    "other": (
        "時間",
        "时间",
        "時刻",
        "強度",
        "强度",
        "輝度",
        "荷重",
        "温度",
        "速度",
        "시간",
        "온도",
    ),
    "weak": ("断面", "曲線", "形状", "データ", "轮廓"),
}
SHIFT_JIS_WORDS = (
    *(word for words in _IDEOGRAMS.values() for word in words),
    *("間隔", "単位", "測定", "ピッチ"),
)
"""Words that distinguish a text in Shift-JIS from Latin-1."""


@dataclass(frozen=True)
class Heading:
    """A heading: its text, the role of its column, and its unit of length."""

    text: str
    role: Role | None
    """None: the words do not decide it."""
    unit: str | None


def heading_of(text: str) -> Heading:
    """Return the role and the unit of a heading; times, numbers of rows and forces are other.

    A column without a name among named columns numbers the rows: it counts as other, too.
    """
    if not text.strip():
        return Heading(text, "other", None)
    words, unit = split_unit(text.strip().strip('"'))
    length = None if unit is None else known_unit(unit)
    if unit is not None and length is None and is_other_unit(unit):
        return Heading(text, "other", None)
    return Heading(text, _role(words, length is not None), length)


def words_of(text: str) -> list[str]:
    """Return the words of a heading in small letters, parted at capitals and digits, too."""
    apart = re.sub(r"(?<=[a-z]{2})(?=[A-Z])", " ", unicodedata.normalize("NFKC", text))
    return re.findall(r"(?:[^\W\d_\u3000-\U0010ffff]|°)+|[\u3000-\U0010ffff]+", apart.lower())


def _role(text: str, has_length: bool) -> Role | None:
    letters = words_of(text)
    kinds = {kind for word in letters for kind in _kinds(word)}
    if "#" in text:
        kinds.add("count")
    if "other" in kinds or ("count" in kinds and not has_length):
        return "other"
    axes = {word for word in letters if word in ("x", "y", "z")}
    if len(axes) == 1:
        return axes.pop()  # type: ignore[return-value]
    if axes or kinds >= {"x", "z"}:
        return None
    if "x" in kinds:
        return "x"
    return "z" if kinds & {"z", "weak"} else None


def _kinds(word: str) -> set[str]:
    """Return the kinds of quantities that a word names."""
    if word in _ROLES:
        return {_ROLES[word]}
    if word.isascii() or not any(ord(letter) > 0x3000 for letter in word):
        return {kind for end, kind in _ENDS.items() if len(word) > len(end) and word.endswith(end)}
    return {kind for kind, parts in _IDEOGRAMS.items() if any(part in word for part in parts)}
