"""The records of the quick sweep and of the full study agree, point by point."""

import csv
from pathlib import Path

RECORD = Path(__file__).parents[1] / "record"
# Marched waves of the quick sweep have Ai = 20 % of the film, those of the study are small: what
# that makes at most, see tests/verification/test_full_record.py.
FINITE_AMPLITUDE = 0.0065


def _rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_quick_sweep_agrees_with_the_full_study() -> None:
    study = {
        (float(row["M"]), float(row["D"]), row["orientation"], float(row["lambda/a"])): row
        for row in _rows(RECORD / "full" / "tables" / "points.csv")
    }
    names = ("load_parameter_m", "radius_ratio_d", "orientation", "wavelength_over_a")
    quick = _rows(RECORD / "quick" / "collapse.csv")
    assert len(quick) == 126
    for row in quick:
        m, d, orientation, wave = (row[name] for name in names)
        other = study[float(m), float(d), orientation, float(wave)]
        difference = abs(float(row["deformed_ratio"]) - float(other["resolved"]))
        stated = float(row["deformed_error"]) + float(other["error bar"])
        assert difference <= 1.5 * stated + FINITE_AMPLITUDE, (m, d, orientation, wave)
