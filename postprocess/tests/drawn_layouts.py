"""Text files of a trace or a map as instruments lay them out, drawn by chance, and their truth."""

from dataclasses import dataclass, field
from pathlib import Path
from random import Random

import numpy as np

MICRO = "\u00b5"
UNITS = {"mm": 1e-3, "um": 1e-6, f"{MICRO}m": 1e-6, "nm": 1e-9, "micron": 1e-6, "UM": 1e-6}
PLACES = (
    "X",
    "x",
    "Position",
    "Weg",
    "Distance",
    "Traverse length",
    "L\u00e4nge",
    "Messweg",
    "Pos",
)
HEIGHTS = (
    *("Z", "z", "Height", "H\u00f6he", "Hoehe", "Profile", "Profil", "Hauteur", "Amplitude"),
    *("Rauheit", "Profile height", "Raw", "Depth", "Profilh\u00f6he"),
)
EXTRA = {
    "count": ("No.", "Zeile", "Point No.", "Index", "Profile No.", "#", "Nr", "Punktnummer"),
    "time": ("Zeit [s]", "Time (s)", "t [ms]", "Zeit", "Time"),
    "other": ("Intensity", "Kraft [mN]", "Load (mN)", "Quality", "Laser Intensity", "Speed [mm/s]"),
    "y": ("Y", "y"),
}
TITLES = (
    *("Profile of the inner ring", "Messung Nr. 4", "Roughness tester  No. 12", "Date: 2026-11-22"),
    *("Cut-off: 0.8 mm", "Lc;0,8;mm", "Filter: Gauss", "Points: 400", "Load 5 mN", "[Header]", ""),
    *("Speed 0,5 mm/s", "Mean spacing RSm: 0.12 mm", "Ra = 0.123 um", "-----", "Tip radius: 2 um"),
    *("Operator\tM. Muster", "Step height: 12 um", "Magnification 5000", "Rauheit nach ISO 4287"),
    *("Traverse length: 4.8 mm", "Start at 12:30:45", "v1.2", "1 of 3", "DATA", "Unit cell A"),
)
FOOTERS = (
    *("Ra;0,123;um", "Ra 0.123 um", "END", "[End]", "Rq\t0.2", "Ra = 0.12", "Rz: 1.2", "-----"),
    *("# end of data", "Mittelwert; 0,1", "EOF", "Ra,0.12"),
)


@dataclass
class Layout:
    """A file, its content, and the knowledge of its user."""

    path: Path
    height_m: np.ndarray
    step_m: float
    step_across_m: float | None = None
    said: dict[str, object] = field(default_factory=dict)
    is_complete: bool = False
    """Whether nothing need be asked."""
    height_unit: str = "um"


def drawn(folder: Path, seed: int) -> Layout:
    """Return the layout of a seed, its file written."""
    random = Random(seed)
    return (_trace if random.random() < 0.75 else _map)(folder, random, seed)


def _heights(random: Random, count: int) -> np.ndarray:
    numbers = np.random.default_rng(random.randrange(10**6))
    x = np.arange(count)
    slow = 0.3 * np.sin(2 * np.pi * x / 37 + random.random()) + random.choice([0, 0, 5, -3.5])
    return slow + 0.05 * numbers.standard_normal(count) + random.choice([0, 0.001]) * x


def _text(values: np.ndarray, digits: int, style: str) -> list[str]:
    texts = [f"{value:.{digits}{'e' if style in 'eD' else 'f'}}" for value in values]
    return [text.replace("e", "D") for text in texts] if style == "D" else texts


def _heading(random: Random, name: str, unit: str | None) -> str:
    if unit is None:
        return name
    way = random.choice(["{} [{}]", "{} ({})", "{}/{}", "{}_{}", "{} {}", "{}[{}]", "{}, {}"])
    return way.format(name, unit)


