"""The page of all comparisons, its tables as CSV and its figures."""

from collections.abc import Callable, Sequence
from pathlib import Path

from ehlwave.writing import Writer
from studies.html import write_page
from studies.section import Parts, make_sections
from studies.validation import dimple_section, film_section, line_section, printed

TITLE = "Measured and computed by others, and computed by ehlwave"

PARTS: Parts = (
    ("dimple", dimple_section.section),
    ("line", line_section.section),
    ("films", film_section.section),
    ("printed", printed.section),
)


def write_validation(
    runs: Path, output: Path, names: Sequence[str], note: Callable[[str], None] = print
) -> list[Path]:
    """Run what is not in `runs`, write the page of the parts `names` to `output`; return the files.

    Raises ResultsError if a case fails.
    """
    Writer().folder(runs)
    chosen = [part for part in PARTS if part[0] in names]
    return write_page(output, "validation", TITLE, make_sections(chosen, runs, output, note))
