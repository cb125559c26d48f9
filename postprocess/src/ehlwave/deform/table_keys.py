"""Which keys of a case its response depends on: what harmonic tables carry and are matched by.

Every key of the programs stands in one of the groups below; a test holds them to ``--keys``.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from ehlwave.effective_input import keys_of_input
from ehlwave.errors import ResultsError, SurfaceError, printable


def _names(text: str) -> tuple[str, ...]:
    return tuple(text.split())


IN_COLUMNS = frozenset(
    _names(
        """
    radius_x_m radius_y_m load_n load_n_per_m mean_speed_m_per_s viscosity_pa_s load_parameter_m
    lubricant_parameter_l radius_ratio_d slip_parameter slide_to_roll_ratio orientation
    wavelength_over_a wavelength_x_over_a wavelength_y_over_a oblique
    """
    )
)
"""Keys that the columns M, L, D, slip_parameter and the wavelengths give."""

OF_THE_OIL = _names(
    """
    pressure_viscosity_per_pa roelands_index viscosity_law density_law flow_law eyring_stress_pa
    carreau_modulus_pa carreau_exponent reduced_modulus_pa mcewen_coefficient_per_pa
    mcewen_exponent yasutomi_c1 yasutomi_c2_k yasutomi_above_glass_k yasutomi_a1_k
    yasutomi_a2_per_pa yasutomi_b1_per_pa yasutomi_b2 doolittle_factor
    doolittle_occupied_fraction tait_modulus_pa tait_modulus_rate shear_limit_over_pressure
    shear_limit_width temperature_k viscosity_table
    """
)
"""The oil at a given M, L and D; the reduced modulus where a stress is compared with it."""

OF_THE_EDGES = ("edges",)

OF_THE_INLET = ("oil_over_flooded", "oil_layer_m", "oil_profile")
"""The oil offered to a starved contact; none of a flooded one."""

OF_MARCHES = _names(
    """
    amplitude_over_film load_balance natural_frequency load_factor end_time oil_change_factor
    oil_change_start oil_change_length
    """
)
"""Further keys of a response in time; the linear response does not depend on them."""

OF_THE_SOLUTION = frozenset(
    _names(
        """
    response x_min x_max y_max cells_x cells_y largest_cells domain tolerance step_tolerance
    response_tolerance time_step_over_cell largest_steps settling_periods largest_total_steps
    method cycle deformation scheme error_estimate accuracy threads
    """
    )
)
"""How well a response is known, not what it is."""

WITHOUT_EFFECT = frozenset(
    _names(
        """
    file orientation_2 wavelength_over_a_2 wavelength_x_over_a_2 wavelength_y_over_a_2 oblique_2
    amplitude_over_film_2 file_2 fields fields_every sensitivities mean_rise
    """
    )
)
"""On the linear response to waves of the first surface."""

OF_THE_HEAT = frozenset(
    _names(
        """
    oil_conductivity_w_per_m_k oil_heat_capacity_j_per_kg_k oil_density_kg_per_m3
    oil_expansion_per_k viscosity_temperature_per_k body_conductivity_w_per_m_k
    body_density_kg_per_m3 body_heat_capacity_j_per_kg_k body2_conductivity_w_per_m_k
    body2_density_kg_per_m3 body2_heat_capacity_j_per_kg_k levels wave_temperatures
    tait_softening_per_k doolittle_occupied_rate_per_k
    """
    )
)
"""With them a response depends on size and speed of the contact, which a table does not hold."""

CARRIED = (*OF_THE_OIL, *OF_THE_EDGES, *OF_THE_INLET, *OF_MARCHES)
"""Columns of a table, empty where a key does not apply."""

CLASSIFIED = IN_COLUMNS | OF_THE_SOLUTION | WITHOUT_EFFECT | OF_THE_HEAT | frozenset(CARRIED)

WORDS = ("edges", "load_balance", "viscosity_table", "oil_profile")
STRESSES = ("eyring_stress_pa", "carreau_modulus_pa")


def carried_columns(points: xr.Dataset) -> dict[str, list[Any]]:
    """Return the columns of the keys that a response depends on, of the points of a sweep.

    Raises ResultsError if the points have heat, or differ in a key that this version does not know.
    """
    inputs = _inputs(points)
    if any(key in OF_THE_HEAT for one in inputs for key in one):
        raise ResultsError(
            "the cases have heat (&heat): a table is for contacts of any size and speed, "
            "and their responses are not"
        )
    unknown = sorted({key for one in inputs for key in one} - CLASSIFIED)
    for key in unknown:
        values = sorted({str(one.get(key, "none")) for one in inputs})
        if len(values) > 1:
            raise ResultsError(
                f"the cases differ in {printable(key)} ({printable(', '.join(values[:4]))}), which "
                "this version of ehlwave does not know: update it"
            )
    linear = _is_linear(points)
    columns: dict[str, list[Any]] = {}
    for key in CARRIED:
        is_march, is_modulus = key in OF_MARCHES, key == "reduced_modulus_pa"
        values = [
            None
            if (is_march and is_linear) or (is_modulus and not any(s in one for s in STRESSES))
            else one.get(key)
            for one, is_linear in zip(inputs, linear, strict=True)
        ]
        if any(value is not None for value in values):
            columns[key] = values
    return columns


def _inputs(points: xr.Dataset) -> list[dict[str, float | str]]:
    """Return the keys of each point: of its effective input, or where there is none by columns."""
    if "effective_input" in points:
        texts = [str(text) for text in points["effective_input"].values]
        known = {text: keys_of_input(text) for text in set(texts)}
        return [known[text] for text in texts]
    names = [key for key in CARRIED if key in points]
    rows = zip(*(points[name].values.tolist() for name in names), strict=True)
    every = [dict(zip(names, row, strict=True)) for row in rows]
    return [
        {key: value for key, value in one.items() if value == value and value != ""}
        for one in every or [{} for _ in range(points.sizes["case"])]
    ]


def _is_linear(points: xr.Dataset) -> list[bool]:
    """Return whether each response is that to small waves."""
    if "harmonic_real" not in points or "harmonic_imaginary" not in points:
        return [False] * points.sizes["case"]
    response = points["harmonic_real"].values + 1j * points["harmonic_imaginary"].values
    return np.isfinite(response).tolist()


def table_columns(raw: pd.DataFrame, place: str) -> Mapping[str, pd.Series]:
    """Return the key columns of a table: numbers, or text of the laws.

    Raises SurfaceError if there is text where a number belongs.
    """
    found = {}
    for key in CARRIED:
        if key not in raw:
            continue
        column = raw[key].map(lambda value: value.decode() if isinstance(value, bytes) else value)
        if key.endswith("_law") or key in WORDS:
            column = column.map(lambda value: np.nan if value == "" else value)
        elif column.dtype.kind not in "fiu":
            raise SurfaceError(f"{place}: column {key} does not hold numbers")
        found[key] = column
    return found
