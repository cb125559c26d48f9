"""Cases and studies by the built programs, their results as :class:`xarray.Dataset`."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
import warnings
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd
import xarray as xr

from ehlwave.errors import ProgramError
from ehlwave.hdf5 import read_dataset
from ehlwave.hints import did_you_mean, see
from ehlwave.programs.programs import find_program, find_run_sweep, namelist
from ehlwave.programs.progress import Following, following, run_following
from ehlwave.quantities import in_si
from ehlwave.results.labels import with_labels_of
from ehlwave.results.read import read_results
from ehlwave.shown import Shown, html_table
from ehlwave.writing import write_new_text

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ehlwave.inputs.keys import CaseKeys, StudyKeys

SURFACES = {"surface": "file", "surface2": "file_2"}
"""Keys of measured surfaces by their groups."""

OPTIONS = ("case_file", "output", "unresolved", "largest_case_seconds", "checkpoint_seconds")
"""Keys of ``&sweep`` that are not lists of values."""

NOTICE = "NOTICE: "
"""Begins lines in which a sweep warns."""

LABEL = "label"
"""Column of a table of cases that names them; not a key of the program."""


class Case:
    """One case for ``ehlwave-case``.

    Parameters
    ----------
    **keys
        Keys of its input file (``inputs/README.md``, ``ehlwave-case --keys``), whatever their
        group: numbers, text, bool. Plain numbers are SI; quantities of pint are converted.
        ``file``, a measured surface, may be a :class:`ehlwave.surface.Surface` or an object of
        SurfaceTopography; it is taken as it is, see :func:`ehlwave.surface.simulation_surface`.

    Raises
    ------
    ProgramError
        If there is no program, or no such key.

    Examples
    --------
    >>> import ehlwave
    >>> case = ehlwave.Case(load_parameter_m=10, lubricant_parameter_l=5, radius_ratio_d=1,
    ...     orientation="transverse", wavelength_over_a=1, response="harmonic",
    ...     cells_x=64, cells_y=64)
    >>> result = case.run()
    >>> print(result.attrs["status"], f"Ad/Ai = {float(result['harmonic_ratio']):.2f}")
    converged Ad/Ai = 0.93
    """

    def __init__(self, **keys: Unpack[CaseKeys]) -> None:
        """Sort the keys into the groups of an input file."""
        self.groups = grouped(keys)

    def __repr__(self) -> str:
        """Return the input file."""
        return namelist(self.groups)

    def _repr_html_(self) -> str:
        keys = {key: str(value) for group in self.groups.values() for key, value in group.items()}
        return html_table("Case", keys)

    def plan(self) -> dict[str, Any]:
        """Return what would be computed, and on which grid, by the names of ``--plan --json``.

        Examples
        --------
        >>> import ehlwave
        >>> case = ehlwave.Case(load_parameter_m=10, lubricant_parameter_l=5, radius_ratio_d=1,
        ...     orientation="transverse", wavelength_over_a=1, response="harmonic",
        ...     cells_x=64, cells_y=64)
        >>> plan = case.plan()
        >>> plan["cells_x"], plan["run"], plan["is_resolved"]
        (64, 'harmonic', True)
        """
        return self._json("--plan")

    def run(self, seconds: float | None = None, progress: Following = None) -> xr.Dataset:
        """Compute the case.

        Parameters
        ----------
        seconds : float, optional
            Wall time after which it is stopped.
        progress : callable or False, optional
            Called as ``progress(done, whole, text)`` for each line of progress; ``text`` says what
            is counted, such as ``"time step"``. Without it a notebook shows a bar if tqdm is
            installed; False: none.

        Returns
        -------
        xarray.Dataset
            All quantities of the result (0-dimensional, with units and long names), fields over
            ``y`` and ``x``, histories over ``time``; text, ``status`` among it, as attributes. A
            case that did not converge has its status there and no fields.

        Raises
        ------
        ProgramError
            If the program refuses the input.
        subprocess.TimeoutExpired
            If it takes longer than `seconds`.

        Examples
        --------
        >>> import ehlwave
        >>> case = ehlwave.Case(load_parameter_m=10, lubricant_parameter_l=5, radius_ratio_d=1,
        ...     orientation="transverse", wavelength_over_a=1, response="harmonic",
        ...     cells_x=64, cells_y=64)
        >>> result = case.run(seconds=60)
        >>> result["harmonic_ratio"].attrs["units"], result["pressure"].dims
        ('1', ('y', 'x'))
        """
        with tempfile.TemporaryDirectory() as folder:
            output = Path(folder, "case.h5")
            self._json("--output", str(output), seconds=seconds, progress=progress)
            return read_dataset(output)

    def _json(
        self, *options: str, seconds: float | None = None, progress: Following = False
    ) -> dict[str, Any]:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "case.nml")
            write_new_text(path, namelist(_with_surface_files(self.groups, Path(folder))))
            command = [str(find_program("ehlwave-case")), str(path), "--json", *options]
            with following(progress) as callback:
                quiet = [] if callback else ["--quiet"]
                done = run_following([*command, *quiet], callback, "stderr", seconds)
            _check(done, (0, 1))
        lines = done.stdout.rstrip().splitlines()
        return dict(json.loads(lines[-1]))


class Study(Shown):
    """Many cases for ``ehlwave-sweep``.

    Parameters
    ----------
    grid : mapping or table
        A mapping of keys: every combination of those that are given as lists is a case, the others
        are shared. Or a :class:`pandas.DataFrame`, or a list of mappings: one case a row. A column
        ``label`` names the cases; results carry it.
    **shared
        Keys that all cases share, besides; a value of the grid stands before one of these.

    Raises
    ------
    ProgramError
        If there is no program, or no such key.

    Examples
    --------
    >>> import ehlwave
    >>> grid = {"load_parameter_m": [10, 20, 50], "wavelength_over_a": [1, 2, 4]}
    >>> study = ehlwave.Study(grid, lubricant_parameter_l=5, radius_ratio_d=1,
    ...     cells_x=64, cells_y=64, orientation="transverse", response="harmonic")
    >>> results = study.run()
    >>> results.sizes["case"], set(results["status"].values.tolist())
    (9, {'converged'})
    """

    def __init__(
        self,
        grid: Mapping[str, Any] | pd.DataFrame | Sequence[Mapping[str, Any]],
        **shared: Unpack[StudyKeys],
    ) -> None:
        """Take the grid or the rows."""
        given: dict[str, Any] = dict(shared)
        if isinstance(grid, Mapping):
            grid = {key: in_si(value, key) for key, value in grid.items()}
            lists = {key: list(value) for key, value in grid.items() if _is_list(value)}
            self.rows: pd.DataFrame | None = None
            given |= {key: value for key, value in grid.items() if key not in lists}
            grouped(lists)  # for its check
        else:
            lists, self.rows = {}, _rows(grid)
            for key in self.rows.columns.drop(LABEL, errors="ignore"):
                if self.rows[key].dtype != object:
                    continue
                self.rows[key] = [in_si(value, str(key)) for value in self.rows[key]]
            grouped(dict.fromkeys(map(str, self.rows.columns.drop(LABEL, errors="ignore")), 0))
        for key in SURFACES.values():
            if not isinstance(source := given.get(key, ""), (str, Path)):
                raise ProgramError(
                    f"{key} = {source!r}: a study is known by the names of its files: write the "
                    "surface by ehlwave.surface.write_simulation_surface"
                )
        self.lists = lists
        self.groups = grouped({key: value for key, value in given.items() if key not in OPTIONS})
        self.options = {key: value for key, value in given.items() if key in OPTIONS}

    def _shown_rows(self) -> dict[str, str]:
        """Return what varies, and over how many values."""
        if self.rows is not None:
            return {"rows": str(len(self.rows)), "of": ", ".join(map(str, self.rows.columns))}
        return {key: f"{len(values)} values" for key, values in self.lists.items()}

    def run(
        self,
        output: str | Path | None = None,
        ranks: int = 1,
        seconds: float | None = None,
        restarts: int = 5,
        progress: Following = None,
    ) -> xr.Dataset:
        """Compute all cases that are not in the store of `output`, and read all.

        Parameters
        ----------
        output : path, optional
            Results file, kept; the store of finished cases is beside it, so that the same call goes
            on where it was stopped. A temporary one if absent.
        ranks : int
            MPI ranks. More than 1, or any number where ``EHLWAVE_LAUNCHER`` is set, are started by
            ``run-sweep``, or by ``mpirun`` where there is no such script; 1 runs the program
            without MPI's launcher.
        seconds : float, optional
            Wall time after which it is stopped in good order; cases left are ``pending``.
        restarts : int
            How often ``run-sweep`` starts the rest again after a rank died.
        progress : callable or False, optional
            As of :meth:`Case.run`; cases are counted.

        Returns
        -------
        xarray.Dataset
            As of :func:`ehlwave.read_results`: every column over ``case``, text as text. The
            coordinate ``label`` has the labels of the rows where they were given.

        Raises
        ------
        ProgramError
            If the program refuses the input.

        Warns
        -----
        UserWarning
            Of what the program notes: cases that are set aside, others in the same store.

        Examples
        --------
        >>> import ehlwave
        >>> rows = [{"load_parameter_m": 10, "wavelength_over_a": 1},
        ...         {"load_parameter_m": 20, "wavelength_over_a": 2}]
        >>> study = ehlwave.Study(rows, lubricant_parameter_l=5, radius_ratio_d=1,
        ...     cells_x=64, cells_y=64, orientation="transverse", response="harmonic")
        >>> results = study.run("results.h5")
        >>> results["harmonic_ratio"].values.round(2).tolist()
        [0.93, 0.57]

        The same call again reads what is there and computes nothing:

        >>> again = study.run("results.h5")
        >>> bool((again["seconds"] == results["seconds"]).all())
        True
        """
        with tempfile.TemporaryDirectory() as folder:
            results = Path(folder, "results.h5") if output is None else Path(output).resolve()
            path = Path(folder, "study.nml")
            write_new_text(path, self._text(Path(folder), results))
            limit = [] if seconds is None else ["--time-limit", f"{seconds:g}"]
            command, environment = _sweep_command(ranks, restarts)
            with following(progress) as callback:
                command += [str(path), *limit]
                done = run_following(command, callback, "stdout", environment=environment)
            for line in _check(done, (0, 1, 85)).stdout.splitlines():
                if line.startswith(NOTICE):
                    warnings.warn(line.removeprefix(NOTICE), stacklevel=2)
            found = read_results(results)
        return found if self.rows is None else with_labels_of(found, self.rows)

    def plan(self) -> str:
        """Return the list of cases with grids, steps and resolution; nothing is computed.

        Examples
        --------
        >>> import ehlwave
        >>> grid = {"load_parameter_m": [10, 20, 50], "wavelength_over_a": [1, 2, 4]}
        >>> study = ehlwave.Study(grid, lubricant_parameter_l=5, radius_ratio_d=1,
        ...     orientation="transverse", response="harmonic")
        >>> len(study.plan().splitlines()) > 9
        True
        """
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "study.nml")
            write_new_text(path, self._text(Path(folder), Path(folder, "results.h5")))
            return _run("ehlwave-sweep", str(path), "--plan").stdout

    def _text(self, folder: Path, results: Path) -> str:
        sweep = {**self.lists, **self.options, "output": str(results)}
        if self.rows is not None:
            table = folder / "cases.csv"
            write_new_text(
                table, self.rows.drop(columns=LABEL, errors="ignore").to_csv(None, index=False)
            )
            sweep["case_file"] = str(table)
        return namelist({**self.groups, "sweep": sweep})


def _rows(grid: Any) -> pd.DataFrame:  # noqa: ANN401 - what users give
    try:
        return pd.DataFrame(grid)
    except (TypeError, ValueError):
        raise ProgramError(
            f"Study: {grid!r:.60}: give a mapping of keys, a table or a list of mappings; of a "
            "file pandas.read_csv(FILE)"
        ) from None


def grouped(keys: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Return keys by the group that they belong to in an input file.

    Raises ProgramError if a key is not known to the program.
    """
    known, groups = key_groups(), {}
    for key, value in keys.items():
        if key not in known:
            near = did_you_mean(key, known)
            raise ProgramError(
                f"unknown key {key}{near}; ehlwave-case --keys lists all{see('keys')}"
            )
        groups.setdefault(known[key], {})[key] = in_si(value, key)
    return groups


