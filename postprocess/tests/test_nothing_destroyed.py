import os
from pathlib import Path
from random import Random

import numpy as np
import pytest
import xarray as xr
from contact import EXPERIMENT
from drawn_folders import CONDITIONS, DrawnFolder, Snapshot
from matplotlib.figure import Figure
from synthetic import make_columns, write_results

from ehlwave import cli
from ehlwave.cli import deform as deform_cli
from ehlwave.cli import main
from ehlwave.cli import results as results_cli
from ehlwave.cli.named_files import inputs
from ehlwave.results import case_figures, figures
from ehlwave.results.refit import RefitRow
from ehlwave.surface import figures as deform_figures
from ehlwave.writing import LIST_NAME, OutputError, Writer

Capture = pytest.CaptureFixture[str]
DEFAULT = "2000" if os.environ.get("EHLWAVE_LONG_TESTS") else "10"
DRAWS = int(os.environ.get("EHLWAVE_DRAWS", DEFAULT))
"""Folders, in each of which two commands run, and once more where they succeed."""


@pytest.fixture(scope="module")
def sources(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with an input of each kind."""
    folder = tmp_path_factory.mktemp("sources")
    columns = make_columns(conditions={(100.0, 1.0): 1.0})
    write_results(folder / "results.h5", columns)
    x = np.linspace(-2.5, 1.5, 9)
    film = 1 + x[None, :] ** 2 + np.abs(x)[:, None]
    fields = {"film": (("y", "x"), film), "pressure": (("y", "x"), film)}
    numbers = {"central_film": 0.5, "minimum_film": 0.4}
    numbers |= {"load_parameter_m": 100.0, "lubricant_parameter_l": 10.0}
    case = xr.Dataset({**fields, **numbers}, {"x": x, "y": x})
    case.attrs = {"format": "ehlwave-case", "status": "converged"}
    case.to_netcdf(folder / "c.h5", engine="h5netcdf")
    for name in ("trace.csv", "other.csv"):
        heights = 0.01 * np.sin(np.arange(24.0))
        lines = (f"{2 * place},{height:.6f}" for place, height in enumerate(heights))
        (folder / name).write_text("x_um,z_um\n" + "\n".join(lines) + "\n")
    keys = "\n".join(f"  {key} = {value}" for key, value in EXPERIMENT.items())
    (folder / "contact.nml").write_text(f"&conditions\n{keys}\n/\n")
    (folder / "refit.csv").write_text("group,variable,c1,c2\nall,f_v,0.2,0.03\n")
    return folder


@pytest.fixture
def small_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw nothing: the test is about writing figures, not their content."""

    def empty(*_: object, **__: object) -> Figure:
        return Figure(figsize=(0.1, 0.1))

    fitted = RefitRow("all", "f_v", 15, 1, 0.1, c1=0.2, c2=0.03)
    monkeypatch.setattr(results_cli, "refit_groups", lambda *_: [fitted])
    monkeypatch.setattr(figures, "collapse_figure", empty)
    for module, name in (
        (results_cli, "contact_figure"),
        (case_figures, "case_figure"),
        (deform_figures, "deformed_figure"),
        (deform_figures, "spectrum_figure"),
    ):
        monkeypatch.setattr(module, name, empty)
    monkeypatch.setattr(deform_cli, "MOST_COMPARED", 0)


def lost(before: Snapshot, after: Snapshot) -> list[str]:
    return [path for path, what in before.items() if after.get(path) != what]


@pytest.mark.usefixtures("small_pictures")
def test_nothing_that_is_no_result_of_ours_ever_changes(
    tmp_path: Path, sources: Path, capsys: Capture
) -> None:
    random = Random(20261123)
    statuses: dict[int, int] = {}
    for draw in range(DRAWS):
        drawn = DrawnFolder(tmp_path / str(draw), sources, random)
        ours: Snapshot = {}
        for _ in range(2):
            command = drawn.command()
            before = drawn.snapshot()
            status = main(command)
            said = capsys.readouterr().err
            after = drawn.snapshot()
            statuses[status] = statuses.get(status, 0) + 1
            assert status in (0, 2), (command, said)
            errors = [x for x in said.splitlines() if not x.startswith("ehlwave: note:")]
            assert status == 0 or len(errors) == 1, said
            inputs = drawn.read_by(command)
            for path in lost(before, after):
                is_ours = ours.get(path) == before[path]
                may = "--overwrite" in command and path not in inputs
                assert is_ours or (may and before[path][0] == "file"), (command, path)
            if status == 0 and not drawn.has_lists_of_others():
                # A repeated command succeeds: all files are ours now.
                again = [word for word in command if word != "--overwrite"]
                assert main(again) == 0, " ".join(again) + capsys.readouterr().err
                capsys.readouterr()
                after = drawn.snapshot()
            ours |= {path: what for path, what in after.items() if before.get(path) != what}
            if ours and random.random() < 0.3:
                changed = random.choice(sorted(path for path in ours if ours[path][0] == "file"))
                Path(changed).write_text("edited by hand")
    assert min(statuses[0], statuses[2]) > DRAWS / 4, statuses


@pytest.mark.usefixtures("small_pictures")
def test_an_input_is_never_an_output(tmp_path: Path, sources: Path, capsys: Capture) -> None:
    drawn = DrawnFolder(tmp_path / "d", sources, Random(1))
    here, place = drawn.here, {name: str(path) for name, path in drawn.inputs.items()}
    (here / "twin.csv").hardlink_to(place["trace.csv"])
    (here / "link.csv").symlink_to(place["trace.csv"])
    Path(place["other.csv"]).rename(here / "deformed.csv")
    before = drawn.snapshot()
    for command in (
        ["surface", place["trace.csv"], "--output", place["trace.csv"]],
        ["surface", place["trace.csv"], "--output", str(here / "twin.csv")],
        ["surface", place["trace.csv"], "--output", str(here / "link.csv")],
        ["surface", str(here / "link.csv"), "--output", place["trace.csv"]],
        ["export", place["results.h5"], "--csv", place["results.h5"]],
        ["harmonics", place["results.h5"], "--csv", place["results.h5"]],
        ["deform", str(here / "deformed.csv"), "--conditions", *CONDITIONS, "--output", str(here)],
        ["surface", place["trace.csv"], "--output", str(tmp_path / "d" / "outside" / "notes.txt")],
    ):
        for extra in ([], ["--overwrite"]) if "notes.txt" not in command[-1] else ([],):
            assert main([*command, *extra]) == 2, command
            said = capsys.readouterr().err
            assert "name another" in said or "is a link" in said
            assert said.count("\n") == 1
            assert not lost(before, drawn.snapshot()), command


def test_results_are_replaced_until_somebody_changes_them(tmp_path: Path) -> None:
    path = tmp_path / "new" / "table.csv"
    Writer().text(path, "1")
    Writer().text(path, "2")
    assert path.read_text() == "2"
    path.write_text("2 ")
    with pytest.raises(OutputError, match="or was changed since"):
        Writer().text(path, "3")
    Writer(overwrite=True).text(path, "3")
    Writer().text(path, "4")
    path.chmod(0o444)
    with pytest.raises(OutputError, match="not a result"):
        Writer().text(path, "5")
    assert path.read_text() == "4"


def test_what_fails_in_the_middle_leaves_nothing(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    Writer().text(path, "whole")

    def fail(part: Path) -> None:
        part.write_text("half")
        raise OSError("disk full")

    with pytest.raises(OSError, match="disk full"):
        Writer().file(path, fail)
    assert path.read_text() == "whole"
    assert {one.name for one in tmp_path.iterdir()} == {"table.csv", LIST_NAME}


def test_two_outputs_of_a_command_are_two_files(tmp_path: Path) -> None:
    (tmp_path / "second").symlink_to(tmp_path)
    writer = Writer()
    writer.text(tmp_path / "a.csv", "1")
    with pytest.raises(OutputError, match="just written"):
        writer.text(tmp_path / "second" / "a.csv", "2")


def test_a_list_of_somebody_else_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / LIST_NAME).write_text("my own")
    Writer().text(tmp_path / "a.csv", "1")
    assert (tmp_path / LIST_NAME).read_text() == "my own"
    with pytest.raises(OutputError, match="not a result"):
        Writer().text(tmp_path / "a.csv", "2")


def test_files_have_the_modes_of_other_files(tmp_path: Path) -> None:
    (tmp_path / "plain").write_text("")
    made = Writer().text(tmp_path / "a.csv", "1")
    assert made.stat().st_mode == (tmp_path / "plain").stat().st_mode


def test_files_that_an_input_file_names_are_inputs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("it's").mkdir()
    oil = Path("it's", "traction.csv")
    oil.write_text("pressure_pa,viscosity_pa_s\n")
    case = Path("case.nml")
    case.write_text("&lubricant viscosity_table = 'it''s/traction.csv', viscosity_law='table' /\n")
    for words in (
        ["traction", "case.nml"],
        ["replenish", "--conditions", "eyring_stress_pa=5e6", "case.nml", "--track-length", "1"],
        ["stress", "case.h5", "--conditions", "case.nml"],
    ):
        options = cli.command_parser().parse_args([*words, "--output", "it's", "--overwrite"])
        writer = Writer(inputs(options), overwrite=True)
        with pytest.raises(OutputError, match="is the input it's/traction"):
            writer.text(oil, "lost")
    assert main(["traction", "case.nml", "--output", "it's", "--overwrite"]) == 2
    assert oil.read_text() == "pressure_pa,viscosity_pa_s\n"
    case.write_bytes(b"&lubricant viscosity_table = '\xff'\n&&/\0")
    assert str(case) in map(str, inputs(cli.command_parser().parse_args(["traction", "case.nml"])))
