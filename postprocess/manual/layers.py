"""Draw the layers of the program from CMake's graph of links.

    python postprocess/manual/layers.py GRAPH.dot PICTURE.svg

GRAPH.dot comes from `cmake --graphviz`. Exit status 1 when the existing picture differs: it is then
drawn anew and must be committed.
"""

import re
import sys
from itertools import pairwise
from pathlib import Path

PREFIX = "ehlwave_"
PROGRAMS = ("ehlwave-case", "ehlwave-sweep")
MODULE = "tripleoctagon"
"""Shape of a library that is loaded at run time."""

BOX = (108, 40)
STEP = (132, 72)
MARGIN = 16
SWEEPS = 12
"""Passes down and up that order the boxes of a row."""

Graph = dict[str, list[str]]


def main(graph: Path, picture: Path) -> int:
    """Write the picture; return 1 if it differs from the existing file."""
    uses, libraries = read_graph(graph.read_text(encoding="utf-8"))
    drawn = svg(uses, libraries)
    before = picture.read_text(encoding="utf-8") if picture.exists() else ""
    if drawn == before:
        return 0
    picture.write_text(drawn, encoding="utf-8")
    print(
        f"{picture.name} was not that of CMake's link graph: drawn anew, look at it and commit it"
    )
    return 1


def read_graph(text: str) -> tuple[Graph, dict[str, str]]:
    """Return the layers that each layer or program links, and the outer library of a layer.

    Modules that a program loads when it is asked to (PETSc's solver) are not among them: there are
    builds with and without.
    """
    boxes = re.findall(r'"(node\d+)" \[ label = "([^"\\]+).*shape = (\w+)', text)
    names = {node: name for node, name, _ in boxes}
    loaded = {name for _, name, shape in boxes if shape == MODULE}
    links = [(names[a], names[b]) for a, b in re.findall(r'"(node\d+)" -> "(node\d+)"', text)]
    ours = {name for name in names.values() if name.startswith(PREFIX) or name in PROGRAMS} - loaded
    if not ours:
        sys.exit("the graph has no target of ehlwave")
    linked = {name for link in links if ours.issuperset(link) for name in link}
    uses: Graph = {_short(name): [] for name in sorted(linked)}
    libraries: dict[str, str] = {}
    for a, b in sorted(set(links)):
        if a in ours and b in ours:
            uses[_short(a)].append(_short(b))
        elif a in ours and "::" in b:
            libraries[_short(a)] = re.sub(r"\d*::.*", "", b).upper().replace("HDF", "HDF5")
    return uses, libraries


def svg(uses: Graph, libraries: dict[str, str]) -> str:
    """Return the picture: a box is above the boxes that it uses."""
    rows, chains = arranged(uses, ranks(uses))
    widest = max(map(len, rows))
    place = {}
    for rank, row in enumerate(rows):
        left = (widest - len(row)) / 2
        for k, name in enumerate(row):
            x = MARGIN + BOX[0] / 2 + (left + k) * STEP[0]
            place[name] = (x, MARGIN + BOX[1] / 2 + (len(rows) - 1 - rank) * STEP[1])
    width = round(2 * MARGIN + BOX[0] + (widest - 1) * STEP[0])
    height = 2 * MARGIN + BOX[1] + (len(rows) - 1) * STEP[1]
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" font-family="sans-serif" font-size="14" text-anchor="middle">',
        '<defs><marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" '
        'markerHeight="7" orient="auto"><path d="M0 0L8 4L0 8z" fill="#555"/></marker></defs>',
        f'<rect width="{width}" height="{height}" fill="#fff"/>',
        '<g fill="none" stroke="#555" marker-end="url(#tip)">',
    ]
    for chain in chains:
        points = [place[name] for name in chain]
        points[0] = (points[0][0], points[0][1] + BOX[1] / 2)
        points[-1] = (points[-1][0], points[-1][1] - BOX[1] / 2)
        path = f"M{points[0][0]:g} {points[0][1]:g}"
        for (x0, y0), (x1, y1) in pairwise(points):
            middle = (y0 + y1) / 2
            path += f"C{x0:g} {middle:g} {x1:g} {middle:g} {x1:g} {y1:g}"
        lines.append(f'<path d="{path}"/>')
    lines.append("</g>")
    for name in uses:
        x, y = place[name]
        fill = "#fde9c9" if name in PROGRAMS else "#dbe9f6"
        lines.append(
            f'<rect x="{x - BOX[0] / 2:g}" y="{y - BOX[1] / 2:g}" width="{BOX[0]}" '
            f'height="{BOX[1]}" rx="6" fill="{fill}" stroke="#555"/>'
        )
        shift = -2 if name in libraries else 5
        lines.append(f'<text x="{x:g}" y="{y + shift:g}">{name}</text>')
        if name in libraries:
            text = f'<text x="{x:g}" y="{y + 13:g}" font-size="11" fill="#555">'
            lines.append(f"{text}{libraries[name]}</text>")
    return "\n".join([*lines, "</svg>", ""])


def ranks(uses: Graph) -> dict[str, int]:
    """Return the row of each box, from 0 below: above the boxes it uses, close below its users."""
    low: dict[str, int] = {}

    def lowest(name: str) -> int:
        if name not in low:
            low[name] = 1 + max((lowest(used) for used in uses[name]), default=-1)
        return low[name]

    for name in uses:
        lowest(name)
    for name in sorted(uses, key=lambda name: -low[name]):
        users = [low[user] for user, used in uses.items() if name in used]
        low[name] = min(users) - 1 if users else low[name]
    return low


def arranged(uses: Graph, rank: dict[str, int]) -> tuple[list[list[str]], list[list[str]]]:
    """Return the rows, and each link as the chain of places that it passes.

    A place that a link passes in a row has a name of its own and takes the room of a box.
    """
    rows: list[list[str]] = [[] for _ in range(max(rank.values()) + 1)]
    for name in uses:
        rows[rank[name]].append(name)
    chains = []
    for user, links in uses.items():
        for used in links:
            passed = [f"{user}>{used}@{r}" for r in range(rank[user] - 1, rank[used], -1)]
            for offset, name in enumerate(passed):
                rows[rank[user] - 1 - offset].append(name)
            chains.append([user, *passed, used])
    next_to: dict[str, set[str]] = {}
    for chain in chains:
        for a, b in pairwise(chain):
            next_to.setdefault(a, set()).add(b)
            next_to.setdefault(b, set()).add(a)
    for sweep in range(SWEEPS):
        order = range(1, len(rows)) if sweep % 2 == 0 else range(len(rows) - 2, -1, -1)
        for r in order:
            side = rows[r - 1] if sweep % 2 == 0 else rows[r + 1]
            at = {name: k - (len(side) - 1) / 2 for k, name in enumerate(side)}
            rows[r].sort(key=lambda name: _mean([at[n] for n in next_to[name] if n in at]))
    return rows, chains


def _mean(values: list[float]) -> float:
    return sum(sorted(values)) / len(values) if values else 0.0


def _short(name: str) -> str:
    return name.removeprefix(PREFIX)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
