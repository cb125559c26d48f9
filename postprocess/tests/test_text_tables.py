"""Tables of numbers as instruments write them: each right, or asked; and fast, whatever it is."""

import contextlib
import time
from pathlib import Path

import numpy as np
import pytest

from ehlwave.errors import SurfaceError
from ehlwave.surface import ReadOptions, Surface, read_surface

COUNT = 60
X_MM = 0.001 * np.arange(COUNT)
Z_UM = np.round(0.3 * np.sin(0.4 * np.arange(COUNT)) + 0.02 * np.cos(np.arange(COUNT)), 6)


def table(*columns: object, separator: str = ";", style: str = "{:.6f}") -> str:
    texts = [[style.format(cell) for cell in np.asarray(column, dtype=float)] for column in columns]
    return "\n".join(map(separator.join, zip(*texts, strict=True))) + "\n"


def read(folder: Path, text: str, name: str = "t.csv", **said: object) -> Surface:
    (folder / name).write_text(text, encoding="utf-8")
    return read_surface(folder / name, ReadOptions(**said))  # type: ignore[arg-type]


def assert_trace(surface: Surface, step_um: float = 1.0) -> None:
    assert surface.height.shape == (COUNT, 1)
    np.testing.assert_allclose(surface.height[:, 0], Z_UM * 1e-6, rtol=1e-6, atol=1e-13)
    assert surface.step_x_m == pytest.approx(step_um * 1e-6)


TIME, ROW, CONSTANT = 0.02 * np.arange(COUNT), np.arange(COUNT) + 1, np.ones(COUNT)


@pytest.mark.parametrize(
    ("heading", "columns"),
    [
        ("Weg [mm];Zeit [s];Höhe [µm]", (X_MM, TIME, Z_UM)),
        ("Zeile;X [mm];Z [µm]", (ROW, X_MM, Z_UM)),
        ("Profile No.;X [mm];Z [um]", (CONSTANT, X_MM, Z_UM)),
        ("Pos.;X [mm];Z [um]", (ROW, X_MM, Z_UM)),
        ("Z [um];Zeit [s];X [mm]", (Z_UM, TIME, X_MM)),
        ("高さ[μm];位置[mm]", (Z_UM, X_MM)),
        ("Distance (mm);Hauteur (µm);Qualité", (X_MM, Z_UM, CONSTANT)),
        ("X_(microns);Z_(UM)", (1e3 * X_MM, Z_UM)),
        ("X [mm];Z [Å]", (X_MM, 1e4 * Z_UM)),
        ("X [mm];Y [um]", (X_MM, Z_UM)),
        ("# X [mm];Z [um]", (X_MM, Z_UM)),
        ("X [mm];Y [mm];Z [um]", (X_MM, CONSTANT, Z_UM)),
        ("Lateral mm;Raw Micrometer", (X_MM, Z_UM)),
        ("X [mm];Z setpoint [um];Z [um];Z err [um]", (X_MM, CONSTANT, Z_UM, CONSTANT)),
        ("MesswertZ [um];PositionX [mm]", (Z_UM, X_MM)),
        ("T [degC];X [mm];Z [um]", (TIME, X_MM, Z_UM)),
    ],
)
def test_columns_are_chosen_by_words_and_units(
    tmp_path: Path, heading: str, columns: tuple[np.ndarray, ...]
) -> None:
    found = read(tmp_path, f"{heading}\n{table(*columns)}")
    assert_trace(found)
    assert "columns: positions" in found.notes[0] or "columns: positions" in " ".join(found.notes)


@pytest.mark.parametrize(
    "heading",
    [
        *(
            "Z [10^-3 mm]",
            "Z [\u00d710⁻³ mm]",
            "Z [0.1 um]",
            "Z [0,1 µm]",
            "Z [1e-6 m]",
            "Z x1000 [um]",
        ),
        *("Z [1/1000 mm]", "Z in 10 nm", "Z*1000 um", "Z 1000 um", "Z*1e3 [um]", "Z [um x 10]"),
    ],
)
def test_multiples_of_a_unit_are_asked(tmp_path: Path, heading: str) -> None:
    text = f"X [mm];{heading}\n" + table(X_MM, 1e-3 * Z_UM)  # a slope that any unit may have
    with pytest.raises(SurfaceError, match="states no unit of its heights"):
        read(tmp_path, text)


