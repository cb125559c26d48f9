"""Stribeck curve of a contact by ``ehlwave-sweep``, by continuation in the share of the solids."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from ehlwave.cases.study import Study
from ehlwave.choices import STRIBECK_FACTORS, STRIBECK_SHARES
from ehlwave.errors import ArgumentError, ProgramError
from ehlwave.results.schema import SETTLED

if TYPE_CHECKING:
    from ehlwave.programs.progress import Following

SPEED = "mean_speed_m_per_s"
SHARE = "touching_share"
COLUMNS = (
    "friction_coefficient",
    "friction_error",
    "solid_friction_coefficient",
    "oil_friction_coefficient",
    SHARE,
    "touching_share_error",
    "touching_area",
    "mean_film_um",
    "central_film_um",
)
"""Columns of the curve besides the speed and its relative error ``speed_error``."""


@dataclass(frozen=True)
class Stribeck:
    """Stribeck curve of a contact."""

    table: pd.DataFrame
    """``mean_speed_m_per_s`` and its relative error by the mesh, ``speed_error``; friction, share
    of the load on the solids with its error, area and films; ``status``. Falling speed."""

    @property
    def transition(self) -> tuple[float, float]:
        """Return the speeds at the largest and the smallest share that were asked for."""
        touching = self.table[self.table["is_share_given"]]
        return float(touching[SPEED].min()), float(touching[SPEED].max())


def stribeck(
    keys: Mapping[str, Any],
    shares: Sequence[float] = STRIBECK_SHARES,
    factors: Sequence[float] = STRIBECK_FACTORS,
    ranks: int = 1,
    progress: "Following" = None,
) -> Stribeck:
    """Return friction, share of the solids and film over the speed.

    Through the transition, where the speed hardly changes, the share is given and the speed is
    found. Above it the speeds are multiples of the speed at the smallest share.

    Parameters
    ----------
    keys : mapping
        Keys of a line contact with ``film_m``, whatever their group, in a steady state. The speed
        is where the continuation begins.
    shares : sequence of float
        Shares of the load on the solids, between 0 and 1.
    factors : sequence of float
        Speeds of the full film over the speed at the smallest share, above 1.
    ranks, progress
        As of :meth:`ehlwave.Study.run`.

    Raises
    ------
    ArgumentError
        If there is no ``film_m``, or a share or factor is out of range.
    ProgramError
        If the program refuses the input, or no case converges.

    Examples
    --------
    >>> from ehlwave.stribeck import stribeck
    >>> roller = dict(radius_x_m=0.01, reduced_modulus_pa=2.26e11, load_n_per_m=1e5,
    ...     mean_speed_m_per_s=0.05, viscosity_pa_s=0.04, slip_parameter=0.5, film_m=2e-8,
    ...     flow_law="eyring", eyring_stress_pa=1e7, x_min=-4, x_max=2, cells_x=192)
    >>> curve = stribeck(roller, shares=[0.1, 0.8], factors=[2], progress=False)
    >>> [round(share, 2) for share in curve.table["touching_share"]]
    [0.0, 0.1, 0.8]
    """
    if not float(keys.get("film_m", 0)) > 0:
        raise ArgumentError("the input has no &touching film_m: give the boundary film")
    given = sorted({float(share) for share in shares})
    above = sorted({float(factor) for factor in factors})
    if not given or not 0 < given[0] <= given[-1] < 1:
        raise ArgumentError(f"shares = {given}: give shares of the load above 0 and below 1")
    if above and above[0] <= 1:
        raise ArgumentError(f"factors = {above}: give factors of the speed above 1")
    fixed = {key: value for key, value in keys.items() if key != "share"}
    slow = _rows(Study(pd.DataFrame({"share": given}), **fixed), ranks, progress)
    tables = [slow.assign(is_share_given=True)]
    if above:
        fixed.pop(SPEED, None)
        fastest = float(slow[SPEED].max())
        speeds = [fastest * factor for factor in above]
        fast = _rows(Study(pd.DataFrame({SPEED: speeds}), **fixed), ranks, progress)
        tables.append(fast.assign(**{SPEED: speeds, "speed_error": 0.0, "is_share_given": False}))
    table = pd.concat(tables).sort_values(SPEED, ascending=False, ignore_index=True)
    return Stribeck(table)


def _rows(study: Study, ranks: int, progress: "Following") -> pd.DataFrame:
    """Return the columns of the curve from a sweep, NaN where a case did not converge."""
    found = study.run(ranks=ranks, progress=progress).to_dataframe()
    good = found["status"].isin(SETTLED).to_numpy()
    if not good.any():
        raise ProgramError(f"no case converged: {found['message'].iloc[0]}")
    table = pd.DataFrame(index=range(len(found)))
    names = {SPEED: SPEED, "speed_error": "mean_speed_error"} | {name: name for name in COLUMNS}
    for name, column in names.items():
        values = found[column].to_numpy(dtype=float) if column in found else np.nan
        table[name] = np.where(good, values, np.nan)
    table["status"] = found["status"].to_numpy()
    return table
