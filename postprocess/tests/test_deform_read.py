from pathlib import Path

import h5py
import numpy as np
import pandas as pd
import pytest
from contact import experiment

from ehlwave.errors import SurfaceError
from ehlwave.surface import (
    ReadOptions,
    Surface,
    deform_surface,
    map_surface,
    read_surface,
    to_dataset,
    trace_surface,
)

UM = ReadOptions(length_unit="um", height_unit="um", step=2.0)
HEIGHTS = 0.01 * np.sin(np.arange(40.0)) + 0.001 * np.arange(40)
MAP = HEIGHTS[:, None] * np.cos(np.arange(25.0) / 3)


def write(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def rows(*columns: np.ndarray, separator: str = ",") -> str:
    table = np.column_stack(columns)
    return "\n".join(separator.join(f"{cell:.12g}" for cell in row) for row in table) + "\n"


def assert_trace(surface: Surface, step: float = 2e-6) -> None:
    assert surface.height.shape == (40, 1)
    assert surface.step_x_m == pytest.approx(step)
    np.testing.assert_allclose(surface.height[:, 0], HEIGHTS * 1e-6, rtol=1e-11)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "latin-1"])
def test_text_as_other_programs_write_it(tmp_path: Path, encoding: str) -> None:
    path, mark = tmp_path / "t.txt", "\ufeff" * (encoding == "utf-16-le")
    text = (
        f"{mark}x (\u00b5m);h\u00f6he (\u00b5m)\n{rows(2 * np.arange(40), HEIGHTS, separator=';')}"
    )
    path.write_text(text, encoding=encoding)
    assert_trace(read_surface(path))
    path.write_bytes(b"\xff\xfe1\x002")
    with pytest.raises(SurfaceError, match="UTF-16"):
        read_surface(path)


@pytest.mark.parametrize(
    ("heading", "factor_x", "factor_z"),
    [
        ("x [um],height [nm]", 1, 1e3),
        ("x_mm,z_um", 1e-3, 1),
        ("position/m,height/m", 1e-6, 1e-6),
        ('"x (µm)","z (µm)"', 1, 1),
    ],
)
def test_headings_give_units(
    tmp_path: Path, heading: str, factor_x: float, factor_z: float
) -> None:
    text = heading + "\n" + rows(2 * np.arange(40) * factor_x, HEIGHTS * factor_z)
    assert_trace(read_surface(write(tmp_path / "t.csv", "# a comment\n" + text)))


def test_separators_single_columns_and_decimal_commas(tmp_path: Path) -> None:
    for separator in (";", "\t", " "):
        text = rows(2 * np.arange(40), HEIGHTS, separator=separator)
        options = ReadOptions(length_unit="um", height_unit="um")
        assert_trace(read_surface(write(tmp_path / "t.txt", text), options))
    text = rows(2 * np.arange(40), HEIGHTS, separator=";").replace(".", ",")
    assert_trace(read_surface(write(tmp_path / "t.csv", text), options))
    assert_trace(read_surface(write(tmp_path / "z.csv", rows(HEIGHTS)), UM))


def test_one_column_of_heights_needs_a_direction(tmp_path: Path) -> None:
    column = HEIGHTS[:, None]
    np.save(tmp_path / "column.npy", column)
    units = ReadOptions("um", "um", 2.0)
    for source in (column, pd.DataFrame({"z": HEIGHTS}), tmp_path / "column.npy"):
        with pytest.raises(SurfaceError, match=r"one column of unknown direction.*rolling_axis="):
            read_surface(source, units)  # type: ignore[arg-type]
    assert read_surface(HEIGHTS, units).trace_axis == "x"
    assert read_surface(HEIGHTS, ReadOptions("um", "um", 2.0, rolling_axis="y")).trace_axis == "y"
    assert read_surface(column, ReadOptions("um", "um", 1.0, 2.0)).trace_axis == "y"


