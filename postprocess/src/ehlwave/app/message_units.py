"""Numbers of messages in the units of the fields that they were typed in."""

import re
from collections.abc import Iterable
from typing import Any

from ehlwave.quantities import ZERO_CELSIUS_K, unit_of

NUMBER = r"[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?"
SPAN = rf"({NUMBER})(?: to ({NUMBER}))?(?![\d.])"


def in_units(message: str, shown: Iterable[Any]) -> str:
    """Return a message in SI with the values of fields in the units that these fields show.

    A key whose fields show different units stays in SI.
    """
    chosen: dict[str, set[tuple[str, int | None]]] = {}
    for one in shown:
        chosen.setdefault(one.key, set()).add(one.chosen)
    message = re.sub(r"; plain numbers are in [^;(]*", "", message)
    for key, units in chosen.items():
        (unit, power), *others = units
        if power != 0 and not others:
            message = _converted(message, key, unit, power)
    return message


def _converted(message: str, key: str, unit: str, power: int | None) -> str:
    si = re.escape(unit_of(key).replace("**", "").replace("*", " "))

    def number(text: str) -> str:
        value = float(text)
        return f"{value - ZERO_CELSIUS_K if power is None else value / 10.0**power:.6g}"

    def replaced(match: re.Match[str]) -> str:
        start, low, high = match.groups()
        return f"{start}{number(low)}{f' to {number(high)}' if high else ''} {unit}"

    found = rf"\b{key} = {NUMBER} {re.escape(unit)}"
    message = re.sub(rf"(\b{key}(?: =| of) ){SPAN}(?: {si}\b)?", replaced, message)
    message = re.sub(rf"({found}: )did you mean [^?]*\? ", r"\1", message)
    for before in (rf"{found} \(of ", rf"{found}: contacts have ", rf"^{found} .*?atlas holds "):
        message = re.sub(rf"({before}){SPAN}(?: {si}\b)?", replaced, message)
    return message
