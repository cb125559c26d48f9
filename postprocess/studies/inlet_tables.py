"""The law of warm inlets as tables of both languages, made from its record.

``python -m studies.inlet_tables`` writes ``src/contact/inlet_coefficients.f90`` and the module
``ehlwave.laws.inlet_coefficients`` anew from ``postprocess/record/inlet/law.csv``.
"""

import csv
import sys
from pathlib import Path

from ehlwave.writing import Writer

ROOT = Path(__file__).resolve().parents[2]
RECORD = ROOT / "postprocess/record/inlet/law.csv"
FORTRAN = "inlet_coefficients.f90"
PYTHON = "inlet_coefficients.py"
HOMES = {FORTRAN: ROOT / "src/contact", PYTHON: ROOT / "postprocess/src/ehlwave/laws"}
USUAL = {
    "usual_conductivity": ("0.14", "conductivity of usual oils, W/(m K)"),
    "usual_beta": ("0.04", "-d ln(eta)/dT of usual oils, 1/K"),
    "usual_effusivity": ("13000.0", "effusivity (k rho c)^(1/2) of steel, W s^(1/2)/(m2 K)"),
}
"""Properties of mineral oils and PAO (conductivity 0.12 to 0.15 W/(m K), viscosity falling by 3 to
6 % for a kelvin near 40 C; Hamrock, Schmid and Jacobson, Fundamentals of Fluid Film Lubrication,
2nd ed., 2004, chapter 4) and of bearing steel (46 W/(m K), 7800 kg/m3, 470 J/(kg K)).
"""
LISTS = {
    "coefficients": ("c{}", 11, "coefficients c1 to c11"),
    "error_share": ("error_share_{}", 3, "error over the loss and known_loss, by the sliding"),
    "error_slip": (
        "error_slip_{}",
        2,
        "slide-to-roll ratios |u1 - u2|/ubar above which the next share holds",
    ),
}
PAIRS = {
    "m_range": ("m", "load parameter M of the contacts of the fit"),
    "l_range": ("l", "lubricant parameter L"),
    "film_range": ("film", "central film over the Hertz approach"),
    "loading_range": ("loading", "thermal loading L_t"),
}
SINGLE = {
    "known_loss": "smallest loss that is known",
    "lowest_d": "smallest D of an elliptical contact",
    "largest_slide_roll": "largest |u1 - u2|/ubar",
}


def tables(record: Path = RECORD) -> dict[str, str]:
    """Return both tables by file name.

    Parameters
    ----------
    record : Path
        law.csv of ``scripts/study inlet``.
    """
    with record.open() as file:
        value = {row["name"]: repr(float(row["value"])) for row in csv.DictReader(file)}
    entries: list[tuple[str, list[str], str]] = []
    for name, (pattern, count, meaning) in LISTS.items():
        entries.append((name, [value[pattern.format(i + 1)] for i in range(count)], meaning))
    for name, (of, meaning) in PAIRS.items():
        entries.append((name, [value[f"{end}_{of}"] for end in ("lowest", "highest")], meaning))
    entries += [(name, [value[name]], meaning) for name, meaning in SINGLE.items()]
    entries += [(name, [number], meaning) for name, (number, meaning) in USUAL.items()]
    return {FORTRAN: _fortran(entries), PYTHON: _python(entries)}


def _fortran(entries: list[tuple[str, list[str], str]]) -> str:
    lines = [
        "!> The law of warm inlets, theory eq. (T15): coefficients, errors, contacts of the fit.",
        "!> Made from postprocess/record/inlet/law.csv by `python -m studies.inlet_tables`, with",
        "!> the table of the package.",
        "module ehlwave_inlet_coefficients",
        "   use ehlwave_kinds, only: dp",
        "   implicit none (type, external)",
        "   private",
        "",
    ]
    for name, numbers, meaning in entries:
        name = f"inlet_{name}" if name == "coefficients" else name
        size = f"({len(numbers)})" if len(numbers) > 1 else ""
        text = ", ".join(f"{number}_dp" for number in numbers)
        text = f"[{text}]" if size else text
        lines.append(f"   !> {meaning[0].upper()}{meaning[1:]}.")
        head = f"   real(dp), parameter, public :: {name}{size} ="
        if len(head + text) < 118:
            lines.append(f"{head} {text}")
        elif len(text) < 110:
            lines += [f"{head} &", f"      {text}"]
        else:
            half = (len(numbers) + 1) // 2
            first, second = (
                ", ".join(f"{n}_dp" for n in part) for part in (numbers[:half], numbers[half:])
            )
            lines += [f"{head} &", f"      [{first}, &", f"       {second}]"]
    return "\n".join([*lines, "", "end module ehlwave_inlet_coefficients", ""])


def _python(entries: list[tuple[str, list[str], str]]) -> str:
    lines = [
        '"""The law of warm inlets, eq. (T15): coefficients, errors, and the contacts of the fit.',
        "",
        "Made from ``postprocess/record/inlet/law.csv`` by ``python -m studies.inlet_tables``,",
        "with the table of ``ehlwave-case``.",
        '"""',
        "",
    ]
    for name, numbers, meaning in entries:
        text = ", ".join(numbers)
        text = f"({text})" if len(numbers) > 1 else text
        if len(f"{name} = {text}") > 100:
            text = "(\n" + "".join(f"    {number},\n" for number in numbers) + ")"
        lines += [f"{name.upper()} = {text}", f'"""{meaning[0].upper()}{meaning[1:]}."""']
    return "\n".join([*lines, ""])


def write_tables(record: Path, folder: Path | None = None) -> None:
    """Write both tables, to their homes or to a folder.

    Parameters
    ----------
    record : Path
        law.csv of ``scripts/study inlet``.
    folder : Path, optional
        Destination; by default each table replaces the present one.
    """
    for name, text in tables(record).items():
        Writer(overwrite=True).text((folder or HOMES[name]) / name, text)


if __name__ == "__main__":
    write_tables(RECORD)
    sys.exit(0)
