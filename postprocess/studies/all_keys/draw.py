"""Random legal inputs over every key.

``DRAWS`` has an entry for each key of the program, and `draw` refuses to work with another table.
An entry returns the value of its key, or None for a key that is not given.
"""

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from ehlwave.inputs.key_classes import OF_OTHER_EFFECTS
from studies.all_keys import rules
from studies.all_keys.random_contact import AMBIENT_K, Contact
from studies.all_keys.rules import ONE_LENGTH, Draw, Row, Value

LARGEST_CELLS = (64, 96, 128)


def _dimension(name: str) -> Draw:
    return lambda c, row: c.data().get(name) if c.is_dimensional else None


def _moes(name: str) -> Draw:
    return lambda c, row: None if c.is_dimensional else getattr(c, name)


def _where(key: str, *values: str) -> Callable[[Draw], Draw]:
    """Return the rule that makes a draw a case whose `key` has one of the values."""
    return lambda inner: lambda c, row: inner(c, row) if row.get(key) in values else None


def _share(share: float, inner: Draw) -> Draw:
    """Return a draw of a key that is given in a share of the cases."""
    return lambda c, row: inner(c, row) if c.chance(share) else None


def _tolerance(usual: float) -> Draw:
    return lambda c, row: c.power(0.01 * usual, 100 * usual) if c.chance(0.25) else None


def _starved(inner: Draw) -> Draw:
    return lambda c, row: inner(c, row) if {"oil_over_flooded", "oil_layer_m"} & set(row) else None


def _changing(inner: Draw) -> Draw:
    return lambda c, row: inner(c, row) if "oil_change_factor" in row else None


def _between(low: float, high: float) -> Draw:
    return lambda c, row: c.between(low, high)


def _power(low: float, high: float) -> Draw:
    return lambda c, row: c.power(low, high)


def _whole(low: float, high: float) -> Draw:
    return lambda c, row: int(c.power(low, high))


def _one_of(*choices: Value) -> Draw:
    return lambda c, row: c.one_of(*choices)


_custom = _where("orientation", "custom")
_yasutomi = _where("viscosity_law", "yasutomi")
_doolittle = _where("viscosity_law", "doolittle")
_table = _where("viscosity_law", "table")
_has_alpha = _where("viscosity_law", "roelands", "barus", "isoviscous", None)  # type: ignore[arg-type]
_wavy = _where("orientation", *ONE_LENGTH, "custom")


def _tait(inner: Draw) -> Draw:
    def value(c: Contact, row: Row) -> Value:
        needs = row.get("density_law") == "tait" or row.get("viscosity_law") == "doolittle"
        return inner(c, row) if needs else None

    return value


def _warm(inner: Draw) -> Draw:
    """Return the draw of a key of heat, which contacts with dimensions have."""
    return lambda c, row: inner(c, row) if c.is_warm else None