def test_rolling_axis_says_what_a_row_is(tmp_path: Path) -> None:
    file = write(tmp_path / "m.csv", rows(MAP))
    np.save(tmp_path / "m.npy", MAP)
    for path in (file, tmp_path / "m.npy"):
        along = read_surface(path, ReadOptions("um", "um", 2.0, 3.0))
        across = read_surface(path, ReadOptions("um", "um", 2.0, 3.0, rolling_axis="y"))
        assert along.height.shape == (25, 40)
        assert (along.step_x_m, along.step_y_m) == pytest.approx((2e-6, 3e-6))
        assert (across.step_x_m, across.step_y_m) == pytest.approx((3e-6, 2e-6))
        np.testing.assert_allclose(across.height, MAP * 1e-6, rtol=1e-9)
        np.testing.assert_array_equal(along.height, across.height.T)


def test_a_transposed_file_with_exchanged_axis_is_the_same_surface(tmp_path: Path) -> None:
    np.save(tmp_path / "m.npy", MAP)
    np.save(tmp_path / "t.npy", MAP.T)
    one = read_surface(tmp_path / "m.npy", ReadOptions("um", "um", 2.0, 3.0))
    two = read_surface(tmp_path / "t.npy", ReadOptions("um", "um", 3.0, 2.0, rolling_axis="y"))
    results = [deform_surface(surface, experiment(radius_y_m=0.1)) for surface in (one, two)]
    np.testing.assert_array_equal(results[0].height, results[1].height)


def test_archives_and_hdf5_carry_positions_and_units(tmp_path: Path) -> None:
    x, y = 2.0 * np.arange(25), 3.0 * np.arange(40)
    np.savez(tmp_path / "m.npz", height=MAP, x=x, y=y)
    with h5py.File(tmp_path / "m.h5", "w") as file:
        for name, values in (("height", MAP), ("x", x), ("y", y)):
            file[name] = values
            file[name].attrs["units"] = "um"
    plain = ReadOptions(length_unit="um", height_unit="um")
    one = read_surface(tmp_path / "m.npz", plain)
    two = read_surface(tmp_path / "m.h5")
    assert (one.step_x_m, one.step_y_m) == pytest.approx((2e-6, 3e-6))
    np.testing.assert_array_equal(one.height, two.height)


def test_what_deform_writes_can_be_read_again(tmp_path: Path) -> None:
    for surface in (
        map_surface(MAP.T * 1e-6, 2e-6, 3e-6),
        map_surface(MAP[:25] * 1e-6, 2e-6, 3e-6),
    ):
        result = deform_surface(surface, experiment(), form="none")
        to_dataset(result).to_netcdf(tmp_path / "d.h5", engine="h5netcdf")
        again = read_surface(tmp_path / "d.h5")
        np.testing.assert_array_equal(again.height, surface.height)
        assert again.step_y_m == pytest.approx(3e-6)


def test_instrument_formats_by_surfacetopography(tmp_path: Path) -> None:
    pytest.importorskip("SurfaceTopography")
    header = (
        "aISO-1.0\nManufacID  = test\nCreateDate = 010120200000\nModDate    = 010120200000\n"
        "NumPoints  = 40\nNumProfiles = 25\nXscale     = 2.0E-6\nYscale     = 3.0E-6\n"
        "Zscale     = 1.0E-9\nZresolution = -1\nCompression = 0\n"
        "DataType   = 7\nCheckType  = 0\n*\n"
    )
    nanometres = MAP.T * 1e3
    body = "\n".join(" ".join(f"{cell:.9g}" for cell in row) for row in nanometres)
    surface = read_surface(write(tmp_path / "m.sdf", header + body + "\n*\n"))
    assert (surface.step_x_m, surface.step_y_m) == pytest.approx((2e-6, 3e-6))
    # a row of the file is a profile along x
    np.testing.assert_allclose(surface.height, MAP * 1e-6, rtol=1e-6, atol=1e-15)
    with pytest.raises(SurfaceError, match="SurfaceTopography cannot read it"):
        read_surface(write(tmp_path / "bad.x3p", "not a zip archive"))


POSITIONS = 2e-3 * np.arange(40)


def comma(text: str) -> str:
    return text.replace(".", ",")