def _trace(folder: Path, random: Random, seed: int) -> Layout:
    count, step_um = random.randrange(30, 120), random.choice([0.5, 1.0, 2.0, 0.25, 5.0])
    z_um = _heights(random, count)
    x_unit, z_unit = random.choice(["mm", "um", f"{MICRO}m"]), random.choice(list(UNITS))
    x = np.arange(count) * step_um * 1e-6 / UNITS[x_unit] + random.choice([0, 0, 1])
    digits = 4 if z_unit == "nm" else 7 if z_unit == "mm" else 5
    style = random.choice("ffffeD")
    z_text = _text(z_um * 1e-6 / UNITS[z_unit], 8 if style in "eD" else digits, style)
    z_m = np.array([float(text.replace("D", "e")) for text in z_text]) * UNITS[z_unit]
    x_text = _text(x, 7 if style in "eD" else 5, "e" if style in "eD" else "f")
    columns = {"x": x_text, "z": z_text}
    kinds = random.sample(list(EXTRA), random.choice([0, 0, 0, 1, 1, 2]))
    if random.random() < 0.15:
        del columns["x"]
    filled = {
        "count": [str(k + 1) for k in range(count)],
        "time": [f"{0.02 * k:.3f}" for k in range(count)],
        "other": [f"{100 + 7 * (k % 5)}" for k in range(count)],
        "y": ["0.00000"] * count,
    }
    columns |= {kind: filled[kind] for kind in kinds if kind != "y" or "x" in columns}
    names = list(columns)
    if random.random() < 0.5:
        random.shuffle(names)
    has_units, has_headings = random.random() < 0.75, random.random() < 0.85
    has_row = has_units and random.random() < 0.2
    units = {"x": x_unit, "z": z_unit} if has_units else {}
    headings = {"x": random.choice(PLACES), "z": random.choice(HEIGHTS)}
    headings |= {kind: random.choice(EXTRA[kind]) for kind in kinds}
    if random.random() < 0.1 and "y" not in kinds:
        headings |= {"x": "X", "z": "Y"}
    lines = _titles(random)
    said: dict[str, object] = {}
    stated = len(names) == 1 and random.random() < 0.5
    if stated:
        lines.append(f"Spacing: {step_um:g} {MICRO}m".replace(".", random.choice(".,")))
    elif "x" not in columns:
        said |= {"step": step_um, "length_unit": "um"}
    if has_headings:
        row = [_heading(random, headings[k], None if has_row else units.get(k)) for k in names]
        # No name can hold the separator of the columns.
        head = [row, [units.get(k, "") for k in names]] if has_row else [row]
    else:
        head = []
    if not (has_units and has_headings):
        said |= {"height_unit": z_unit, **({"length_unit": x_unit} if "x" in columns else {})}
    separator = random.choice([";", ";", "\t", "\t", ",", "  ", " "])
    if separator == "," and any("," in cell for row in head for cell in row):
        separator = ";"
    comma = random.random() < 0.4
    body = [[columns[name][k] for name in names] for k in range(count)]
    text = _lines(random, lines, head, body, separator, comma)
    if comma:
        said["decimal"] = "comma"
    path = _written(folder, random, seed, text)
    is_complete = has_units and has_headings and not said and separator in ";\t" and not kinds
    return Layout(path, z_m, step_um * 1e-6, said=said, is_complete=is_complete, height_unit=z_unit)


def _titles(random: Random) -> list[str]:
    mark = random.choice(["", "", "", "# ", "% ", "#"])
    return [mark + title for title in random.sample(TITLES, random.choice([0, 0, 1, 1, 2, 4]))]


def _lines(
    random: Random,
    lines: list[str],
    head: list[list[str]],
    body: list[list[str]],
    separator: str,
    comma: bool,
) -> str:
    rows = [[cell.replace(".", ",") if comma else cell for cell in row] for row in body]
    if random.random() < 0.1 and separator in ";,":
        rows = [[f'"{cell}"' for cell in row] for row in rows]
        head = [[f'"{cell}"' for cell in row] for row in head]
    end = separator if separator in ";\t," and random.random() < 0.15 else ""
    mark = random.choice(["", "", "# "]) if lines and lines[0].startswith("#") else ""
    texts = [*lines, *(mark + separator.join(row) + end for row in head)]
    texts += [separator.join(row) + end for row in rows]
    texts += random.sample(FOOTERS, random.choice([0, 0, 0, 1, 2]))
    return random.choice(["\n", "\n", "\r\n"]).join(texts) + "\n"


def _written(folder: Path, random: Random, seed: int, text: str) -> Path:
    path = folder / f"{seed}{random.choice(['.txt', '.csv', '.asc', '.dat', '.prn'])}"
    path.write_bytes(
        text.encode(random.choice(["utf-8", "utf-8", "utf-8-sig", "latin-1", "utf-16"]))
    )
    return path


def _map(folder: Path, random: Random, seed: int) -> Layout:
    nx, ny, step, across = random.randrange(9, 20), random.randrange(8, 15), 2.0, 3.0
    z_unit = random.choice(["um", "nm"])
    numbers = np.random.default_rng(seed)
    z = 0.3 * np.sin(0.5 * np.arange(nx) + numbers.random((ny, 1))) + 0.1 * numbers.random((ny, nx))
    texts = [[f"{value * 1e-6 / UNITS[z_unit]:.4f}" for value in row] for row in z]
    z_m = np.array([[float(text) for text in row] for row in texts]) * UNITS[z_unit]
    separator, comma = random.choice([";", "\t", " ", ","]), random.random() < 0.3
    lines = _titles(random)
    said: dict[str, object] = {"decimal": "comma"} if comma else {}
    if random.random() < 0.5:
        order = [(j, i) for j in range(ny) for i in range(nx)]
        if random.random() < 0.5:
            order = [(j, i) for i in range(nx) for j in range(ny)]
        body = [[f"{i * step:.3f}", f"{j * across:.3f}", texts[j][i]] for j, i in order]
        has_units = random.random() < 0.6
        head = [["X [um]", "Y [um]", f"Z [{z_unit}]"]] if has_units else []
        said |= {} if has_units else {"length_unit": "um", "height_unit": z_unit}
    else:
        body, head = texts, []
        if random.random() < 0.5:
            lines += [f"Width: {nx * step:g} um", f"Height: {ny * across:g} um"]
            lines += [f"Value units: {z_unit}"]
        else:
            said |= {
                "length_unit": "um",
                "height_unit": z_unit,
                "step": step,
                "step_across": across,
            }
    path = _written(folder, random, seed, _lines(random, lines, head, body, separator, comma))
    return Layout(path, z_m, step * 1e-6, across * 1e-6, said, height_unit=z_unit)
