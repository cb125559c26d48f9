from pathlib import Path

import numpy as np
import pytest
from contact import BALL

from ehlwave.cli import main
from ehlwave.errors import SurfaceError
from ehlwave.surface import ReadOptions, read_surface

STEP = {"length_unit": "um", "height_unit": "nm", "step": 2.0}
WITHOUT_STEP = {"length_unit": "um", "height_unit": "nm"}
HEIGHTS = np.round(10 * np.sin(np.arange(40.0)), 1)
COLUMN = [f"{height:.1f}".replace(".", ",") for height in HEIGHTS]


def write(folder: Path, *lines: str, name: str = "t.csv") -> Path:
    path = folder / name
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def heights(path: Path, **options: object) -> np.ndarray:
    return 1e9 * read_surface(path, ReadOptions(**options)).height[:, 0]


def test_one_column_with_decimal_commas_is_one_column(tmp_path: Path) -> None:
    assert COLUMN[0] == "0,0"
    assert any(cell.startswith("-") for cell in COLUMN)
    for lines in (COLUMN, ["z_nm", *COLUMN], ["Profile of specimen 12", *COLUMN]):
        path = write(tmp_path, *lines)
        np.testing.assert_allclose(heights(path, **STEP), HEIGHTS, atol=1e-12)
        with pytest.raises(SurfaceError, match=r"give the sampling step.*decimal ones"):
            heights(path, **WITHOUT_STEP)


def test_whole_numbers_among_decimal_commas(tmp_path: Path) -> None:
    path = write(tmp_path, *(cell.removesuffix(",0") for cell in COLUMN))
    np.testing.assert_allclose(heights(path, **STEP), HEIGHTS, atol=1e-12)


def test_what_has_two_readings_is_refused_until_one_is_said(tmp_path: Path) -> None:
    lines = [f"{place},{abs(int(height))}" for place, height in enumerate(HEIGHTS)]
    path = write(tmp_path, *lines)
    for options in (STEP, WITHOUT_STEP):
        with pytest.raises(SurfaceError, match=r"'0,0' is a position and a height, or one number"):
            heights(path, **options)
    columns = heights(path, **WITHOUT_STEP, decimal="point")
    np.testing.assert_allclose(columns, [abs(int(height)) for height in HEIGHTS])
    one = heights(path, **STEP, decimal="comma")
    np.testing.assert_allclose(one, [float(line.replace(",", ".")) for line in lines])
    named = write(tmp_path, "x_um,z_nm", *lines)
    np.testing.assert_allclose(heights(named), columns)


def test_signs_and_points_tell_columns(tmp_path: Path) -> None:
    lines = [f"{place},{int(height)}" for place, height in enumerate(HEIGHTS)]
    np.testing.assert_allclose(
        heights(write(tmp_path, *lines), **WITHOUT_STEP), [int(height) for height in HEIGHTS]
    )


def test_columns_of_decimal_commas_separated_by_commas(tmp_path: Path) -> None:
    lines = [f"{2 * k},0,{cell}" for k, cell in enumerate(COLUMN)]
    path = write(tmp_path, "x_um,z_nm", *lines)
    with pytest.raises(SurfaceError, match=r"two of 4 heights in a row, or one number"):
        heights(path)
    np.testing.assert_allclose(heights(path, decimal="comma"), HEIGHTS, atol=1e-12)
    quoted = [f'"{2 * k},0","{cell}"' for k, cell in enumerate(COLUMN)]
    path = write(tmp_path, '"x_um","z_nm"', *quoted)
    np.testing.assert_allclose(heights(path), HEIGHTS, atol=1e-12)


def test_a_map_of_whole_numbers_stays_a_map(tmp_path: Path) -> None:
    numbers = np.random.default_rng(3).integers(-200, 200, (12, 10))
    lines = [",".join(map(str, row)) for row in numbers]
    surface = read_surface(write(tmp_path, *lines), ReadOptions("um", "nm", 2.0))
    np.testing.assert_allclose(1e9 * surface.height.T, numbers)


