"""Actions of ``ehlwave stress``."""

import argparse
import json
import sys
from dataclasses import fields
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from ehlwave.choices import FORM, WINDOWS
from ehlwave.contact.conditions_read import read_given
from ehlwave.errors import StressError
from ehlwave.operating_point import contact_of
from ehlwave.stress.case_report import case_section, case_text, judge_case
from ehlwave.stress.report import plain, stress_dataset, stress_json, stress_text
from ehlwave.surface.read import ReadOptions

OF_SURFACES = {
    "friction": None,
    "second": None,
    "smooth": None,
    "by": None,
    "table": None,
    "slide_to_roll_ratio": None,
    "form": FORM,
    "ends": WINDOWS[0],
    **{field.name: field.default for field in fields(ReadOptions)},
}
"""Options of measured surfaces, with their defaults; a file of ``ehlwave-case`` has its own."""


def run_stress(options: argparse.Namespace) -> None:
    """Judge a file of ehlwave-case, or a measured surface; print and write it."""
    depths = None if options.depths is None else np.array(options.depths)
    written = (
        _of_case(options, depths) if options.conditions is None else _of_surface(options, depths)
    )
    listing = sys.stderr if options.json else sys.stdout
    if written:
        print("\n".join(str(path) for path in written), file=listing)


def _of_case(options: argparse.Namespace, depths: Any) -> list[Path]:  # noqa: ANN401
    """Judge a file of ``ehlwave-case``; return the written files."""
    if not _is_hdf5(options.file):
        raise StressError(
            f"{options.file}: not a file of ehlwave-case --output; for a measured surface give "
            "its contact by --conditions"
        )
    for name, default in OF_SURFACES.items():
        if getattr(options, name) != default:
            raise StressError(
                f"{name}= is for a measured surface, and without --conditions {options.file} is "
                "read as a solved contact: remove it, or give --conditions"
            )
    document, stresses = judge_case(options.file, depths, options.cycles, options.poisson_ratio)
    text = json.dumps(plain(document), indent=2, allow_nan=False)
    print(text if options.json else case_text(document))
    if options.output is None:
        return []
    stress = stresses[(options.body or 1) - 1]
    figures = {"section": case_section(options.file, stress)}
    return _write(options, text, stress, figures)


def _of_surface(options: argparse.Namespace, depths: Any) -> list[Path]:  # noqa: ANN401
    """Judge a measured surface; return the written files."""
    if options.body is not None:
        raise StressError(
            "body= is for a file of ehlwave-case: of a surface both bodies are judged and written, "
            "and the first is drawn: remove it"
        )
    given = read_given(options.conditions)
    reading = {field.name: getattr(options, field.name) for field in fields(ReadOptions)}
    result = contact_of(given, options.table).stress(
        options.file,
        options.second,
        friction=options.friction,
        cycles=options.cycles,
        poisson_ratio=options.poisson_ratio,
        depths_m=None if depths is None else depths * 1e-6,
        smooth=options.smooth,
        by=options.by,
        form=options.form,
        ends=options.ends,
        **reading,
    )
    result.warnings.extend(given.notices)
    print(stress_json(result) if options.json else stress_text(result))
    if options.output is None:
        return []
    from ehlwave.stress.figures import (
        depth_figure,
        predicted_section,
        ripple_figure,
        risk_figure,
    )

    figures = {
        "section": predicted_section(result),
        "depth": depth_figure(result),
        "ripple": ripple_figure(result),
    }
    if any(body.bands for body in result.bodies):
        figures["remove"] = risk_figure(result)
    return _write(options, stress_json(result), stress_dataset(result), figures)


def _write(
    options: argparse.Namespace,
    text: str,
    data: Any,  # noqa: ANN401
    figures: dict[str, Any],
) -> list[Path]:
    """Write ``stress.json``, ``stress.h5`` and the figures; return the paths."""
    from ehlwave.results.figures import write_figure

    folder, writer = options.writer.folder(options.output), options.writer
    paths = [
        writer.text(folder / "stress.json", text + "\n"),
        writer.dataset(folder / "stress.h5", data),
    ]
    for name, figure in figures.items():
        paths += write_figure(figure, folder, name, writer=writer)
    return paths


def _is_hdf5(path: Path) -> bool:
    if not path.is_file():
        raise StressError(f"{path}: no such file")
    return bool(h5py.is_hdf5(path))
