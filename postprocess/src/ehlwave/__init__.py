"""Wavy and rough surfaces in elastohydrodynamic contacts.

Answers in one call: :class:`Contact`. The programs from Python: :class:`Case`, :class:`Study`.
Their results: :func:`read_results`, :func:`read_case`, and functions that draw, fit and tabulate
them. Measured surfaces: :mod:`ehlwave.surface`. Stresses below them: :mod:`ehlwave.stress`.
Bearings, gears and cams: :mod:`ehlwave.elements`. Modules are imported on first use.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ehlwave import contact as contact
    from ehlwave import elements as elements
    from ehlwave import laws as laws
    from ehlwave import results as results
    from ehlwave import stress as stress
    from ehlwave import surface as surface
    from ehlwave.cases.case import Case
    from ehlwave.cases.study import Study
    from ehlwave.contact.bodies import Body
    from ehlwave.contact.data_sheet import Oil
    from ehlwave.contact.formula import amplitude_ratio_formula, f_of_r, v, v2, wavelength_ratio
    from ehlwave.contact.heat_data import BodyHeat, Heat
    from ehlwave.errors import (
        ArgumentError,
        EhlwaveError,
        ExtrapolationWarning,
        ProgramError,
        RangeError,
        ResultsError,
        StressError,
        SurfaceError,
    )
    from ehlwave.laws.answers import Film, Response
    from ehlwave.laws.atlas import Atlas, load_atlas
    from ehlwave.operating_point import Contact
    from ehlwave.results.bootstrap import bootstrap_coefficients, percentile_intervals
    from ehlwave.results.case_file import read_contact as read_case
    from ehlwave.results.figures import collapse_figure, write_figure
    from ehlwave.results.fit import FitError, FormulaFit, fit_formula, point_weights, rms_residual
    from ehlwave.results.points import select_points
    from ehlwave.results.read import read_results
    from ehlwave.results.refit import RefitRow, RefitSettings, refit_groups
    from ehlwave.surface import deform_surface, read_surface

    __version__: str

_HOMES = {
    "laws.answers": ("Film", "Response"),
    "laws.atlas": ("Atlas", "load_atlas"),
    "results.bootstrap": ("bootstrap_coefficients", "percentile_intervals"),
    "contact.bodies": ("Body",),
    "contact.data_sheet": ("Oil",),
    "contact.heat_data": ("BodyHeat", "Heat"),
    "surface": ("deform_surface", "read_surface"),
    "cases.case": ("Case",),
    "cases.study": ("Study",),
    "errors": (
        "ArgumentError",
        "EhlwaveError",
        "ExtrapolationWarning",
        "ProgramError",
        "RangeError",
        "ResultsError",
        "StressError",
        "SurfaceError",
    ),
    "results.figures": ("collapse_figure", "write_figure"),
    "results.fit": (
        "FitError",
        "FormulaFit",
        "fit_formula",
        "point_weights",
        "rms_residual",
    ),
    "contact.formula": ("amplitude_ratio_formula", "f_of_r", "v", "v2", "wavelength_ratio"),
    "operating_point": ("Contact",),
    "results.points": ("select_points",),
    "results.read": ("read_results",),
    "results.refit": ("RefitRow", "RefitSettings", "refit_groups"),
}
_PACKAGES = ("contact", "elements", "laws", "results", "stress", "surface")
_HOME = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "ArgumentError",
    "Atlas",
    "Body",
    "BodyHeat",
    "Case",
    "Contact",
    "EhlwaveError",
    "ExtrapolationWarning",
    "Film",
    "FitError",
    "FormulaFit",
    "Heat",
    "Oil",
    "ProgramError",
    "RangeError",
    "RefitRow",
    "RefitSettings",
    "Response",
    "ResultsError",
    "StressError",
    "Study",
    "SurfaceError",
    "amplitude_ratio_formula",
    "bootstrap_coefficients",
    "collapse_figure",
    "deform_surface",
    "f_of_r",
    "fit_formula",
    "load_atlas",
    "percentile_intervals",
    "point_weights",
    "read_case",
    "read_results",
    "read_surface",
    "refit_groups",
    "rms_residual",
    "select_points",
    "v",
    "v2",
    "wavelength_ratio",
    "write_figure",
]


def __getattr__(name: str) -> Any:  # noqa: ANN401
    """Import a module on request."""
    from ehlwave.extras import load

    if name == "read_case":
        return load("ehlwave.results.case_file").read_contact
    if name == "__version__":
        return load("ehlwave.extras").version()
    if name in _PACKAGES:
        return load(f"ehlwave.{name}")
    if name in _HOME:
        return getattr(load(f"ehlwave.{_HOME[name]}"), name)
    raise AttributeError(f"module 'ehlwave' has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return the names that can be asked for."""
    return [*__all__, *_PACKAGES, "__version__"]