@pytest.mark.parametrize(
    ("name", "text"),
    [
        (
            "stylus.txt",
            "Roughness tester  No. 12\nDate\t2026-11-22\nCutoff\t0,8 mm\n\n"
            "Position\tProfile\n[mm]\t[um]\n" + comma(rows(POSITIONS, HEIGHTS, separator="\t")),
        ),
        (
            "tester.csv",
            "Instrument;Model 5\nSpacing;2,0;um\nZ-Unit;nm\nPoints;40\nData\n"
            + comma(rows(1e3 * HEIGHTS))
            + "END\n",
        ),
        (
            "columns.csv",
            "# exported\nNo.,X (mm),Y (mm),Z (um),Intensity\n"
            + rows(np.arange(40), POSITIONS, 0 * POSITIONS, HEIGHTS, 100 + HEIGHTS),
        ),
        (
            "blanks.asc",
            "Trace 1, load 5 mN\nDistance [mm]   Height [um]\n"
            + comma(rows(POSITIONS, HEIGHTS, separator="   ")),
        ),
    ],
)
def test_preambles_of_instruments(tmp_path: Path, name: str, text: str) -> None:
    surface = read_surface(write(tmp_path / name, text))
    np.testing.assert_allclose(surface.height[:, 0], HEIGHTS * 1e-6, rtol=1e-9)
    assert surface.step_x_m == pytest.approx(2e-6)


def test_a_map_with_its_extent_in_the_preamble(tmp_path: Path) -> None:
    text = "# Channel: Height\n# Width: 50.0 \u00b5m\n# Height: 0.12 mm\n# Value units: nm\n"
    surface = read_surface(write(tmp_path / "map.txt", text + rows(1e3 * MAP, separator="\t")))
    assert (surface.step_x_m, surface.step_y_m) == pytest.approx((2e-6, 3e-6))
    np.testing.assert_allclose(surface.height, MAP.T * 1e-6, rtol=1e-9)


def test_text_without_numbers_is_refused_with_what_to_write(tmp_path: Path) -> None:
    with pytest.raises(SurfaceError, match="no numbers"):
        read_surface(write(tmp_path / "note.txt", "Dear all,\nplease find attached\nthe profile\n"))


def test_missing_heights_are_refused_or_filled(tmp_path: Path) -> None:
    broken = MAP.copy()
    broken[3, 4] = broken[7, 7] = np.nan
    np.save(tmp_path / "m.npy", broken)
    with pytest.raises(
        SurfaceError, match=r"2 of 1000 heights are missing.*\(4, 3\).*fill_missing"
    ):
        read_surface(tmp_path / "m.npy", UM)
    filled = read_surface(
        tmp_path / "m.npy", ReadOptions("um", "um", 2.0, fill_missing=True)
    ).height.T
    whole = np.isfinite(broken)
    np.testing.assert_array_equal(filled[whole], (MAP * 1e-6)[whole])
    assert 1e6 * filled[3, 4] in [
        pytest.approx(MAP[i, j]) for i, j in ((2, 4), (4, 4), (3, 3), (3, 5))
    ]
    broken[:8] = np.nan
    np.save(tmp_path / "m.npy", broken)
    with pytest.raises(SurfaceError, match="more than a tenth"):
        read_surface(tmp_path / "m.npy", ReadOptions("um", "um", 2.0, fill_missing=True))


def test_empty_cells_are_missing_heights(tmp_path: Path) -> None:
    text = rows(2 * np.arange(40), HEIGHTS).splitlines()
    text[5] = "10,"
    file = write(tmp_path / "t.csv", "x_um,z_um\n" + "\n".join(text))
    with pytest.raises(SurfaceError, match=r"1 of 40 heights are missing.*index 5"):
        read_surface(file)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("t.csv", "", "is empty"),
        ("t.csv", "x_um,z_um\n", "no numbers"),
        ("t.csv", "x_um,z_um\n" + rows(np.arange(4.0), np.ones(4)), "at least 8"),
        ("t.csv", "x_um,z_um\n" + rows(np.arange(9.0) ** 2, np.ones(9)), "not equidistant: number"),
        ("t.csv", "x_um,z_um\n" + rows(-np.arange(9.0), np.ones(9)), "positions decrease"),
        ("t.csv", "x_um,z_um\n" + rows(np.zeros(9), np.ones(9)), "not equidistant"),
        ("t.csv", "x_um,z_um\n1,2\n3,four\n", "could not convert string 'four'"),
        ("t.csv", "x_um,z_um\n1,2\n3\n", "columns changed"),
        (
            "t.csv",
            rows(2 * np.arange(40), HEIGHTS),
            "states no unit of its heights: set height_unit=",
        ),
        ("t.csv", "x,z_um\n" + rows(np.arange(9.0), np.ones(9)), "no unit of its lengths"),
        ("t.csv", "z_um\n" + rows(HEIGHTS), "set length_unit="),
        ("t.csv", "x_nm,z_um\n" + rows(np.arange(40), HEIGHTS), "root mean square slope"),
        ("t.npy", "nonsense", "cannot be read as npy"),
        ("t.h5", "nonsense", "cannot be read as HDF5"),
    ],
)
def test_bad_files_get_clear_messages(tmp_path: Path, name: str, text: str, message: str) -> None:
    with pytest.raises(SurfaceError, match=message):
        read_surface(write(tmp_path / name, text))


