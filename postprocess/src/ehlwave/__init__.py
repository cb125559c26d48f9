"""Post-processing of results of ``ehlwave-sweep``: read, select, fit, draw, tabulate."""

from ehlwave.errors import ResultsError
from ehlwave.figures import collapse_figure, write_figure
from ehlwave.fit import (
    FitError,
    FormulaFit,
    bootstrap_coefficients,
    fit_formula,
    percentile_intervals,
    point_weights,
    rms_residual,
)
from ehlwave.formula import amplitude_ratio_formula, f_of_r, v, v2, wavelength_ratio
from ehlwave.points import select_points
from ehlwave.read import read_results
from ehlwave.refit import RefitRow, RefitSettings, refit_groups

__all__ = [
    "FitError",
    "FormulaFit",
    "RefitRow",
    "RefitSettings",
    "ResultsError",
    "amplitude_ratio_formula",
    "bootstrap_coefficients",
    "collapse_figure",
    "f_of_r",
    "fit_formula",
    "percentile_intervals",
    "point_weights",
    "read_results",
    "refit_groups",
    "rms_residual",
    "select_points",
    "v",
    "v2",
    "wavelength_ratio",
    "write_figure",
]
