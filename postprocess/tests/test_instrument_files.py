"""Files of instruments: known by content, with their units, channels and reasons."""

import io
import zipfile
from pathlib import Path

import numpy as np
import pytest
from instrument_files import (
    HEIGHT_M,
    NX,
    NY,
    STEP_M,
    X,
    gwyddion,
    metropro,
    nanofocus,
    sdf,
    x3p,
)

from ehlwave.cli import main
from ehlwave.errors import SurfaceError
from ehlwave.surface import ReadOptions, Surface, read_surface

package = pytest.importorskip("SurfaceTopography")


def write(folder: Path, name: str, data: bytes) -> Path:
    path = folder / name
    path.write_bytes(data)
    return path


def assert_read(surface: Surface, rtol: float = 1e-6) -> None:
    np.testing.assert_allclose(surface.height, HEIGHT_M.T, rtol=rtol, atol=1e-12)
    assert (surface.step_x_m, surface.step_y_m) == pytest.approx((STEP_M, STEP_M), rel=1e-6)


def test_the_unit_of_a_file_stands_against_options(tmp_path: Path) -> None:
    path = write(tmp_path, "a.gwy", gwyddion({"Height": HEIGHT_M}))
    assert_read(read_surface(path))
    assert_read(read_surface(path, ReadOptions(length_unit="m", height_unit="m")))
    for option in ("length_unit", "height_unit"):
        with pytest.raises(
            SurfaceError, match=rf"{option}=um contradicts the file, whose unit is m"
        ):
            read_surface(path, ReadOptions(**{option: "um"}))
    # A given unit of a step applies to this step alone.
    assert_read(read_surface(path, ReadOptions(length_unit="um", step=1.0)))
    csv = write(
        tmp_path,
        "a.csv",
        b"x [mm];z [um]\n" + b"".join(b"%d;0.%d\n" % (k, k % 7) for k in range(20)),
    )
    with pytest.raises(SurfaceError, match="height_unit=nm contradicts the file, whose unit is um"):
        read_surface(csv, ReadOptions(height_unit="nm"))
    assert read_surface(csv, ReadOptions("mm", "micron")).step_x_m == pytest.approx(1e-3)


def test_the_height_channel_is_chosen_or_asked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = 1e-9 * X + 0 * HEIGHT_M
    path = write(tmp_path, "a.gwy", gwyddion({"Amplitude": other, "Height": HEIGHT_M}))
    found = read_surface(path)
    assert_read(found)
    assert found.notes == ("read as Gwyddion (gwy), channel 'Height'",)
    assert main(["surface", str(path), "--output", str(tmp_path / "s.h5")]) == 0
    assert "channel 'Height'" in capsys.readouterr().out
    path = write(tmp_path, "b.gwy", gwyddion({"Height trace": HEIGHT_M, "Height retrace": other}))
    with pytest.raises(SurfaceError, match=r"'Height trace', 'Height retrace': choose by channel="):
        read_surface(path)
    assert main(["surface", str(path), "--output", str(tmp_path / "s.h5")]) == 2
    assert "choose by --channel" in capsys.readouterr().err
    assert_read(read_surface(path, ReadOptions(channel="height trace")))
    for name in ("Amplitude", "FFT of Height", "Background of Height", "Height difference"):
        path = write(tmp_path, "c.gwy", gwyddion({name: other}))
        with pytest.raises(SurfaceError, match="which channel holds the heights"):
            read_surface(path)
    path = write(
        tmp_path, "d.gwy", gwyddion({"AmplitudeRetrace": other, "ZSensorRetrace": HEIGHT_M})
    )
    assert_read(read_surface(path))