DRAWS: dict[str, Draw] = {
    "radius_x_m": _dimension("radius_x_m"),
    "radius_y_m": _dimension("radius_y_m"),
    "reduced_modulus_pa": rules.modulus,
    "load_n": _dimension("load_n"),
    "load_n_per_m": _dimension("load_n_per_m"),
    "mean_speed_m_per_s": _dimension("mean_speed_m_per_s"),
    "viscosity_pa_s": _dimension("viscosity_pa_s"),
    "load_parameter_m": _moes("m"),
    "lubricant_parameter_l": _moes("l"),
    "radius_ratio_d": _moes("d"),
    "slip_parameter": rules.slip,
    "viscosity_law": rules.law,
    "pressure_viscosity_per_pa": _has_alpha(lambda c, row: c.alpha),
    "roelands_index": _has_alpha(_share(0.4, _between(0.4, 0.9))),
    "density_law": _share(0.4, _one_of("incompressible", "tait", "dowson_higginson")),
    "flow_law": _share(0.5, _one_of("eyring", "eyring", "carreau", "newtonian")),
    "eyring_stress_pa": _where("flow_law", "eyring")(_power(1e5, 2e7)),
    "carreau_modulus_pa": _where("flow_law", "carreau")(_power(1e5, 1e7)),
    "carreau_exponent": _where("flow_law", "carreau")(_between(0.35, 1)),
    "shear_limit_over_pressure": _share(0.2, _between(0.03, 0.15)),
    "shear_limit_width": lambda c, row: (
        c.between(0.05, 0.3) if "shear_limit_over_pressure" in row else None
    ),
    "mcewen_coefficient_per_pa": _where("viscosity_law", "mcewen")(_power(8e-9, 3e-8)),
    "mcewen_exponent": _where("viscosity_law", "mcewen")(_between(4, 16)),
    "yasutomi_c1": _yasutomi(_between(15.5, 16.5)),
    "yasutomi_c2_k": _yasutomi(_between(15, 27)),
    "yasutomi_above_glass_k": _yasutomi(_between(90, 130)),
    "yasutomi_a1_k": _yasutomi(_between(40, 290)),
    "yasutomi_a2_per_pa": _yasutomi(_power(6e-10, 4e-9)),
    "yasutomi_b1_per_pa": _yasutomi(_power(5e-9, 1e-8)),
    "yasutomi_b2": _yasutomi(_between(-0.6, -0.3)),
    "doolittle_factor": _doolittle(_between(3, 5)),
    "doolittle_occupied_fraction": _doolittle(_between(0.6, 0.72)),
    "tait_modulus_pa": _tait(_power(8e8, 2e9)),
    "tait_modulus_rate": _tait(_between(9, 12)),
    "tait_softening_per_k": _warm(_tait(_between(0.004, 0.008))),
    "doolittle_occupied_rate_per_k": _warm(_doolittle(_between(-1.5e-3, -5e-4))),
    "viscosity_table": _table(lambda c, row: c.viscosities()),
    "temperature_k": lambda c, row: (
        c.between(AMBIENT_K, AMBIENT_K + 50)
        if c.is_warm or row.get("viscosity_law") == "table"
        else None
    ),
    "oil_conductivity_w_per_m_k": _warm(_between(0.1, 0.2)),
    "oil_heat_capacity_j_per_kg_k": _warm(_between(1600, 2400)),
    "oil_density_kg_per_m3": _warm(_between(800, 1000)),
    "oil_expansion_per_k": _warm(_share(0.8, _between(5e-4, 9e-4))),
    "viscosity_temperature_per_k": _warm(rules.beta),
    "body_conductivity_w_per_m_k": _warm(_share(0.2, _between(1, 60))),
    "body_density_kg_per_m3": _warm(_share(0.2, _between(2000, 8000))),
    "body_heat_capacity_j_per_kg_k": _warm(_share(0.2, _between(400, 900))),
    "body2_conductivity_w_per_m_k": _warm(_share(0.2, _between(1, 60))),
    "body2_density_kg_per_m3": _warm(_share(0.2, _between(2000, 8000))),
    "body2_heat_capacity_j_per_kg_k": _warm(_share(0.2, _between(400, 900))),
    "levels": _warm(_share(0.2, _whole(6, 40))),
    "orientation": rules.orientation,
    "wavelength_over_a": _where("orientation", *ONE_LENGTH)(_power(0.5, 3)),
    "wavelength_x_over_a": _custom(lambda c, row: 0.0 if c.chance(0.15) else c.power(0.4, 3)),
    "wavelength_y_over_a": rules.wave_y,
    "oblique": _custom(
        lambda c, row: c.chance(0.5) and row["wavelength_x_over_a"] * row["wavelength_y_over_a"] > 0
    ),
    "amplitude_over_film": _wavy(_share(0.7, _power(0.01, 1))),
    "response": rules.response,
    "wave_temperatures": _where("response", "transient", "both")(
        lambda c, row: "carried" if c.carries_heat else None
    ),
    "file": lambda c, row: c.surface() if c.has_surface else None,
    "orientation_2": rules.orientation_2,
    "wavelength_over_a_2": _where("orientation_2", *ONE_LENGTH)(_power(0.5, 3)),
    "wavelength_x_over_a_2": _where("orientation_2", "custom")(_power(0.4, 3)),
    "wavelength_y_over_a_2": _where("orientation_2", "custom")(
        lambda c, row: 0.0 if c.chance(0.3) else c.power(0.5, 2.5)
    ),
    "oblique_2": _where("orientation_2", "custom")(
        lambda c, row: c.chance(0.5) and row["wavelength_y_over_a_2"] > 0
    ),
    "amplitude_over_film_2": _where("orientation_2", *ONE_LENGTH, "custom")(
        _share(0.7, _power(0.01, 0.5))
    ),
    "file_2": _share(0.2, lambda c, row: c.surface() if c.has_surface else None),
    "oil_over_flooded": rules.oil,
    "oil_layer_m": rules.layer,
    "oil_profile": _starved(_share(0.2, lambda c, row: c.layers())),
    "oil_change_factor": _starved(
        _where("response", "transient", "both")(_share(0.2, _between(0.5, 1.5)))
    ),
    "oil_change_start": _changing(_between(0, 2)),
    "oil_change_length": _changing(_share(0.5, _between(0.5, 2))),
    "x_min": _share(0.15, _between(-5, -2)),
    "x_max": _share(0.15, _between(1.3, 2.5)),
    "y_max": _share(0.15, lambda c, row: None if c.is_line else c.between(1.5, 3)),
    "cells_x": rules.cells,
    "cells_y": lambda c, row: None if c.is_line else rules.cells(c, row),
    "largest_cells": lambda c, row: c.one_of(*LARGEST_CELLS) * (4 if c.is_line else 1),
    "domain": _share(0.08, lambda c, row: None if c.is_line else c.one_of("auto", "whole")),
    "edges": _share(0.4, _one_of("truncated", "flooded")),
    "tolerance": _tolerance(1e-6),
    "step_tolerance": _tolerance(1e-4),
    "response_tolerance": _tolerance(1e-5),
    "time_step_over_cell": rules.step,
    "largest_steps": _share(0.1, _whole(20, 100)),
    "settling_periods": _share(0.15, _one_of(0, 1, 2, 3)),
    "largest_total_steps": _share(0.05, _whole(200, 5000)),
    "method": rules.method,
    "cycle": _where("method", "fas")(_share(0.6, _one_of("v", "f", "w"))),
    "deformation": _share(
        0.2, lambda c, row: "fft" if c.is_line else c.one_of("auto", "mlmi", "fft")
    ),
    "error_estimate": _share(0.1, _one_of("model", "coarse_grid")),
    "accuracy": lambda c, row: c.accuracy,
    "threads": _share(0.2, _one_of(1, 2, 3)),
    "load_balance": _share(
        0.08, lambda c, row: "force_balance" if c.is_line else "equation_of_motion"
    ),
    "natural_frequency": _where("load_balance", "equation_of_motion")(_power(1, 30)),
    "load_factor": _share(0.03, _between(0.8, 1.2)),
    "end_time": rules.end,
    "fields": _share(0.1, lambda c, row: True),
    "fields_every": _where("response", "transient", "both")(_share(0.2, _whole(4, 40))),
    "sensitivities": _share(
        0.1, lambda c, row: None if {"oil_over_flooded", "oil_layer_m"} & set(row) else True
    ),
    "mean_rise": _share(0.05, lambda c, row: False),
    "slide_to_roll_ratio": rules.ratio,
    "scheme": rules.scheme,
}


