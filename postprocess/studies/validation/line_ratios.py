"""Ad/Ai of the line contact to mesh size 0, with errors, from its runs."""

from pathlib import Path

import pandas as pd
import xarray as xr

from studies.validation.line_runs import DOMAINS, responses
from studies.validation.published import line_ratios

WAVE, AMPLITUDE = "wavelength_over_a", "amplitude_over_film"


def linear_ratios(results: xr.Dataset) -> pd.DataFrame:
    """Return ``linear`` and its ``linear_error`` by lambda/a, extrapolated by the program."""
    table = results.to_dataframe().set_index(WAVE)
    linear = table["harmonic_extrapolated"]
    error = (linear * table["harmonic_error"]).abs()
    return pd.DataFrame({"linear": linear, "linear_error": error})


def domain_changes(folder: Path) -> pd.Series:
    """Return by lambda/a the change of Ad/Ai on the wide domain, at equal mesh size."""
    near, wide = (
        responses(folder, domain).to_dataframe().set_index(WAVE)["harmonic_ratio"]
        for domain in DOMAINS
    )
    return wide - near


def marched_ratios(results: xr.Dataset, linear: pd.DataFrame, domain: pd.Series) -> pd.DataFrame:
    """Return Ad/Ai of the march, eq. (14), and of linear responses beside the published values.

    ``march`` is the linear response at mesh size 0 and what the march has more than the linear
    response on its own grid: both have the same discretisation error to first order. Its error is
    the change of that difference from the coarser grid to the finer one, the linear response's
    own, and what the domain changes; ``..._difference`` is to the value ``published``.
    """
    found = pd.DataFrame(line_ratios()).rename(columns={"amplitude_ratio": "published"})
    found = found.join(linear, WAVE)
    marches = results.to_dataframe()
    marches["more"] = marches["amplitude_ratio"] - marches["harmonic_ratio"]
    more = marches.pivot(index=[WAVE, AMPLITUDE], columns="cells_x", values="more")
    more = more.loc[found.set_index([WAVE, AMPLITUDE]).index].to_numpy()
    found["linear_error"] += domain.abs()[found[WAVE]].to_numpy()
    found["march"] = found["linear"] + more[:, 1]
    found["march_error"] = abs(more[:, 1] - more[:, 0]) + found["linear_error"]
    for name in ("march", "linear"):
        found[f"{name}_difference"] = found[name] - found["published"]
    return found
