"""A page of a session: the only place of its state."""

import asyncio
import io
import logging
from typing import Any

import panel as pn

from ehlwave.app import messages, saving, shown
from ehlwave.app.contact_form import ContactForm
from ehlwave.app.element_tabs import with_elements
from ehlwave.app.style import OUTPUT, TEMPLATE
from ehlwave.app.surface_form import SurfaceForm, task_of
from ehlwave.app.task import Answer, Task, answered
from ehlwave.app.widgets import CARD, column
from ehlwave.app.work import LONGEST_S, Pools
from ehlwave.errors import ResultsError, SurfaceError, printable

_LOG = logging.getLogger("ehlwave.app")
TITLE = "ehlwave"
SCROLLED: dict[str, Any] = {"max-height": "var(--fields-height)", "overflow-y": "auto"}
"""Style of the fields: beside the answer they scroll above the button, which covers nothing."""


class Page:
    """Fields at the left, the answer at the right."""

    def __init__(self, pools: Pools) -> None:
        """Make the page."""
        self._pools = pools
        self._answer: Answer | None = None
        self.contact, self.surface = ContactForm(), SurfaceForm()
        self.button = pn.widgets.Button(
            name="Compute", button_type="primary", sizing_mode="stretch_width", margin=(8, 6)
        )
        self.button.on_click(self._compute)
        self.first = _html(
            "<p class='hint'>Fill in the contact and press Compute. A trace is "
            "optional: without one the answer is the film.</p>"
        )
        self.warnings, self.figures, self.doubts = _html(), _html(), _html()
        self.numbers, self.report = _html(), _html()
        self.details = pn.Card(
            self.report,
            title="Report, as ehlwave deform prints it",
            sizing_mode="stretch_width",
            visible=False,
            margin=(8, 0),
            styles=CARD,
        )
        self.downloads = [
            _download("Save JSON", "ehlwave.json", self._json),
            _download("Save script", "ehlwave_repeat.py", self._script),
        ]
        self._kept: Answer | None = None
        self.keep = pn.widgets.Button(name="Keep to compare", width=150)
        self.keep.on_click(self._keep)
        self.saving = pn.Row(
            *self.downloads, self.keep, visible=False, margin=(6, 0), styles={"flex-wrap": "wrap"}
        )
        for widget in (*self.contact.widgets, *self.surface.widgets):
            widget.param.watch(self._mark_old, "value")

    def template(self) -> pn.Template:
        """Return the page, ready to be served."""
        page = pn.Template(TEMPLATE)
        page.add_variable("app_title", TITLE)
        fields = pn.Column(
            self.contact.view, self.surface.view, sizing_mode="stretch_width", styles=SCROLLED
        )
        own = column(fields, self.button)
        early = (self.first, self.warnings, self.saving, self.figures)
        late = (self.doubts, self.numbers, self.details)
        inputs, answers = with_elements(own, column(*early, *late), self._pools)
        page.add_panel("inputs", inputs)
        page.add_panel("answers", answers)
        return page

    async def _compute(self, _: Any) -> None:  # noqa: ANN401
        if self.button.disabled:
            return
        self.button.disabled = self.keep.disabled = True
        self.first.object = "<p class='hint' role='status'>Computing ...</p>"
        try:
            task = task_of(self.contact, self.surface)
            self._show(await self._worked(task))
        except ResultsError as error:
            self._fail(printable(str(error)))
        except MemoryError:
            self._fail("not enough memory for what the file holds")
        except Exception:
            _LOG.exception("a task failed")
            self._fail("the page failed, and its log says how: please report it")
        finally:
            self.button.disabled = self.keep.disabled = False

    async def _worked(self, task: Task) -> Answer:
        size = 0 if task.upload is None else len(task.upload.data)
        waiting = self._pools.of(size).submit(answered, task)
        try:
            return await asyncio.wait_for(asyncio.wrap_future(waiting), LONGEST_S)
        except (TimeoutError, asyncio.TimeoutError):  # two types before Python 3.11
            raise SurfaceError(
                f"no answer within {LONGEST_S:.0f} s: cut the surface, or use the command, ehlwave "
                "deform"
            ) from None

    def _show(self, answer: Answer) -> None:
        self._answer = answer
        found = answer.found
        look = f"answer {shown.decided(answer)}"
        self.first.object = f"<p class='{look}' role='status'>{shown.headline(answer)}</p>"
        self.warnings.object = shown.advice(answer) + shown.warnings_of(answer)
        self.figures.object = shown.pictures(answer)
        self.doubts.object = "" if found is None else shown.doubts(found)
        kept = self._kept
        self.numbers.object = (
            shown.numbers(answer) if kept is None else shown.compared(kept, answer)
        )
        self.report.object = "" if found is None else shown.report(found)
        self.details.visible = found is not None
        self.saving.visible = True

    def _keep(self, _: Any) -> None:  # noqa: ANN401
        """Keep the answer, or forget the kept one: the next answers stand beside it."""
        self._kept = self._answer if self._kept is None else None
        self.keep.name = "Keep to compare" if self._kept is None else "End comparison"
        if self._answer is not None:
            self._show(self._answer)

    def _fail(self, message: str) -> None:
        self._answer = None
        self.first.object = messages.failure(message, self.contact.shown())
        for pane in (self.warnings, self.figures, self.doubts, self.numbers, self.report):
            pane.object = ""
        self.details.visible = self.saving.visible = False

    def _mark_old(self, _: Any) -> None:  # noqa: ANN401
        if self._answer is not None and "old" not in self.first.object:
            self.first.object = shown.old(self.first.object)

    def _json(self) -> io.StringIO:
        return io.StringIO("" if self._answer is None else saving.document(self._answer))

    def _script(self) -> io.StringIO:
        return io.StringIO("" if self._answer is None else saving.script(self._answer))


def _html(text: str = "") -> pn.pane.HTML:
    return pn.pane.HTML(text, stylesheets=OUTPUT, sizing_mode="stretch_width", margin=0)


def _download(label: str, name: str, callback: Any) -> pn.widgets.FileDownload:  # noqa: ANN401
    return pn.widgets.FileDownload(
        label=label, filename=name, callback=callback, button_type="default", width=150
    )
