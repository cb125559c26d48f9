"""Damaged and crafted files: every command answers, or prints a reason of one line."""

import os
from collections.abc import Callable
from pathlib import Path
from random import Random

import h5py
import numpy as np
import pytest
import xarray as xr
from contact import EXPERIMENT
from matplotlib.figure import Figure
from synthetic import make_columns, write_results

from ehlwave.cli import main
from ehlwave.errors import ResultsError, SurfaceError, printable
from ehlwave.hdf5 import opened
from ehlwave.results.read import read_results
from ehlwave.surface import ReadOptions, read_surface

Capture = pytest.CaptureFixture[str]
CONDITIONS = ["--conditions", *(f"{key}={value}" for key, value in EXPERIMENT.items())]
UM = ReadOptions("um", "um", 2.0)
MUTATIONS = int(
    os.environ.get("EHLWAVE_DRAWS", "400" if os.environ.get("EHLWAVE_LONG_TESTS") else "6")
)
HEIGHTS = 0.01 * np.sin(np.arange(40.0))


def case_file(path: Path) -> Path:
    """Write the file of a case with a history, as ehlwave-case does."""
    x = np.linspace(-2.5, 1.5, 9)
    film = 1 + x[None, :] ** 2 + np.abs(x)[:, None]
    fields = {"film": (("y", "x"), film), "pressure": (("y", "x"), film)}
    numbers = {"central_film": 0.5, "minimum_film": 0.4, "load_parameter_m": 100.0}
    numbers |= {"lubricant_parameter_l": 10.0, "semi_axis_a_m": 1e-4, "hertz_approach_c_m": 1e-6}
    numbers |= {"hertz_pressure_pa": 5e8, "slip_parameter": 1.0, "domain_x_min": -2.5}
    time = {"film_at_centre": (("time",), 1 + 0.1 * np.cos(np.arange(12.0)))}
    coordinates = {"x": x, "y": x, "time": np.arange(12.0)}
    case = xr.Dataset({**fields, **numbers, **time, "wavelength_x_over_a": 0.5}, coordinates)
    case.attrs = {"format": "ehlwave-case", "status": "converged", "orientation": "transverse"}
    text = "&conditions\n  mean_speed_m_per_s = 1.5\n/\n&waviness\n  amplitude_over_film = 0.2\n/\n"
    case.attrs["effective_input"] = text
    case.to_netcdf(path, engine="h5netcdf")
    return path


def commands(kind: str, file: Path, folder: Path) -> list[list[str]]:
    output = ["--output", str(folder / "out")]
    if kind == "results":
        fast = [["table", str(file)], ["export", str(file), "--csv", str(folder / "e.csv")]]
        return [*fast, ["harmonics", str(file), "--csv", str(folder / "h.csv")]]
    if kind == "case":
        return [["contact", str(file), *output], ["plot", str(file), *output]]
    return [["surface", str(file), "--output", str(folder / "s.h5")]]


def answers(arguments: list[str], capsys: Capture) -> str:
    """Run a command; return its error message, one line, "" if it has an answer."""
    status = main(arguments)
    said = capsys.readouterr().err
    assert status in (0, 2), (arguments, said)
    errors = [line for line in said.splitlines() if "warning:" not in line and "note:" not in line]
    assert len(errors) == (1 if status == 2 else 0), said
    assert status == 0 or errors[0].startswith("ehlwave: error: ")
    assert "Traceback" not in said
    return errors[0] if errors else ""


def mutate(path: Path, random: Random) -> None:
    """Drop, rename, reshape or falsify something of an HDF5 file."""
    with h5py.File(path, "r+") as file:
        kind = random.randrange(6)
        if kind == 0:
            owner = random.choice([file, file[random.choice(sorted(file))]])
            if len(owner.attrs):
                name = random.choice(sorted(owner.attrs))
                del owner.attrs[name]
                if random.random() < 0.5:
                    odd = random.choice([np.nan, -1, "", "\x1b[2J", np.arange(3), b"\xff"])
                    owner.attrs[name] = odd
            return
        name = random.choice(sorted(file))
        old = file[name]
        value = old[()] if old.shape is not None else np.zeros(1)
        is_number = np.asarray(value).dtype.kind in "fiu"
        if kind == 1:
            del file[name]
        elif kind == 2 and is_number and not old.is_scale:
            worst = random.choice([np.nan, np.inf, -np.inf, 0.0, -1.0, 1e308, 1e-300])
            new = np.where(
                np.random.default_rng(random.randrange(99)).random(old.shape) < 0.5, worst, value
            )
            del file[name]
            file[name] = new
        elif kind == 3 and is_number and old.dtype.kind == "f":
            old[...] = random.choice([np.nan, np.inf, 0.0, -1.0])
        elif kind == 4:
            del file[name]
            file[name] = random.choice(
                [np.float64(1), np.zeros((2, 3)), np.bytes_(b"\x1b[31m"), np.zeros(0)]
            )
        else:
            del file[name]
            file.create_group(name)