def test_two_columns_that_can_be_the_height_are_asked(tmp_path: Path) -> None:
    text = "X [mm];Profile 1 [um];Profile 2 [um]\n" + table(X_MM, Z_UM, 2 * Z_UM)
    with pytest.raises(SurfaceError, match=r"'Profile 1 \[um\]', 'Profile 2 \[um\]': say which"):
        read(tmp_path, text)
    assert_trace(read(tmp_path, text, channel="Profile 1"))
    with pytest.raises(SurfaceError, match="is none of its columns"):
        read(tmp_path, text, channel="Profile")
    with pytest.raises(SurfaceError, match="no column of heights among"):
        read(tmp_path, "X [mm];Zeit [s]\n" + table(X_MM, TIME))


def test_an_oblique_profile_has_its_own_length(tmp_path: Path) -> None:
    found = read(tmp_path, "X [mm];Y [mm];Z [um]\n" + table(X_MM, 2 * X_MM, Z_UM))
    assert_trace(found, step_um=np.sqrt(5))
    assert "oblique profile" in " ".join(found.notes)
    # Against an axis, and across it by less than the file resolves.
    for x, y in ((-3 * X_MM, CONSTANT), (CONSTANT, -3 * X_MM), (3 * X_MM, 1e-5 * np.round(TIME))):
        for heading, columns in (
            ("X [mm];Y [mm];Z [um]", (x, y, Z_UM)),
            ("Z [um];Y [mm];X [mm]", (Z_UM, y, x)),
        ):
            assert_trace(read(tmp_path, f"{heading}\n" + table(*columns)), step_um=3)
    bent = np.abs(X_MM - X_MM[20])
    with pytest.raises(SurfaceError, match="neither a grid nor equidistant on a line"):
        read(tmp_path, "X [mm];Y [mm];Z [um]\n" + table(X_MM, bent, Z_UM))
    scattered = np.random.default_rng(1).random(COUNT)
    with pytest.raises(SurfaceError, match="neither a grid nor equidistant on a line"):
        read(tmp_path, "X [mm];Y [mm];Z [um]\n" + table(X_MM, scattered, Z_UM))


@pytest.mark.parametrize("name", ["a.txt", "a.csv", "a.asc", "a.xyz"])
@pytest.mark.parametrize("is_by_columns", [False, True])
def test_points_of_a_grid_are_a_map(tmp_path: Path, name: str, is_by_columns: bool) -> None:
    x, y = np.meshgrid(np.arange(12) * 1.0, np.arange(9) * 1.5)
    z = 0.1 * np.sin(x) + 0.05 * np.cos(y)
    places = [a.T.ravel() if is_by_columns else a.ravel() for a in (x, y, z)]
    found = read(tmp_path, table(*places, separator=" "), name, length_unit="um", height_unit="um")
    np.testing.assert_allclose(found.height, z.T * 1e-6, atol=1e-12)
    assert (found.step_x_m, found.step_y_m) == pytest.approx((1e-6, 1.5e-6))


def test_a_title_above_numbers_between_blanks(tmp_path: Path) -> None:
    text = "Profile of the inner ring\n" + table(X_MM, Z_UM, separator="  ")
    assert_trace(read(tmp_path, text, length_unit="mm", height_unit="um"))


@pytest.mark.parametrize("heading", ["Zeit;Hoehe [um]", "time;z [um]", "No.;Z [um]"])
def test_times_and_counts_without_a_unit_are_no_positions(tmp_path: Path, heading: str) -> None:
    text = f"{heading}\n" + table(2.5 * ROW, Z_UM)
    with pytest.raises(SurfaceError, match="has no positions"):
        read(tmp_path, text, length_unit="um")
    assert_trace(read(tmp_path, text, step=1.0, length_unit="um"))


@pytest.mark.parametrize("title", ["Height 12", "Profil;12", "Position 3"])
def test_a_title_with_a_number_is_no_heading(tmp_path: Path, title: str) -> None:
    separator = ";" if ";" in title else " "
    text = f"{title}\n" + table(X_MM, Z_UM, separator=separator)
    assert_trace(read(tmp_path, text, length_unit="mm", height_unit="um"))


