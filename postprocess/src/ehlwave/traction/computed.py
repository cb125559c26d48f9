"""Friction over the slide-to-roll ratio by ``ehlwave-sweep``."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from ehlwave.cases.study import Study
from ehlwave.contact.file_keys import LIMIT, LIMIT_WIDTH
from ehlwave.errors import ProgramError
from ehlwave.inputs.key_table import GROUP_OF
from ehlwave.inputs.slip import RATIO
from ehlwave.results.schema import SETTLED

if TYPE_CHECKING:
    from ehlwave.programs.progress import Following

RISES = {
    "rise_mid_film_k": "largest_rise_mid_film_k",
    "rise_wall_1_k": "largest_rise_wall_1_k",
    "rise_wall_2_k": "largest_rise_wall_2_k",
}
"""Columns of temperatures, and the results that they are taken from."""


def computed_table(
    given: Mapping[str, Any], ratios: Sequence[float], ranks: int, progress: "Following"
) -> pd.DataFrame:
    """Return friction over the ratios by one sweep, by two where there is a limit of the stress.

    Parameters
    ----------
    given : mapping
        Keys of the contact without its slip.
    ratios : sequence of float
        Slide-to-roll ratios, rising.
    ranks, progress
        As of :func:`ehlwave.traction.traction`.

    Raises
    ------
    ProgramError
        If the program refuses the input, or no case converges.
    """
    has_heat = any(GROUP_OF.get(key) == "heat" for key in given)
    free = {key: value for key, value in given.items() if key not in (LIMIT, LIMIT_WIDTH)}
    table = pd.DataFrame({RATIO: ratios})
    runs = [(("isothermal", "thermal"), free)]
    if float(given.get(LIMIT, 0)):
        runs.append((("limited", "limited_thermal"), dict(given)))
    for (cold, warm), each in runs:
        cases = pd.DataFrame({RATIO: ratios})
        found = Study(cases, **each).run(ranks=ranks, progress=progress).to_dataframe()
        good = found["status"].isin(SETTLED).to_numpy()
        if not good.any():
            raise ProgramError(f"no case converged: {found['message'].iloc[0]}")
        known = np.isfinite(found["friction_coefficient"].to_numpy(dtype=float)[good])
        if not known.any() and each is runs[-1][1]:
            raise ProgramError(_no_friction(found["warning"][good]))
        source = "isothermal_friction_coefficient" if has_heat else "friction_coefficient"
        table[cold] = np.where(good, found[source], np.nan)
        if has_heat and not good.all():
            table.loc[~good, cold] = without_heat(each, cases[~good], ranks)
        kept = {"central_film_um": "central_film_um", "friction_error": "friction_error"}
        if has_heat:
            kept = {warm: "friction_coefficient", **RISES, **kept}
        for name, column in kept.items():
            table[name] = np.where(good, found[column], np.nan)
        table["status"] = found["status"].to_numpy()
        table["warning"] = found["warning"].to_numpy()
    return table


def _no_friction(warnings: "pd.Series[str]") -> str:
    """Return why no case has a friction, with the message of the program."""
    said = next((str(text).split("; ")[0] for text in warnings if text), "")
    return (
        "friction is not known at any ratio"
        + (f" ({said})" if said else "")
        + ": give more cells, "
        "or a flow law such as flow_law = 'eyring' with eyring_stress_pa"
    )


def without_heat(keys: Mapping[str, Any], cases: pd.DataFrame, ranks: int) -> NDArray[np.float64]:
    """Return isothermal friction of ratios."""
    dropped = [key for key, group in GROUP_OF.items() if group == "heat"]
    if str(keys.get("viscosity_law")).lower() != "table":  # measured at temperatures, without heat
        dropped.append("temperature_k")
    cold = {key: value for key, value in keys.items() if key not in dropped}
    found = Study(cases, **cold).run(ranks=ranks, progress=False)
    return np.where(
        np.isin(found["status"].values, SETTLED), found["friction_coefficient"].values, np.nan
    )