@pytest.fixture
def coarse_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw all of every figure, with few dots."""
    draw = Figure.savefig

    def coarse(figure: Figure, part: Path, **_: object) -> None:
        draw(figure, part, format="png", dpi=20)

    monkeypatch.setattr(Figure, "savefig", coarse)


@pytest.mark.parametrize("kind", ["results", "case", "surface"])
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.usefixtures("coarse_pictures")
def test_mutations_of_results_have_an_answer_or_a_reason(
    tmp_path: Path, capsys: Capture, kind: str
) -> None:
    good = tmp_path / "good.h5"
    if kind == "results":
        write_results(good, make_columns(conditions={(100.0, 1.0): 1.0}))
    elif kind == "case":
        case_file(good)
    else:
        with h5py.File(good, "w") as file:
            for name, values in (("height", HEIGHTS), ("x", 2.0 * np.arange(40))):
                file[name] = values
                file[name].attrs["units"] = "um"
    for command in commands(kind, good, tmp_path):
        assert answers(command, capsys) == ""
    refused = 0
    random = Random(5)
    for number in range(MUTATIONS):
        path = tmp_path / f"{number}.h5"
        data = good.read_bytes()
        path.write_bytes(data)
        if number % 4 == 3:
            path.write_bytes(data[: random.randrange(len(data))])
        else:
            for _ in range(random.randrange(1, 3)):
                mutate(path, random)
        for command in commands(kind, path, tmp_path):
            refused += bool(
                answers([*command, "--overwrite"] if "table" not in command else command, capsys)
            )
    assert refused > MUTATIONS // 4


def linked(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file["height"] = h5py.ExternalLink("secret.h5", "/height")


def linked_in_a_group(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file.create_group("a")["b"] = h5py.ExternalLink("secret.h5", "/")
        file["height"] = h5py.SoftLink("/a/b/height")


def external(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file.create_dataset(
            "height", (8,), "f8", external=[(str(path.parent / "secret.h5"), 0, 64)]
        )


def virtual(path: Path) -> None:
    layout = h5py.VirtualLayout((40,), "f8")
    layout[:] = h5py.VirtualSource("secret.h5", "height", (40,))
    with h5py.File(path, "w") as file:
        file.create_virtual_dataset("height", layout)


def claiming(path: Path) -> None:
    with h5py.File(path, "w") as file:
        file.create_dataset("height", (90_000_000,), "f8", chunks=(1000,))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (linked, "is a link into the file secret.h5, which is not followed"),
        (linked_in_a_group, "/a/b is a link into the file secret.h5, which is not followed"),
        (external, "/height has its data in another file, which is not followed"),
        (virtual, "/height is a view of other files .virtual., which is not followed"),
        (claiming, "/height claims 90000000 numbers, of which the file holds 0 bytes"),
    ],
)
@pytest.mark.parametrize("suffix", [".h5", ".hdf"])
def test_files_that_do_not_stand_for_themselves_are_refused(
    tmp_path: Path, make: Callable[[Path], None], message: str, suffix: str
) -> None:
    with h5py.File(tmp_path / "secret.h5", "w") as file:
        file["height"] = HEIGHTS
    path = tmp_path / f"m{suffix}"
    make(path)
    assert path.stat().st_size < 20_000
    with pytest.raises(ResultsError, match=message), opened(path):
        pass
    with pytest.raises(SurfaceError, match=message):
        read_surface(path, UM)


def test_nothing_is_unpickled(tmp_path: Path, capsys: Capture) -> None:
    class Trap:
        def __reduce__(self) -> tuple[object, ...]:
            return os.mkdir, (str(tmp_path / "trapped"),)

    heights = np.array([Trap()] * 9, dtype=object)
    np.save(tmp_path / "t.npy", heights, allow_pickle=True)
    np.savez(tmp_path / "t.npz", height=heights)
    (tmp_path / "pickled.npy").write_bytes(__import__("pickle").dumps(Trap()))
    for name in ("t.npy", "t.npz", "pickled.npy"):
        with pytest.raises(SurfaceError, match="cannot be read"):
            read_surface(tmp_path / name, UM)
    assert not (tmp_path / "trapped").exists()


@pytest.mark.parametrize("suffix", [".csv", ".npy", ".npz", ".h5", ".sdf", ".x3p", ".unknown"])
@pytest.mark.parametrize("content", [b"", b"\0" * 64, b"\x89HDF\r\n\x1a\n", b"PK\x03\x04", b"text"])
def test_no_file_of_any_name_ends_in_a_traceback(
    tmp_path: Path, capsys: Capture, suffix: str, content: bytes
) -> None:
    path = tmp_path / f"t{suffix}"
    path.write_bytes(content)
    output = ["--output", str(tmp_path / "out")]
    assert answers(["surface", str(path), "--step", "1", *output], capsys)
    if suffix in (".csv", ".h5"):
        for command in (["table"], ["contact"], ["plot"]):
            assert answers([*command, str(path)], capsys)
        assert answers(["deform", str(path), *CONDITIONS, *output], capsys)
        trace = tmp_path / "good.csv"
        trace.write_text("x_um,z_um\n" + "\n".join(f"{2 * k},{z}" for k, z in enumerate(HEIGHTS)))
        for option in ("--table", "--refit"):
            assert answers(["deform", str(trace), *CONDITIONS, option, str(path)], capsys)
        assert answers(["deform", str(trace), "--conditions", str(path)], capsys)


def test_folders_pipes_and_secrets_are_named(tmp_path: Path, capsys: Capture) -> None:
    os.mkfifo(tmp_path / "pipe.csv")
    (tmp_path / "folder.csv").mkdir()
    for name, said in (("pipe.csv", "not a regular file"), ("folder.csv", "is a directory")):
        for command in (["surface"], ["table"], ["contact"], ["plot"]):
            output = ["--output", str(tmp_path / "s.h5")] if command == ["surface"] else []
            assert said in answers([*command, str(tmp_path / name), *output], capsys)


def test_what_a_terminal_obeys_never_reaches_it(tmp_path: Path, capsys: Capture) -> None:
    evil = "\x1b[2J\x07\x9b31m\u202e"
    columns = make_columns()
    columns["status"] = np.array([f"fa\x1b[2Jiled{k % 2}" for k in range(60)])
    columns["case_id"] = np.array([f"c{evil}{k}" for k in range(60)])
    source = write_results(tmp_path / f"r{evil}.h5", columns)
    absent = str(tmp_path / f"absent\n{evil}\udcff.h5")
    trace = tmp_path / f"t{evil}$^.csv"
    trace.write_text("x_um,z_um\n" + "\n".join(f"{2 * k},{z}" for k, z in enumerate(HEIGHTS)))
    for arguments in (
        ["table", str(source)],
        ["table", absent],
        ["collapse", str(source)],
        ["surface", str(trace), "--output", str(tmp_path / "s.h5")],
        ["deform", str(trace), *CONDITIONS, "--output", str(tmp_path / f"o{evil}")],
    ):
        main(arguments)
        said = capsys.readouterr()
        for text in (said.out, said.err):
            assert printable(text, kept="\n\t") == text
    for read in (read_results, read_surface):
        with pytest.raises(ResultsError) as caught:
            read(absent)
        assert printable(str(caught.value), kept="\n\t") == str(caught.value)
    main(["table", str(source)])
    assert "fa\\x1b[2Jiled" in capsys.readouterr().out


def test_an_unknown_option_is_shown_as_text(capsys: Capture) -> None:
    with pytest.raises(SystemExit):
        main(["table", "--\x1b[2J"])
    assert "\x1b" not in capsys.readouterr().err
