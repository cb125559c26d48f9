"""Studies by ``ehlwave-sweep``, their results as :class:`xarray.Dataset`."""

from __future__ import annotations

import os
import tempfile
import warnings
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd
import xarray as xr

from ehlwave.cases.case import SURFACES
from ehlwave.cases.keys import checked, grouped, run_program
from ehlwave.errors import ProgramError
from ehlwave.programs.programs import find_program, find_run_sweep, namelist
from ehlwave.programs.progress import Following, following, run_following
from ehlwave.quantities import in_si
from ehlwave.results.labels import with_labels_of
from ehlwave.results.read import read_results
from ehlwave.shown import Shown
from ehlwave.writing import write_new_text

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ehlwave.inputs.keys import StudyKeys

OPTIONS = ("case_file", "output", "unresolved", "largest_case_seconds", "checkpoint_seconds")
"""Keys of ``&sweep`` that are not lists of values."""

NOTICE = "NOTICE: "
"""Begins lines in which a sweep warns."""

LABEL = "label"
"""Column of a table of cases that names them; not a key of the program."""


class Study(Shown):
    """Many cases for ``ehlwave-sweep``.

    Parameters
    ----------
    grid : mapping or table
        A mapping of keys: every combination of the listed values is a case, the others are shared.
        Or a :class:`pandas.DataFrame`, or a list of mappings: a case per row. A column ``label``
        names the cases; results carry it.
    **shared
        Keys that all cases share, besides; a value of the grid overrides these.

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
        """Return the varying keys, and the numbers of their values."""
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
            Results file, kept; the store of finished cases is beside it, so that the same call
            resumes a stopped sweep. A temporary file if absent.
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
            Notes of the program: cases that are set aside, others in the same store.

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

        The same call again reads the stored results and computes nothing:

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
            for line in checked(done, (0, 1, 85)).stdout.splitlines():
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
            return run_program("ehlwave-sweep", str(path), "--plan").stdout

    def _text(self, folder: Path, results: Path) -> str:
        sweep = {**self.lists, **self.options, "output": str(results)}
        if self.rows is not None:
            table = folder / "cases.csv"
            write_new_text(
                table, self.rows.drop(columns=LABEL, errors="ignore").to_csv(None, index=False)
            )
            sweep["case_file"] = str(table)
        return namelist({**self.groups, "sweep": sweep})


def _rows(grid: Any) -> pd.DataFrame:  # noqa: ANN401 - user input
    try:
        return pd.DataFrame(grid)
    except (TypeError, ValueError):
        raise ProgramError(
            f"Study: {grid!r:.60}: give a mapping of keys, a table or a list of mappings; of a "
            "file pandas.read_csv(FILE)"
        ) from None


def _is_list(value: object) -> bool:
    return isinstance(value, Iterable) and not isinstance(value, (str, Mapping))


def _sweep_command(ranks: int, restarts: int) -> tuple[list[str], dict[str, str]]:
    """Return the command of a sweep, and its environment."""
    program, environment = str(find_program("ehlwave-sweep")), dict(os.environ)
    if ranks == 1 and not environment.get("EHLWAVE_LAUNCHER"):
        return [program], environment
    script = find_run_sweep()
    if script is None:
        return ["mpirun", "-n", str(ranks), program], environment
    words = [str(script), "--ranks", str(ranks), "--restarts", str(restarts)]
    return words, environment | {"EHLWAVE_SWEEP": program}