def test_sizes_that_no_surface_has_are_refused_until_the_step_is_said(tmp_path: Path) -> None:
    path = write(tmp_path, "a.nms", nanofocus(step=312.5))
    with pytest.raises(
        SurfaceError, match=r"a step of 3.125e\+05 um.*give the right step by step="
    ):
        read_surface(path)
    found = read_surface(path, ReadOptions(length_unit="um", step=0.3125))
    assert found.step_x_m == pytest.approx(3.125e-7)
    np.testing.assert_allclose(found.height, HEIGHT_M.T, atol=1e-11)


@pytest.mark.parametrize("step", [0.0, -1.0])
def test_steps_that_a_file_lacks_are_asked(tmp_path: Path, step: float) -> None:
    path = write(tmp_path, "a.dat", metropro(step))
    # The second text is with SurfaceTopography 1.23.
    lacks = r"has no positions: give the sampling step by|states a step of (0|-1e\+06) um"
    with pytest.raises(SurfaceError, match=lacks):
        read_surface(path)
    said = ReadOptions(length_unit="um", step=1.0)
    np.testing.assert_allclose(read_surface(path, said).height, HEIGHT_M.T, atol=3e-12)
    path = write(tmp_path, "a.x3p", x3p(step=step))
    with pytest.raises(SurfaceError, match=r"states a step of (0|-1e\+06) um.*give the right step"):
        read_surface(path)
    assert_read(read_surface(path, said))


def in_archive(names: dict[str, str], data: bytes) -> bytes:
    """Return an X3P file with other names of its parts."""
    made = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(made, "w") as new:
        for name, inside in names.items():
            new.writestr(inside, old.read(name) if name in old.namelist() else b"")
    return made.getvalue()


@pytest.mark.parametrize(
    "names",
    [
        ("./main.xml", "./bindata/data.bin", "md5checksum.hex"),
        ("main.xml", "bindata\\data.bin", "__MACOSX/main.xml"),
        ("my\\main.xml", "my\\bindata\\data.bin", "my\\md5checksum.hex"),
        ("My part/Main.XML", "My part/bindata/data.bin", "__MACOSX/My part/main.xml"),
    ],
)
def test_names_within_an_x3p(tmp_path: Path, names: tuple[str, str, str]) -> None:
    parts = ("main.xml", "bindata/data.bin", "other")
    data = in_archive(dict(zip(parts, names, strict=True)), x3p())
    assert_read(read_surface(write(tmp_path, "a.x3p", data)))


def test_formats_are_known_by_content(tmp_path: Path) -> None:
    for name, data in {
        "a.x3p": x3p(),
        "b.x3p": x3p("my/"),
        "c.dat": x3p(),
        "d.sdf": sdf("aISO-1.0"),
        "e.sdf": sdf("aBCR-1.0"),
        "i.sdf": sdf("aNM-2"),
        "f.txt": sdf("aISO-1.0"),
        "g.csv": gwyddion({"Height": HEIGHT_M}),
    }.items():
        assert_read(read_surface(write(tmp_path, name, data)))
    topography = package.Topography(HEIGHT_M.T, (NX * STEP_M, NY * STEP_M), unit="m")
    topography.to_netcdf(str(tmp_path / "h.nc"))
    assert_read(read_surface(tmp_path / "h.nc"))


def test_the_reason_is_that_of_the_format(tmp_path: Path) -> None:
    good = x3p()
    for data in (good[:-30], good.replace(b"<SizeZ>1<", b"<SizeZ>2<")):
        with pytest.raises(SurfaceError, match=r"cannot read it as .*\(x3p\): ") as caught:
            read_surface(write(tmp_path, "a.x3p", data))
        assert "XYZ" not in str(caught.value)
    with pytest.raises(SurfaceError, match=r"no reader knows its content or the ending '\.abc'"):
        read_surface(write(tmp_path, "a.abc", bytes(range(256)) * 9))
    # Two bytes a point of a square: heights in metres to a reader without a mark.
    with pytest.raises(SurfaceError, match="no reader knows"):
        read_surface(write(tmp_path, "b.bin", bytes(range(256)) * 98 + bytes(130)))