@cache
def key_table() -> pd.DataFrame:
    """Return what the program says of its keys, a row each: ``ehlwave-case --keys --json``.

    Columns: ``group``, ``name``, ``kind``, ``unit``, the bounds ``above``, ``minimum`` and
    ``maximum``, ``choices``, ``default``, ``default_text``, ``required``, ``help`` and
    ``belongs_to``, the cases that have the key.

    Raises ProgramError if there is no program, or one of another version that does not say it.
    """
    said = _run("ehlwave-case", "--keys", "--json").stdout
    try:
        return pd.DataFrame(json.loads(said)["keys"])
    except (ValueError, KeyError) as error:
        program = find_program("ehlwave-case")
        raise ProgramError(
            f"{program}: lists no keys as JSON: take the program of {__package__}"
        ) from error


def key_groups() -> dict[str, str]:
    """Return the group of each key."""
    table = key_table()
    return dict(zip(table["name"], table["group"], strict=True))


def _with_surface_files(groups: dict[str, dict[str, Any]], folder: Path) -> dict[str, Any]:
    """Return groups whose surfaces, where they are objects, are written to files."""
    groups = dict(groups)
    for group, key in SURFACES.items():
        source = groups.get(group, {}).get(key)
        if source is None or isinstance(source, (str, Path)):
            continue
        from ehlwave.surface import read_surface, write_simulation_surface

        path = folder / f"{group}.h5"
        write_simulation_surface(read_surface(source), path)
        groups[group] = groups[group] | {key: str(path)}
    return groups


