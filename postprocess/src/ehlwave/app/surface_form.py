"""The measured surface of the page, and data that its file lacks."""

from typing import Any

import panel as pn

from ehlwave.app import quantities as q
from ehlwave.app.contact_form import ContactForm
from ehlwave.app.task import Task
from ehlwave.app.uploads import LARGEST_MB
from ehlwave.app.widgets import (
    CARD,
    FileField,
    NumberField,
    in_rows,
    section,
    select,
    text_field,
    widgets_of,
)
from ehlwave.choices import DECIMALS, FORMS, WINDOWS
from ehlwave.errors import SurfaceError

TRANSFERS = {
    "First law that holds, else computed": None,
    "Laws alone, nothing computed": "laws",
    "Computed": "computed",
    "Atlas of computed responses": "atlas",
    "Law of the two waves": "two-waves",
    "Recommended formula": "recommended",
    "Formula of the paper": "paper",
}
AS_FILE = "as the file says"
UNITS = (AS_FILE, "m", "mm", "um", "nm")


class SurfaceForm:
    """A measured surface, and data that its file lacks."""

    def __init__(self) -> None:
        """Make the fields."""
        self.file = FileField(sizing_mode="stretch_width", margin=(4, 6))
        self.table = FileField(sizing_mode="stretch_width", margin=(4, 6))
        self.length = select("Unit of lengths", list(UNITS))
        self.height = select("Unit of heights", list(UNITS))
        self.axis = select("Measured", {"along rolling": "x", "across rolling": "y"})
        self.form = select("Form removed", _first(list(FORMS), "plane"))
        self.ends = select("Ends", _first(list(WINDOWS), "mirror"))
        self.by = select("Judged by", TRANSFERS)
        self.decimal = select("Decimals", [AS_FILE, *DECIMALS])
        self.missing = select("Missing heights", {"refused": False, "filled": True})
        self.step = NumberField(q.STEP)
        self.cutoffs = [NumberField(one) for one in q.CUTOFFS]
        self.channel = text_field("Channel of heights", AS_FILE)
        numbers = [one.view for one in (self.step, *self.cutoffs)]
        of_table = text_of("Harmonic table that judges the components, of ehlwave harmonics")
        more = pn.Card(
            of_table,
            self.table,
            in_rows([self.by, self.ends, self.decimal, self.missing, self.channel, *numbers]),
            title="More about the surface",
            collapsed=True,
            sizing_mode="stretch_width",
            margin=(6, 4),
            styles=CARD,
        )
        hint = text_of(
            f"Trace or map, {LARGEST_MB} MB at most: text, NumPy, HDF5, SDF, SUR, PLU, X3P, ..."
        )
        few = in_rows([self.length, self.height, self.axis, self.form])
        self.view = section("Surface (optional)", hint, self.file, few, more)

    def reading(self) -> dict[str, Any]:
        """Return arguments of ReadOptions that are not the defaults."""
        said = {
            "length_unit": self.length.value,
            "height_unit": self.height.value,
            "rolling_axis": None if self.axis.value == "x" else "y",
            "decimal": self.decimal.value,
            "fill_missing": self.missing.value or None,
            "channel": self.channel.value.strip() or None,
            **_numbers(self.step),
        }
        return {key: value for key, value in said.items() if value not in (None, AS_FILE)}

    def options(self) -> dict[str, Any]:
        """Return arguments of :meth:`ehlwave.Contact.deform`."""
        found: dict[str, Any] = {
            "by": self.by.value,
            "form": self.form.value,
            "ends": self.ends.value,
        }
        cutoffs = [_numbers(one).get(one.key) for one in self.cutoffs]
        return found | ({"cutoffs_m": tuple(cutoffs)} if any(cutoffs) else {})

    @property
    def widgets(self) -> list[Any]:
        """Return the fields to edit."""
        chosen = [self.length, self.height, self.axis, self.form, self.ends, self.by]
        chosen += [self.decimal, self.missing, self.channel, self.file, self.table]
        return [*chosen, *widgets_of([self.step, *self.cutoffs])]


def task_of(contact: ContactForm, surface: SurfaceForm) -> Task:
    """Return the request.

    Raises SurfaceError if a file was refused, or a number of the surface is none.
    """
    for file in (surface.file, surface.table):
        if file.refused:
            raise SurfaceError(f"the file: {file.refused}")
    upload = surface.file.upload()
    if upload is None:
        return Task(contact.given())
    reading, options = surface.reading(), surface.options()
    return Task(contact.given(), upload, reading, options, surface.table.upload())


def _numbers(field: NumberField) -> dict[str, float]:
    found: dict[str, float] = {}
    for key, value in field.given().items():
        if isinstance(value, str) or value <= 0:
            raise SurfaceError(f"{field.label}: {field.text.value!r} is not a number above 0")
        found[key] = value
    return found


def text_of(text: str) -> pn.pane.HTML:
    """Return a line of small text above a field."""
    small = {"font-size": "0.86em", "color": "#51626c"}
    return pn.pane.HTML(text, margin=(4, 6, 0, 6), styles=small)


def _first(names: list[str], first: str) -> list[str]:
    return [first, *(name for name in names if name != first)]
