"""Oils by name: viscosities and pressure-viscosity coefficients as they were measured.

Source: Stachowiak and Batchelor, Engineering Tribology, Table 2.3, adapted from Cameron. Names are
the table's, with the viscosity at 30 C in mPa s, to distinguish oils of equal name.
"""

from typing import NamedTuple

SOURCE = "Stachowiak and Batchelor, Engineering Tribology, Table 2.3 (after Cameron)"
TEMPERATURES_K = (303.15, 333.15, 373.15)
DENSITY_15C = 885.0
"""Usual of mineral oils, kg/m3; the table has none."""


class MeasuredOil(NamedTuple):
    """An oil at 30, 60 and 100 C: viscosity, mPa s, and alpha, 1/GPa."""

    viscosity_mpa_s: tuple[float, float, float]
    alpha_per_gpa: tuple[float | None, float, float]


MEASURED = {
    "light machine oil 38": MeasuredOil((38, 12.1, 5.3), (None, 18.4, 13.4)),
    "heavy machine oil 153": MeasuredOil((153, 34, 9.1), (23.7, 20.5, 15.8)),
    "heavy machine oil 250": MeasuredOil((250, 50.5, 12.6), (25.0, 21.3, 17.6)),
    "cylinder oil 810": MeasuredOil((810, 135, 26.8), (34, 28, 22)),
    "spindle oil 18.6": MeasuredOil((18.6, 6.3, 2.4), (20, 16, 13)),
    "light machine oil 45": MeasuredOil((45, 12, 3.9), (28, 20, 16)),
    "medicinal white oil 107": MeasuredOil((107, 23.3, 6.4), (29.6, 22.8, 17.8)),
    "heavy machine oil 122": MeasuredOil((122, 26.3, 7.3), (27.0, 21.6, 17.5)),
    "heavy machine oil 171": MeasuredOil((171, 31, 7.5), (28, 23, 18)),
    "spindle oil 30.7": MeasuredOil((30.7, 8.6, 3.1), (25.7, 20.3, 15.4)),
    "heavy machine oil 165": MeasuredOil((165, 30.0, 6.8), (33.0, 23.8, 16.0)),
    "heavy machine oil 310": MeasuredOil((310, 44.2, 9.4), (34.6, 26.3, 19.5)),
    "cylinder oil 2000": MeasuredOil((2000, 180, 24), (41.5, 29.4, 25.0)),
}
