"""Actions of ``ehlwave bearing``, ``gear``, ``cam`` and ``rig``."""

import argparse
import sys

from ehlwave.elements.document import read_element
from ehlwave.elements.drawing import drawing_svg
from ehlwave.elements.report import report_html, report_json, report_text
from ehlwave.elements.sweep_table import write_sweep
from ehlwave.errors import SurfaceError


def run_element(options: argparse.Namespace) -> None:
    """Answer for the element of a file; print it, and write the report."""
    document = read_element(options.file, options.kind)
    try:
        table = document.table()
    except SurfaceError as error:
        raise SurfaceError(f"{options.file}: {error}") from error
    print(report_json(table) if options.json else report_text(table))
    if options.output is None:
        return
    folder, writer = options.output, options.writer
    text = options.file.read_text(encoding="utf-8")
    html = report_html(table, text, drawing_svg(document.name))
    rows = table.to_dataframe().reset_index()
    written = [
        writer.text(folder / "report.html", html),
        writer.text(folder / "report.json", report_json(table) + "\n"),
        writer.table(folder / "table.csv", rows),
    ]
    places = document.places()
    if places:
        has_heat = bool(document.given.get("heat"))
        written += write_sweep(places, folder, heat=has_heat, writer=writer)
    listing = sys.stderr if options.json else sys.stdout
    print("\n".join(str(path) for path in written), file=listing)
