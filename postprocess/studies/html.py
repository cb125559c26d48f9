"""Sections as a self-contained HTML page: tables as text, figures inside the file."""

import base64
from collections.abc import Sequence
from html import escape
from pathlib import Path

from ehlwave.writing import Writer
from studies.section import Cell, Picture, Section, Table

_STYLE = """
body { font: 15px/1.5 Georgia, serif; color: #1a1a1a; max-width: 62rem; margin: 2rem auto;
       padding: 0 1rem; }
h1, h2, h3, th, nav, figcaption, caption, summary { font-family: Helvetica, Arial, sans-serif; }
h2 { border-bottom: 1px solid #999; margin-top: 3rem; }
table { border-collapse: collapse; font-size: 13px; margin: 1rem 0; }
.wide { overflow-x: auto; }
caption, figcaption { text-align: left; font-size: 13px; color: #333; padding: .3rem 0; }
th { text-align: left; border-bottom: 1px solid #333; padding: .15rem .7rem .15rem 0; }
td { padding: .1rem .7rem .1rem 0; border-bottom: 1px solid #e4e4e4; vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
figure { margin: 1.5rem 0; }
img { max-width: 100%; }
nav a { display: block; }
summary { cursor: pointer; font-size: 13px; }
"""


def write_page(output: Path, name: str, title: str, sections: Sequence[Section]) -> list[Path]:
    """Write ``<name>.html`` beside the files of the sections in `output`; return all paths."""
    path = output / f"{name}.html"
    Writer().text(path, page(title, sections, output / "figures"))
    return [path, *(file for section in sections for file in section.files)]


def page(title: str, sections: Sequence[Section], figures: Path) -> str:
    """Return the whole page: contents, then the sections, whose pictures are in `figures`."""
    contents = "\n".join(
        f'<a href="#part{number}">{number}. {escape(section.title)}</a>'
        for number, section in enumerate(sections, 1)
    )
    body = "\n".join(
        _section(number, section, figures) for number, section in enumerate(sections, 1)
    )
    return (
        f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f"<title>{escape(title)}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n"
        f"<h1>{escape(title)}</h1>\n<nav>\n{contents}\n</nav>\n{body}\n</body>\n</html>\n"
    )


def cell_text(cell: Cell) -> str:
    """Return a table cell as text: numbers with four digits, nothing for None and NaN."""
    if cell is None or cell != cell:
        return ""
    if isinstance(cell, float):
        # Neither 1e+02 for 100 nor ten digits for 123456.
        return f"{cell:.0f}" if 1e3 <= abs(cell) < 1e6 else f"{cell:.4g}"
    return str(cell)


def _section(number: int, section: Section, figures: Path) -> str:
    parts = [f'<h2 id="part{number}">{number}. {escape(section.title)}</h2>']
    parts += [f"<p>{escape(paragraph)}</p>" for paragraph in section.text]
    parts += [_table(table) for table in section.tables]
    parts += [_picture(picture, figures) for picture in section.pictures]
    return "\n".join(parts)


def _table(table: Table) -> str:
    head = "".join(f"<th>{escape(column)}</th>" for column in table.data.columns)
    cells = table.data.astype(object).to_numpy()
    rows = "\n".join("<tr>" + "".join(map(_cell, row)) + "</tr>" for row in cells)
    caption = f"{escape(table.caption)} ({escape(table.name)}.csv)"
    text = (
        f'<div class="wide"><table>\n<caption>{caption}</caption>\n'
        f"<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}\n</tbody></table></div>"
    )
    if not table.is_long:
        return text
    return f"<details><summary>{caption}: {len(table.data)} rows</summary>\n{text}\n</details>"


def _cell(cell: Cell) -> str:
    kind = ' class="number"' if isinstance(cell, int | float) else ""
    return f"<td{kind}>{escape(cell_text(cell))}</td>"


def _picture(picture: Picture, figures: Path) -> str:
    data = base64.b64encode((figures / f"{picture.name}.png").read_bytes()).decode("ascii")
    caption = f"{escape(picture.caption)} ({escape(picture.name)}.pdf)"
    return (
        f'<figure><img alt="{escape(picture.name)}" src="data:image/png;base64,{data}">\n'
        f"<figcaption>{caption}</figcaption></figure>"
    )
