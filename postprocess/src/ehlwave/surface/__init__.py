"""From a measured surface to its deformed shape inside the contact, without a simulation.

Section 3.4 of Venner, Kaneta and Lubrecht (2000): decompose a microgeometry into harmonics, reduce
each by formula (18) or by a computed transfer, and add them up again.
"""

from typing import TYPE_CHECKING, Any

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.conditions_from_keys import conditions_from_keys
from ehlwave.contact.conditions_read import read_conditions
from ehlwave.extras import load
from ehlwave.laws.table import TableTransfer
from ehlwave.laws.table_read import read_table
from ehlwave.laws.transfer import FormulaTransfer, RecommendedTransfer, Transfer
from ehlwave.laws.two_wave_transfer import TwoWaveTransfer
from ehlwave.results.coefficients import read_coefficients
from ehlwave.surface.answer import Answer, answer_of, answer_of_two
from ehlwave.surface.film_profile import Mover, film_profile, second_conditions
from ehlwave.surface.harmonics import harmonic_table
from ehlwave.surface.pair import DeformedPair, PairStatistics, pair_statistics
from ehlwave.surface.period import cut_period
from ehlwave.surface.predict import Deformed, deform_surface
from ehlwave.surface.read import ReadOptions, read_surface
from ehlwave.surface.report import report_json, report_text, to_dataset, write_results
from ehlwave.surface.roughness import gaussian_filtered, roughness_parameters
from ehlwave.surface.simulation import simulation_surface, write_simulation_surface
from ehlwave.surface.surface import Surface, map_surface, trace_surface
from ehlwave.surface.two_surfaces import FilmOfTwo, film_of_two

if TYPE_CHECKING:
    from ehlwave.surface.bands_figure import removal_figure
    from ehlwave.surface.figures import deformed_figure, spectrum_figure

__all__ = [
    "Answer",
    "Conditions",
    "Deformed",
    "DeformedPair",
    "FilmOfTwo",
    "FormulaTransfer",
    "Mover",
    "PairStatistics",
    "ReadOptions",
    "RecommendedTransfer",
    "Surface",
    "TableTransfer",
    "Transfer",
    "TwoWaveTransfer",
    "answer_of",
    "answer_of_two",
    "conditions_from_keys",
    "cut_period",
    "deform_surface",
    "deformed_figure",
    "film_of_two",
    "film_profile",
    "gaussian_filtered",
    "harmonic_table",
    "map_surface",
    "pair_statistics",
    "read_coefficients",
    "read_conditions",
    "read_surface",
    "read_table",
    "removal_figure",
    "report_json",
    "report_text",
    "roughness_parameters",
    "second_conditions",
    "simulation_surface",
    "spectrum_figure",
    "to_dataset",
    "trace_surface",
    "write_results",
    "write_simulation_surface",
]


def __getattr__(name: str) -> Any:  # noqa: ANN401
    """Import plotting on first use: it needs an extra."""
    if name in ("deformed_figure", "spectrum_figure"):
        return getattr(load("ehlwave.surface.figures"), name)
    if name == "removal_figure":
        return load("ehlwave.surface.bands_figure").removal_figure
    raise AttributeError(f"module 'ehlwave.surface' has no attribute {name!r}")
