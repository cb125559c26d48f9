"""A tab of the page for bearings, gears or cams: fields at the left, the report at the right."""

import asyncio
import io
import logging
from pathlib import Path
from typing import Any

import numpy as np
import panel as pn

from ehlwave.app import messages
from ehlwave.app.element_quantities import TABS
from ehlwave.app.oil_form import BY_GRADE, OilForm
from ehlwave.app.quantities import HEAT_HELP
from ehlwave.app.style import OUTPUT
from ehlwave.app.task import _DRAWING
from ehlwave.app.uploads import Upload, read_upload
from ehlwave.app.widgets import FileField, NumberField, column, given_by, in_rows, section, select
from ehlwave.app.work import Pools
from ehlwave.elements.document import ElementDocument
from ehlwave.elements.drawing import drawing_svg
from ehlwave.elements.report import STYLE, report_body, report_html
from ehlwave.errors import ResultsError, printable
from ehlwave.shown import split_words
from ehlwave.surface.read import ReadOptions

_LOG = logging.getLogger("ehlwave.app")
EYRING = "Ree-Eyring"
PAIRS = ("teeth", "profile_shift")
COUNTS = ("balls", "rollers", "teeth_1", "teeth_2")
BY_LAWS = "by laws, in seconds"
ANSWERS = [BY_LAWS, "by laws, else computed, in minutes"]
EXAMPLES = {
    "Bearing": "a 6208 deep groove ball bearing at 3 kN and 3000 rpm",
    "Gear": "a spur gear pair of module 3 mm at 150 N m and 1500 rpm",
    "Cam": "a cam with a roller follower at 1000 rpm",
}
HEAT = {"isothermal": False, "with heat": True}


class ElementTab:
    """Fields of a kind of elements, and the report."""

    def __init__(self, name: str, pools: Pools) -> None:
        """Make the fields."""
        self._pools = pools
        self._html = ""
        names = {split_words(one).capitalize(): one for one in TABS[name]}
        self.element = select("Element", names)
        self.fields = {
            kind: [[NumberField(one) for one in part] for part in asked]
            for kind, asked in TABS[name].items()
        }
        self.views = {
            kind: in_rows(field.view for part in parts for field in part)
            for kind, parts in self.fields.items()
        }
        self.drawing = pn.pane.HTML(sizing_mode="stretch_width")
        self.oil = OilForm()
        self.oil.kind.value = BY_GRADE
        self.oil.flow.value = EYRING
        self.heat = select("Film and friction", HEAT, HEAT_HELP)
        self.by = select("Answered", ANSWERS)
        self.file = FileField(sizing_mode="stretch_width", margin=(4, 6))
        self.button = pn.widgets.Button(
            name="Compute", button_type="primary", sizing_mode="stretch_width", margin=(8, 6)
        )
        self.button.on_click(self._compute)
        self.element.param.watch(self._show, "value")
        self._show()
        surface = section("Roughness of race, pinion or cam (optional)", self.file)
        head, last = in_rows([self.element], 1), in_rows([self.heat, self.by])
        parts = (head, self.drawing, *self.views.values(), last)
        self.inputs = column(section(name, *parts), self.oil.view, surface, self.button)
        hint = (
            f"<p class='hint'>The fields hold a worked example: {EXAMPLES[name]}, with oil ISO VG "
            "68 at 60 C. Press Compute: the answer has films, pressures, friction and errors.</p>"
        )
        self.first = pn.pane.HTML(hint, stylesheets=OUTPUT, sizing_mode="stretch_width")
        self.report = pn.pane.HTML("", stylesheets=[*OUTPUT, STYLE], sizing_mode="stretch_width")
        self.saving = pn.widgets.FileDownload(
            label="Save report", filename="report.html", callback=self._file, width=150
        )
        self.saving.visible = False
        self.answers = column(self.first, self.saving, self.report)

    def _show(self, *_: Any) -> None:  # noqa: ANN401
        for kind, view in self.views.items():
            view.visible = kind == self.element.value
        with _DRAWING:
            self.drawing.object = drawing_svg(self.element.value)

    def document(self) -> ElementDocument:
        """Return the element as it was entered."""
        dimensions, conditions = (given_by(part) for part in self.fields[self.element.value])
        for key in COUNTS:
            if isinstance(dimensions.get(key), float) and dimensions[key] == int(dimensions[key]):
                dimensions[key] = int(dimensions[key])
        for key in PAIRS:
            if f"{key}_1" in dimensions and f"{key}_2" in dimensions:
                dimensions[key] = (dimensions.pop(f"{key}_1"), dimensions.pop(f"{key}_2"))
        if "lift_height_m" in dimensions and "opening_deg" in dimensions:
            height, half = dimensions.pop("lift_height_m"), dimensions.pop("opening_deg") / 2
            angle = np.arange(0, 360, 2.0)
            wave = height / 2 * (1 + np.cos(np.pi * (angle - 180) / half))
            dimensions |= {
                "angle_deg": angle,
                "lift_m": np.where(np.abs(angle - 180) < half, wave, 0.0),
            }
        if self.by.value == BY_LAWS:
            conditions["by"] = "laws"
        found = self.oil.given()
        given = {
            "dimensions": dimensions,
            "conditions": conditions,
            "oil": dict(found.get("oil", {})) | found["keys"],
            "heat": self.heat.value,
        }
        return ElementDocument(self.element.value, given, Path())

    async def _compute(self, _: Any) -> None:  # noqa: ANN401
        if self.button.disabled:
            return
        self.button.disabled = True
        self.first.object = "<p class='hint' role='status'>Computing ...</p>"
        self.report.object, self._html, self.saving.visible = "", "", False
        try:
            document, upload = self.document(), self.file.upload()
            loop = asyncio.get_running_loop()
            pool = self._pools.of(0 if upload is None else len(upload.data))
            body, self._html = await loop.run_in_executor(pool, _answered, document, upload)
            self.first.object, self.report.object = "", body
            self.saving.visible = True
        except ResultsError as error:
            fields = [field for part in self.fields[self.element.value] for field in part]
            self.first.object = messages.failure(
                printable(str(error)), [*fields, *self.oil.shown()]
            )
        except Exception:
            _LOG.exception("an element failed")
            text = "the page failed, and its log says how: please report it"
            self.first.object = messages.failure(text, [])
        finally:
            self.button.disabled = False

    def _file(self) -> io.StringIO:
        return io.StringIO(self._html)


def _answered(document: ElementDocument, upload: Upload | None) -> tuple[str, str]:
    """Return the report as a part of the page, and as a file."""
    trace = None if upload is None else read_upload(upload, ReadOptions())
    table = document.table(**({} if trace is None else {"trace": trace}))
    with _DRAWING:
        drawing = drawing_svg(document.name)
        words = messages.plain
        return report_body(table, words), report_html(table, drawing_svg=drawing, words=words)
