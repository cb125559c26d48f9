"""From the numbers and the trace of a page to its answer; independent of the page."""

import io
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from threading import Lock
from typing import Any

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ehlwave.app.contacts import Given, made
from ehlwave.app.uploads import Upload, read_table_upload, read_upload
from ehlwave.choices import FILM_BY
from ehlwave.errors import ExtrapolationWarning, RangeError
from ehlwave.laws.answers import Film
from ehlwave.operating_point import Contact
from ehlwave.surface.figures import deformed_figure, spectrum_figure
from ehlwave.surface.predict import Deformed
from ehlwave.surface.read import ReadOptions

DOTS_PER_INCH = 200
_DRAWING = Lock()
"""Settings of Matplotlib apply to the whole process."""


@dataclass(frozen=True)
class Task:
    """Request of a page."""

    given: Given
    """The contact as it was entered."""
    upload: Upload | None = None
    """A measured surface."""
    reading: Mapping[str, Any] = field(default_factory=dict)
    options: Mapping[str, Any] = field(default_factory=dict)
    """`reading`, `options`: of :class:`ehlwave.surface.ReadOptions`, and of
    :meth:`ehlwave.Contact.deform`."""
    table: Upload | None = None
    """A harmonic table that answers for waves."""


@dataclass(frozen=True)
class Answer:
    """Results on the page.

    Attributes
    ----------
    task : Task
        Request.
    contact : Contact
        Source of the answer.
    film : Film or None
        Film of the smooth contact; None: it lies outside the atlas, `outside` has the reason.
    outside : str
        Why there is no film.
    found : Deformed or None
        The surface inside the contact.
    pictures : mapping
        PNG files by their titles.
    """

    task: Task
    contact: Contact
    film: Film | None
    outside: str
    found: Deformed | None
    pictures: Mapping[str, bytes]

    @property
    def warnings(self) -> list[str]:
        """Doubts about the numbers, first about the film."""
        of_film = [] if self.film is None else self.film.warnings
        of_surface = [] if self.found is None else self.found.warnings
        return list(dict.fromkeys([*of_film, *of_surface]))


def answered(task: Task) -> Answer:
    """Return the answer.

    Raises ResultsError if an input cannot be used, with the message of the command line.
    """
    table = None if task.table is None else read_table_upload(task.table)
    contact = made(task.given, table)
    found, pictures = None, {}
    film, outside = None, ""
    if task.upload is not None:
        surface = read_upload(task.upload, ReadOptions(**task.reading))
        found = contact.deform(surface, **task.options)
        pictures["Surface before and in the contact"] = _png(deformed_figure, found)
        pictures["Spectrum"] = _png(spectrum_figure, found)
    by = task.options.get("by")
    try:
        film = contact.film(by if by in FILM_BY else None)
    except RangeError as error:
        if found is None:
            raise
        outside = str(error)
    return Answer(task, contact, film, outside, found, pictures)


def silence_extrapolation() -> None:
    """Keep warnings of extrapolated numbers, which answers carry, out of the server's log."""
    warnings.simplefilter("ignore", ExtrapolationWarning)


def _png(draw: Any, found: Deformed) -> bytes:  # noqa: ANN401 - a function that returns a figure
    file = io.BytesIO()
    with _DRAWING:
        figure: Figure = draw(found)
        figure.set_dpi(DOTS_PER_INCH)
        FigureCanvasAgg(figure).print_png(file)
    return file.getvalue()
