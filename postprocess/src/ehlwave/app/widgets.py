"""Fields of the page: a number with its unit, a section with its title, a file with its limit."""

from collections.abc import Iterable
from typing import Any

import panel as pn

from ehlwave.app.quantities import Quantity, in_si
from ehlwave.app.uploads import LARGEST_BYTES, LARGEST_MB, Upload, too_large

CHUNK_BYTES = 2**20
"""Parts of a file, per message of the browser."""

_TIGHT = [
    "input, select { padding: 3px 8px; min-height: 2.1em; font-size: 14px; }"
    "label { font-size: 13px; color: #33434d; }"
]
_UNIT = ["div { font-size: 14px; padding-left: 4px; color: #33434d; white-space: nowrap; }"]
HALF = {"flex": "1 1 0", "min-width": "0"}
"""Half of a line of two."""


class NumberField:
    """A number and the unit that it is typed in."""

    def __init__(self, quantity: Quantity) -> None:
        """Make the widgets."""
        self.key = quantity.key
        self.label = quantity.label
        self.text = pn.widgets.TextInput(
            name=quantity.label,
            value=quantity.example,
            description=quantity.help or None,
            sizing_mode="stretch_width",
            min_width=80,
            stylesheets=_TIGHT,
            margin=(2, 2, 2, 4),
        )
        self.units = dict(quantity.units) or {"": 0}
        if len(self.units) > 1:
            self.unit = pn.widgets.Select(
                options=list(self.units),
                width=80,
                align="end",
                margin=(2, 6, 2, 2),
                stylesheets=_TIGHT,
            )
        else:
            text = f"<div>{next(iter(self.units))}</div>"
            self.unit = pn.pane.HTML(
                text, width=80, align="end", margin=(2, 6, 10, 2), stylesheets=_UNIT
            )
        self.view = pn.Row(self.text, self.unit, sizing_mode="stretch_width", styles=HALF)

    def given(self) -> dict[str, float | str]:
        """Return the key with the number in SI; nothing of an empty field."""
        text = self.text.value.strip()
        return {self.key: in_si(text, self.chosen[1])} if text else {}

    @property
    def chosen(self) -> tuple[str, int | None]:
        """The unit that is shown, with its power of ten."""
        name = self.unit.value if len(self.units) > 1 else next(iter(self.units))
        return name, self.units[name]

    @property
    def widgets(self) -> list[Any]:
        """Return the fields to edit."""
        return [self.text, self.unit] if len(self.units) > 1 else [self.text]


def given_by(fields: Iterable[NumberField]) -> dict[str, Any]:
    """Return the numbers of fields by their keys."""
    return {key: number for one in fields for key, number in one.given().items()}


def widgets_of(fields: Iterable[NumberField]) -> list[Any]:
    """Return the fields to edit."""
    return [widget for one in fields for widget in one.widgets]


class FileField(pn.widgets.FileDropper):
    """A file of limited size; the server keeps the limit, too."""

    def __init__(self, **options: Any) -> None:  # noqa: ANN401
        """Make the widget."""
        super().__init__(
            multiple=False,
            chunk_size=CHUNK_BYTES,
            max_file_size=f"{LARGEST_MB}MB",
            previews=[],
            layout="compact",
            **options,
        )
        self.refused = ""

    def upload(self) -> Upload | None:
        """Return the file, if any."""
        for name, data in self.value.items():
            return Upload(name, data.encode() if isinstance(data, str) else data)
        return None

    def _process_event(self, event: Any) -> None:  # noqa: ANN401
        """Take a part of a file, or drop all of a file that is too large."""
        data = event.data
        if event.event_name != "delete_event":
            kept = self._file_buffer.get(data["name"], []) if data["chunk"] != 1 else []
            size = sum(map(len, kept)) + len(data["data"])
            if size > LARGEST_BYTES or (data["chunk"] != 1 and not kept):
                self._file_buffer.clear()
                if size > LARGEST_BYTES:
                    self.refused = too_large(size)
                return
            if data["chunk"] == 1:
                self._file_buffer.clear()
                self.value, self.refused = {}, ""
        super()._process_event(event)


def select(
    label: str,
    options: Any,  # noqa: ANN401 - list or mapping
    hint: str | None = None,
) -> pn.widgets.Select:
    """Return a choice; a hint opens at a question mark beside the label."""
    return pn.widgets.Select(
        name=label,
        description=hint,
        options=options,
        sizing_mode="stretch_width",
        stylesheets=_TIGHT,
        styles=HALF,
        margin=(2, 6, 2, 4),
    )


def text_field(label: str, hint: str) -> pn.widgets.TextInput:
    """Return a field for a word; an empty field shows `hint`."""
    return pn.widgets.TextInput(
        name=label,
        placeholder=hint,
        sizing_mode="stretch_width",
        min_width=80,
        stylesheets=_TIGHT,
        styles=HALF,
        margin=(2, 6, 2, 4),
    )


def in_rows(views: Iterable[Any], length: int = 2, **options: Any) -> pn.Column:  # noqa: ANN401
    """Return views in rows of so many, all as wide."""
    every = list(views)
    while len(every) % length:
        every.append(pn.Spacer(styles=HALF, sizing_mode="stretch_width"))
    lines = [
        pn.Row(*every[i : i + length], sizing_mode="stretch_width")
        for i in range(0, len(every), length)
    ]
    return pn.Column(*lines, sizing_mode="stretch_width", **options)


def column(*views: Any) -> pn.Column:  # noqa: ANN401
    """Return views in a column."""
    return pn.Column(*views, sizing_mode="stretch_width")


def section(title: str, *views: Any) -> pn.Column:  # noqa: ANN401
    """Return views below a title."""
    heading = pn.pane.HTML(f"<h2>{title}</h2>", stylesheets=HEADING, margin=(6, 4, 0, 4))
    return pn.Column(heading, *views, sizing_mode="stretch_width")


def title(text: str) -> pn.pane.HTML:
    """Return the title of half a line."""
    style = {**HALF, "font-weight": "600", "font-size": "13px"}
    return pn.pane.HTML(text, styles=style, margin=(6, 6, 0, 4), sizing_mode="stretch_width")


HEADING = [
    "h2 { font-size: 1.02em; margin: 0; color: #14405c; border-bottom: 1px solid #cfdae1; }"
    ":host { width: 100%; }"
]

CARD = {"box-shadow": "none", "border": "1px solid #d7e0e6", "border-radius": "4px"}