def test_bad_arrays_get_clear_messages(tmp_path: Path) -> None:
    cases = (
        ({"depth": MAP}, "no array named height"),
        ({"height": MAP, "x": np.arange(7.0)}, "7 positions along x for 25 heights"),
        ({"height": np.zeros((9, 9, 9))}, "3 dimensions"),
        ({"height": np.array(["a"] * 9)}, "real numbers"),
    )
    for arrays, message in cases:
        np.savez(tmp_path / "m.npz", **arrays)
        with pytest.raises(SurfaceError, match=message):
            read_surface(tmp_path / "m.npz", ReadOptions("um", "um"))
    np.save(tmp_path / "c.npy", MAP + 1j)
    with pytest.raises(SurfaceError, match="complex"):
        read_surface(tmp_path / "c.npy", UM)
    np.save(tmp_path / "m.npy", MAP)
    with pytest.raises(SurfaceError, match="give the sampling step by step="):
        read_surface(tmp_path / "m.npy", ReadOptions("um", "um"))
    with pytest.raises(SurfaceError, match="unknown unit of length 'furlong'"):
        read_surface(tmp_path / "m.npy", ReadOptions("furlong", "um", 2.0))
    with pytest.raises(SurfaceError, match="positive length"):
        read_surface(tmp_path / "m.npy", ReadOptions("um", "um", -2.0))
    with pytest.raises(SurfaceError, match="no such file"):
        read_surface(tmp_path / "absent.csv")


@pytest.mark.parametrize("compressed", [False, True])
def test_damaged_archives_are_refused(tmp_path: Path, compressed: bool) -> None:
    """Whatever byte is damaged or lost: an array, or a message of one line."""
    file = tmp_path / "m.npz"
    (np.savez_compressed if compressed else np.savez)(file, height=MAP[:10, :10])
    good = file.read_bytes()
    read_surface(file, UM)
    damaged = [good[:n] for n in range(0, len(good), 97)]
    for place in range(0, len(good), 7):
        damaged.append(good[:place] + bytes([good[place] ^ 0x55]) + good[place + 1 :])
    messages = []
    for data in damaged:
        file.write_bytes(data)
        try:
            read_surface(file, UM)
        except SurfaceError as error:
            messages.append(str(error))
    assert len(messages) > len(damaged) // 4
    assert max(map(len, messages)) < 600
    assert not any("\n" in message for message in messages)


def test_files_that_claim_too_much_are_refused(tmp_path: Path) -> None:
    with h5py.File(tmp_path / "m.h5", "w") as file:
        file.create_dataset("height", shape=(200_000, 200_000), dtype="f8", chunks=(64, 64))
    with pytest.raises(SurfaceError, match="claims 40000000000 numbers"):
        read_surface(tmp_path / "m.h5", UM)
    np.save(tmp_path / "m.npy", MAP)
    data = (tmp_path / "m.npy").read_bytes()
    (tmp_path / "m.npy").write_bytes(data.replace(b"(40, 25), ", b"(4e9999,9)"[:10]))
    with pytest.raises(SurfaceError, match="cannot be read as npy"):
        read_surface(tmp_path / "m.npy", UM)


def test_traces_and_maps_of_wrong_shape_are_refused() -> None:
    with pytest.raises(SurfaceError, match="one dimension"):
        trace_surface(MAP, 1e-6)
    with pytest.raises(SurfaceError, match="two dimensions"):
        map_surface(HEIGHTS, 1e-6, 1e-6)
