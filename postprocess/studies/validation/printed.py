"""The one value printed for an elliptical contact: section of the page."""

from pathlib import Path

from studies.programs import ROOT
from studies.section import Section
from studies.validation import companion
from studies.validation.sweep import run_sweep

INPUT = ROOT / "inputs" / "full" / "companion.nml"


def section(folder: Path) -> Section:
    """Return the part of the full study's report on that value, computed in `folder`."""
    run_sweep(INPUT, folder / f"{INPUT.stem}.h5")
    part = companion.section(folder)
    part.text.append(
        "Everything else that the paper prints, its Figures 1 and 2 and its experiment with a "
        "sputtered ball are in the report of scripts/reproduce --full; one run of it is kept in "
        "postprocess/record/full."
    )
    return part
