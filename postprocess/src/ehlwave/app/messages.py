"""Names of results and messages in the words of the page, without Python."""

import re
from collections.abc import Iterable, Mapping
from html import escape
from typing import Any

from ehlwave.app.element_quantities import TABS
from ehlwave.app.message_units import in_units
from ehlwave.app.quantities import every_quantity
from ehlwave.shown import split_words

LABELS = {one.key: one.label for one in every_quantity()} | {
    one.key: one.label
    for tab in TABS.values()
    for asked in tab.values()
    for p in asked
    for one in p
}
"""Labels of the fields of all tabs by their keys."""
NAMES = {
    "central_m": "Central film",
    "minimum_m": "Minimum film",
    "central_moes": "Central film (Moes)",
    "minimum_moes": "Minimum film (Moes)",
    "friction": "Friction coefficient",
    "rolling_resistance": "Rolling resistance, N (line: N/m)",
    "rolling_resistance_coefficient": "Rolling resistance over load",
    "film_factor": "Film with heat over film without",
    "inlet_factor": "of it by the warm inlet",
    "minimum_factor": "Minimum film with heat over film without",
    "isothermal_friction": "Friction coefficient without heat",
    "rise_mid_film_k": "Temperature rise, mid-film",
    "rise_surfaces_k": "Temperature rise, surfaces",
    "rq_before_m": "Rq outside the contact",
    "rq_after_m": "Rq in the contact",
    "rz_before_m": "Lowest to highest point, outside",
    "rz_after_m": "Lowest to highest point, in the contact",
    "mean_film_m": "Mean film",
    "mean_rise_m": "Rise of the mean film by the roughness",
    "minimum_film_m": "Smallest film",
    "surfaces_touch": "Surfaces touch",
    "lambda_ratio_before": "Lambda ratio, roughness as made",
    "lambda_ratio_after": "Lambda ratio, roughness in the contact",
    "lambda_errors": "Part of the lambda error",
    "lambda_error": "Lambda error",
    "amplitude_over_film": "Amplitude over film",
}
"""Names of results on the page."""

PLAIN = (
    (r"give heat data \(heat=\)", "choose 'with heat' under Film and friction"),
    (
        r"heat=True needs oil=ehlwave\.Oil\(\.\.\.\)",
        "'with heat' needs 'Grade or data sheet' or 'Measured oil' under Oil by",
    ),
    (r"heat=True: body(\d) has no \w+: give .*", r"'with heat' needs a known material of body \1"),
    (r"heat=True: the oil has no (\w+), .*", r"'with heat' needs a value that the oil lacks: \1"),
    (r"\s*\(manual: [^)]*\)", ""),
    (r"^ehlwave-(?:case|sweep): ", ""),
    (r"compute it: ehlwave-case, ehlwave\.Case", "compute it with the program ehlwave-case"),
    (r"compute it \(ehlwave\.Case[^)]*\)", "compute it with the program ehlwave-case"),
    (r"\b(\w+)=\(\w+, \w+\)", r"\1"),
    (r"used when named: by='[\w-]+'", "used when chosen under Judged by"),
    (r"\s*\(\w+=\)", ""),
    (r"^(?:Contact|Body|Oil|Heat)(?:\.\w+)?: ", ""),
    (r"\b(?:ehlwave\.)?(?:Contact|Body|Oil|Heat)\.(\w+)(?:\(\))?", r"\1"),
    (r"""\b(\w+)=(["'])(\w+)\2""", r"\1 = \3"),
    (r"\b(\w+)=(?=[\s,;.:)]|$)", r"\1"),
    (r"(?<!\w)--(\w)", r"\1"),
)
"""Python of messages, and its replacement on the page."""

SYMBOLS = {"rq": "Rq", "rz": "Rz", "lambda": "Lambda"}


def words(name: str) -> str:
    """Return the name of a result on the page."""
    if name in NAMES:
        return NAMES[name]
    ends = ("_m", "_pa", "_k", "_n")
    plain_name = next((name[: -len(end)] for end in ends if name.endswith(end)), name)
    first, *rest = plain_name.split("_")
    return " ".join([SYMBOLS.get(first, first.capitalize()), *rest])


def plain(message: str, labels: Mapping[str, str] | None = None) -> str:
    """Return a message with the labels of the page in place of the names of Python."""
    known = LABELS | dict(labels or {})
    for pattern, text in PLAIN:
        message = re.sub(pattern, text, message)

    def label(match: re.Match[str]) -> str:
        word = match[0]
        return known.get(word) or NAMES.get(word) or words(word).lower()

    message = re.sub(r"\b[a-z][a-z0-9]*(?:_[a-z0-9]+)+\b(?!\.\w)", label, message)
    return re.sub(r"\b(?:[A-Z][a-z]+){2,}\b", lambda m: split_words(m[0]), message)


def failure(message: str, shown: Iterable[Any]) -> str:
    """Return an error in the labels of the page, and the field that it names."""
    fields = list(shown)
    labels = {one.key: one.label for one in fields}
    named = next((labels[word] for word in re.findall(r"\w+", message) if word in labels), "")
    where = f"<p>Field: {escape(named)}</p>" if named else ""
    text = plain(in_units(message, fields), labels)
    return f"<div class='error' role='alert'><b>Error</b> {escape(text)}{where}</div>"
