"""Friction over the slide-to-roll ratio: by the list of laws, or computed where none holds."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import pandas as pd

from ehlwave.choices import FILM_BY, TRACTION_RATIOS, chosen_or_none
from ehlwave.contact.file_keys import LIMIT
from ehlwave.errors import ArgumentError, RangeError, SurfaceError
from ehlwave.inputs.key_classes import HEAT_DATA, OF_THE_SOLUTION
from ehlwave.inputs.key_table import GROUP_OF
from ehlwave.inputs.slip import RATIO, SLIP
from ehlwave.programs.programs import has_programs
from ehlwave.traction.by_laws import film_at, table_by_laws
from ehlwave.traction.computed import computed_table, without_heat
from ehlwave.traction.given import UNUSED, checked_ratios
from ehlwave.traction.table import Traction, regimes

if TYPE_CHECKING:
    from ehlwave.programs.progress import Following

SMALL_RATIO = 1e-5
"""Where friction is proportional to the ratio: its slope is taken there."""


def traction(
    keys: Mapping[str, Any],
    ratios: Sequence[float] = TRACTION_RATIOS,
    ranks: int = 1,
    progress: "Following" = None,
    by: str | None = None,
) -> Traction:
    """Return friction and temperatures over the slide-to-roll ratio.

    The laws answer where they hold at all ratios, as :meth:`ehlwave.Contact.film` does, and
    ``ehlwave-sweep`` elsewhere. It also computes contacts with a limit of the stress, and contacts
    whose keys name a grid, a scheme or an accuracy.

    Parameters
    ----------
    keys : mapping
        Keys of a smooth contact, as for :class:`ehlwave.Case`; the ratios replace its slip. With
        keys of ``&heat`` there is friction with heat; with ``shear_limit_over_pressure`` friction
        with this limit, besides.
    ratios : sequence of float
        Slide-to-roll ratios, above 0 and, with heat, below 2.
    ranks : int
        MPI ranks of the sweep.
    progress : callable or False, optional
        As of :meth:`ehlwave.Study.run`.
    by : {"laws", "computed"}, optional
        "laws": nothing is computed; "computed": ``ehlwave-sweep`` answers.

    Raises
    ------
    ArgumentError
        If the ratios are none, or keys are of waves or of a march.
    SurfaceError
        If the conditions are Moes parameters.
    RangeError
        If no law holds, and the programs are not installed or not asked.
    ProgramError
        If the program refuses the input, or no case converges.

    Examples
    --------
    >>> from ehlwave.traction import traction
    >>> keys = {"radius_x_m": 0.02, "reduced_modulus_pa": 2.26e11, "load_n_per_m": 4e5,
    ...         "mean_speed_m_per_s": 2, "viscosity_pa_s": 0.03, "flow_law": "eyring",
    ...         "eyring_stress_pa": 5e6, "cells_x": 256, "shear_limit_over_pressure": 0.05}
    >>> found = traction(keys, ratios=[0.01, 1], progress=False)
    >>> found.table["regime"].tolist()
    ['nonlinear', 'limited']
    """
    chosen_or_none(by, "by", FILM_BY)
    given = {key: value for key, value in keys.items() if key not in (SLIP, RATIO)}
    _check_keys(given)
    chosen = checked_ratios(ratios, any(GROUP_OF.get(key) == "heat" for key in given))
    if by == "laws" or (by is None and not _needs_programs(given)):
        try:
            return _by_laws(given, chosen)
        except RangeError:
            if by == "laws" or not has_programs():
                raise
    table = computed_table(given, chosen, ranks, progress)
    free = {key: value for key, value in given.items() if not key.startswith("shear_limit")}
    start = without_heat(free, pd.DataFrame({RATIO: [SMALL_RATIO]}), ranks)
    table["regime"] = regimes(table, float(start[0]) / SMALL_RATIO)
    return Traction(table, float(given.get(LIMIT, 0)) or None)


def _by_laws(given: Mapping[str, Any], ratios: Sequence[float]) -> Traction:
    table = table_by_laws(given, ratios)
    cold = {key: value for key, value in given.items() if key not in HEAT_DATA}
    start = film_at(cold, SMALL_RATIO).friction or 0.0
    table["regime"] = regimes(table, start / SMALL_RATIO)
    return Traction(table, None)


def _check_keys(given: Mapping[str, Any]) -> None:
    if "load_parameter_m" in given:
        raise SurfaceError(
            "load_parameter_m: a film in um needs dimensional &conditions: give radius_x_m, "
            "reduced_modulus_pa, load_n or load_n_per_m, mean_speed_m_per_s and viscosity_pa_s"
        )
    for key in given:
        if GROUP_OF.get(key) in UNUSED:
            raise ArgumentError(
                f"{key}: &{GROUP_OF[key]} has no effect here: friction over slip is computed for a "
                "smooth contact in a steady state. Remove it"
            )


def _needs_programs(given: Mapping[str, Any]) -> bool:
    """Return whether keys name a solution, a limit of the stress, or are not known here."""
    return bool(float(given.get(LIMIT, 0))) or any(
        key in OF_THE_SOLUTION or key not in GROUP_OF for key in given
    )