def _is_list(value: object) -> bool:
    return isinstance(value, Iterable) and not isinstance(value, (str, Mapping))


def _run(name: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run a program; ProgramError with what it said unless its exit status is 0 or 1."""
    done = run_following([str(find_program(name)), *arguments], None, "stdout")
    return _check(done, (0, 1))


def _sweep_command(ranks: int, restarts: int) -> tuple[list[str], dict[str, str]]:
    """Return what starts a sweep, and its environment."""
    program, environment = str(find_program("ehlwave-sweep")), dict(os.environ)
    if ranks == 1 and not environment.get("EHLWAVE_LAUNCHER"):
        return [program], environment
    script = find_run_sweep()
    if script is None:
        return ["mpirun", "-n", str(ranks), program], environment
    words = [str(script), "--ranks", str(ranks), "--restarts", str(restarts)]
    return words, environment | {"EHLWAVE_SWEEP": program}


def _check(
    done: subprocess.CompletedProcess[str], fine: Sequence[int]
) -> subprocess.CompletedProcess[str]:
    """Return what was run; ProgramError with what it said unless its exit status is fine."""
    if done.returncode not in fine:
        said = "; ".join((done.stderr or done.stdout).strip().splitlines())
        command = " ".join(map(str, done.args))
        raise ProgramError(f"{command}: exit status {done.returncode}: {said}")
    return done