NOT_DRAWN = OF_OTHER_EFFECTS | {"amplitude_m", "amplitude_m_2", "phase_deg"}
"""Keys of surfaces that touch, which few other keys go with: ``test_touching`` has them."""


def check_keys(known: Mapping[str, str]) -> None:
    """Raise ValueError unless every key of the program is drawn or left out, and no other."""
    missing, unknown = set(known) - set(DRAWS) - NOT_DRAWN, set(DRAWS) - set(known)
    if missing or unknown:
        raise ValueError(
            f"studies/all_keys/draw.py: keys that are not drawn: {sorted(missing)}; "
            f"drawn, but no keys of the program: {sorted(unknown)}"
        )


def draw(rng: np.random.Generator, known: Mapping[str, str], folder: Path) -> Row:
    """Return the keys of a random input; the program decides whether it is legal."""
    check_keys(known)
    contact = Contact(rng, folder)
    row: Row = {}
    for key, value_of in DRAWS.items():
        value = value_of(contact, row)
        if value is not None:
            row[key] = value
    return _without_idle(row)


def _without_idle(row: Row) -> Row:
    """Return the row without refused keys that have no effect: loads over no time, z."""
    is_wavy, is_harmonic = "orientation" in row, row.get("response") == "harmonic"
    moves = (
        "file" in row or _varies_along(row, "", at_rest=0) or _varies_along(row, "_2", at_rest=2)
    )
    marches = (moves or "end_time" in row) and not (is_wavy and is_harmonic)
    idle: tuple[str, ...] = ()
    if not marches and not (moves and is_harmonic):
        idle += ("load_balance", "natural_frequency")
    if not marches and row.get("response", "transient") == "transient":
        idle += ("load_factor",)
    if row.get("viscosity_law") in ("barus", "isoviscous"):
        idle += ("roelands_index",)
    return {key: value for key, value in row.items() if key not in idle}


def _varies_along(row: Row, surface: str, at_rest: float) -> bool:
    """Return whether the waves of a surface, '' or '_2', change the gap in time."""
    if row.get(f"orientation{surface}") == "custom" and row[f"wavelength_x_over_a{surface}"] == 0:
        return False
    is_across = row.get(f"orientation{surface}", "longitudinal") != "longitudinal"
    return is_across and row.get("slip_parameter", 1) != at_rest
