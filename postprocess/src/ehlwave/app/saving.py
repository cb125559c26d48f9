"""Downloads of a page: JSON with all its answers, and a script that repeats them."""

import json
import math
from dataclasses import asdict
from typing import Any

from ehlwave.app.contacts import call, source
from ehlwave.app.task import Answer
from ehlwave.app.uploads import file_name
from ehlwave.surface.report import report_json

FORMAT_NAME = "ehlwave-app"

_HEAD = '''"""Repeat an answer of the page of ehlwave: SI units throughout."""

import ehlwave
'''
_FILM = """
film = contact.film()
print(film)
"""
_SURFACE = """
print(ehlwave.surface.report_text(found))
ehlwave.surface.write_results(found, Path("deformed"))
"""


def document(answer: Answer) -> str:
    """Return JSON: arguments in SI, film, and the report of ``ehlwave deform --json``."""
    found = {
        "format": FORMAT_NAME,
        "given": asdict(answer.task.given),
        "reading": dict(answer.task.reading),
        "options": dict(answer.task.options),
        "film": None if answer.film is None else _plain(asdict(answer.film)),
        "surface": None if answer.found is None else json.loads(report_json(answer.found)),
    }
    return json.dumps(found, indent=2, allow_nan=False) + "\n"


def script(answer: Answer) -> str:
    """Return a Python script that repeats the answer, beside the file of the surface."""
    table = answer.task.table
    lines = [source(answer.task.given, None if table is None else file_name(table.name))]
    text = _HEAD
    if answer.film is not None:
        lines.append(_FILM)
    if answer.task.upload is not None:
        text = text.replace("import ehlwave", "from pathlib import Path\n\nimport ehlwave", 1)
        said = {**answer.task.options, **answer.task.reading}
        name = repr(file_name(answer.task.upload.name))
        lines.append(call("found = contact.deform", said, [name]))
        lines.append(_SURFACE)
    return f"{text}\n" + "".join(lines)


def _plain(value: Any) -> Any:  # noqa: ANN401
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
