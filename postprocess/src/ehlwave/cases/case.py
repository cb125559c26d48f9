"""A case run by ``ehlwave-case``, its result as :class:`xarray.Dataset`."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import xarray as xr

from ehlwave.cases.keys import checked, grouped
from ehlwave.hdf5 import read_dataset
from ehlwave.programs.programs import find_program, namelist
from ehlwave.programs.progress import Following, following, run_following
from ehlwave.shown import html_table
from ehlwave.writing import write_new_text

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ehlwave.inputs.keys import CaseKeys

SURFACES = {"surface": "file", "surface2": "file_2"}
"""Keys of measured surfaces by their groups."""


class Case:
    """A case for ``ehlwave-case``.

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
        """Return the plan of the computation, with its grid, by the names of ``--plan --json``.

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
            Called as ``progress(done, whole, text)`` for each line of progress; ``text`` names the
            unit, such as ``"time step"``. Without it a notebook shows a bar if tqdm is installed;
            False: none.

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
            checked(done, (0, 1))
        lines = done.stdout.rstrip().splitlines()
        return dict(json.loads(lines[-1]))


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