def test_numbers_as_they_are_written(tmp_path: Path) -> None:
    head, units = "x [mm];z [um]\n", {"length_unit": "mm", "height_unit": "um"}
    for text in (
        table(X_MM, Z_UM, style="{:.8e}").replace("e", "D"),
        table(X_MM, Z_UM, style='"{:.6f}"'),
        table(X_MM, Z_UM).replace("\n", ";;\n"),
        table(X_MM, Z_UM).replace("-", "\u2212"),
        table(X_MM, Z_UM) + "\nRa;0,21;um\nRq;0,22;um\n",
    ):
        assert_trace(read(tmp_path, head + text))
        assert_trace(read(tmp_path, text, **units))
    with pytest.raises(SurfaceError, match="could not convert string 'Ra'"):
        read(tmp_path, head + table(X_MM, Z_UM) + "Ra;Rq\n0.21;0.22\n")
    found = read(
        tmp_path,
        '"XY Calibration","1.000","um"\n"Output image data","Height"\n"Unit","um"\n\n"Height"\n'
        + table(*np.tile(Z_UM[:20, None], 12).T[:, :20], separator=",", style='"{:.6f}"'),
    )
    assert found.height.shape == (12, 20)
    assert found.step_x_m == pytest.approx(1e-6)


def test_length_and_count_above_heights_are_left_out_and_named(tmp_path: Path) -> None:
    said = {"length_unit": "mm", "height_unit": "um", "step": 0.001}
    found = read(tmp_path, f"0.059\n{COUNT}\n{table(Z_UM)}", **said)
    assert_trace(found)
    assert "left out above the heights: 0.059, 60" in found.notes[0]
    with pytest.raises(SurfaceError, match=r"the first at index 1 is 400.*must be removed"):
        read(tmp_path, f"0.059\n400\n{table(Z_UM)}", **said)
    with pytest.raises(SurfaceError, match="are not filled"):
        read(tmp_path, f"0.059\n400\n{table(Z_UM)}", fill_missing=True, **said)


def test_marks_of_missing_heights_are_named_and_filled(tmp_path: Path) -> None:
    z = Z_UM.copy()
    z[[17, 18, 40]] = -25400
    text = "x [mm];z [um]\n" + table(X_MM, z)
    with pytest.raises(SurfaceError, match=r"3 of 60 heights lie far outside.*index 17 is -25400"):
        read(tmp_path, text)
    found = read(tmp_path, text, fill_missing=True)
    assert np.abs(found.height).max() < 1e-6
    assert "3 of 60 heights lie far outside all others" in found.notes[-1]
    text = text.replace("-25400.000000", "BAD")
    with pytest.raises(SurfaceError, match="3 of 60 heights are missing"):
        read(tmp_path, text)
    found = read(tmp_path, text, fill_missing=True)
    assert "3 missing of 60" in found.notes[-1]
    spike = np.where(np.arange(COUNT) == 30, 5.0, Z_UM)  # a deep scratch is a height
    assert read(tmp_path, "x [mm];z [um]\n" + table(X_MM, spike)).height.max() > 4e-6


HEADS = {
    "marks of comments": "#\n" * 500_000,
    "one line of dashes": "-" * 1_000_000 + "\n",
    "dashes and blanks": "- " * 500_000 + "\n",
    "digits": "1" * 1_000_000 + "\n",
    "points": "1." * 500_000 + "x\n",
    "commas": "1," * 500_000 + "x\n",
    "brackets": "[(" * 500_000 + "\n",
    "quotes": '"' * 1_000_000 + "\n",
    "blanks": " " * 1_000_000 + "x\n",
    "units": "unit " * 200_000 + "\n",
    "keys": "spacing: 0.5 um\n" * 60_000,
    "underscores": "units" + "_" * 1_000_000 + "\n",
    "numbers of uneven rows": "1\n1;2\n" * 160_000 + "x\n",
    "words": "Profile of the ring\n" * 50_000,
    "separators": ";" * 1_000_000 + "\n",
    "tabs": "\t\n" * 500_000 + "a\tb\n" * 10,
    "carriage returns": "\r" * 1_000_000 + "\n",
    "exponents": "1e" * 500_000 + "x\n",
    "statements of units": "height unit: um, length unit: mm\n" * 31_000,
    "open brackets": "x [" * 333_000 + "\n",
    "words without numbers": "nan inf\n" * 125_000 + "x\n",
}


@pytest.mark.parametrize("head", HEADS.values(), ids=HEADS)
def test_a_megabyte_of_any_header_takes_seconds(tmp_path: Path, head: str) -> None:
    (tmp_path / "t.txt").write_text(head + "x [mm];z [um]\n" + table(X_MM, Z_UM))
    start = time.process_time()
    with contextlib.suppress(SurfaceError):
        assert_trace(read_surface(tmp_path / "t.txt"))
    assert time.process_time() - start < 2