def test_commas_between_thousands_are_not_decimals(tmp_path: Path) -> None:
    rough = (1000 + 300 * np.sin(np.arange(40))).astype(int)
    path = write(tmp_path, *(f"{5 * k};{height:,}" for k, height in enumerate(rough)))
    with pytest.raises(SurfaceError, match=r"with a comma between thousands: say which"):
        heights(path, length_unit="um", height_unit="nm")
    thousands = heights(path, length_unit="um", height_unit="nm", decimal="point")
    np.testing.assert_allclose(thousands, rough)
    both = write(tmp_path, *(f"{5 * k};{height:,}.5" for k, height in enumerate(rough)))
    with pytest.raises(SurfaceError, match="points and commas"):
        heights(both, length_unit="um", height_unit="nm")
    options = {"length_unit": "um", "height_unit": "nm"}
    np.testing.assert_allclose(heights(both, **options, decimal="point"), rough + 0.5)
    with pytest.raises(SurfaceError, match="contradicts the file"):
        heights(write(tmp_path, "1;0,5", "2;0,7", "3;0,1"), **options, decimal="point")
    with pytest.raises(SurfaceError, match="contradicts the file"):
        heights(write(tmp_path, "1;0.5", "2;0.7", "3;0.1"), **options, decimal="comma")


def test_one_column_with_commas_between_thousands(tmp_path: Path) -> None:
    rough = [1234, 1345, 1456, 999, 987, 1067, 1003, 1004]
    path = write(tmp_path, *(f"{height:,}" for height in rough))
    with pytest.raises(SurfaceError, match=r"with a comma between thousands: say which"):
        heights(path, **STEP)
    np.testing.assert_allclose(heights(path, **STEP, decimal="point"), rough)
    decimals = [height / 1000 if abs(height) > 999 else height for height in rough]
    np.testing.assert_allclose(heights(path, **STEP, decimal="comma"), decimals)
    columns = write(tmp_path, "x_um,z_nm", *(f"{x},{100 + x}" for x in range(2, 10)))
    np.testing.assert_allclose(heights(columns), np.arange(102, 110))


def test_a_step_that_contradicts_the_file_is_refused(tmp_path: Path) -> None:
    lines = [f"{2 * k},{height}" for k, height in enumerate(HEIGHTS)]
    path = write(tmp_path, "x_um,z_nm", *lines)
    assert read_surface(path, ReadOptions(step=2.0)).step_x_m == pytest.approx(2e-6)
    with pytest.raises(SurfaceError, match=r"step=0.5 contradicts the file, whose step is 2:"):
        heights(path, step=0.5)
    stated = write(tmp_path, "Spacing: 2.0 um", "z_nm", *map(str, HEIGHTS))
    with pytest.raises(SurfaceError, match=r"step=1 contradicts the file, whose step is 2:"):
        heights(stated, step=1.0)
    # 0.002 mm is the step that it states
    in_mm = read_surface(stated, ReadOptions(step=0.002, length_unit="mm"))
    assert in_mm.step_x_m == pytest.approx(2e-6)
    uneven = write(tmp_path, "x_um,z_nm", *(f"{k**1.1},{z}" for k, z in enumerate(HEIGHTS)))
    with pytest.raises(SurfaceError, match="not equidistant"):
        heights(uneven, step=2.0)


def test_swapped_columns_are_named(tmp_path: Path) -> None:
    path = write(tmp_path, *(f"{height};{2 * k}" for k, height in enumerate(HEIGHTS)))
    with pytest.raises(SurfaceError, match="if they are swapped, put headings"):
        heights(path, **WITHOUT_STEP)
    path = write(tmp_path, "z_nm;x_um", *(f"{z};{2 * k}" for k, z in enumerate(HEIGHTS)))
    np.testing.assert_allclose(heights(path), HEIGHTS, atol=1e-12)


def test_the_command_has_the_option(tmp_path: Path) -> None:
    path = write(tmp_path, *(f"{k},{k % 3}" for k in range(40)))
    command = ["surface", str(path), "--length-unit", "um", "--height-unit", "nm"]
    command += ["--output", str(tmp_path / "s.h5")]
    assert main(command) == 2
    assert main([*command, "--decimal", "point"]) == 0


def test_equal_heights_have_no_roughness(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write(tmp_path, "x_um,z_um", *(f"{k},2.5" for k in range(40)))
    conditions = [f"{key}={value}" for key, value in BALL.items()]
    command = ["deform", str(path), "--conditions", *conditions]
    pictures = ["--output", str(tmp_path / "out")]
    for options in (pictures, ["--formula", "paper"], ["--form", "mean"], ["--json"]):
        assert main([*command, *options]) == 0
        said = capsys.readouterr()
        assert "warning" not in said.err
        assert "nan" not in said.out.lower()
