"""Numbers of reports by their plain names, with units for reading and with their formulas."""

from __future__ import annotations

import math
from typing import Any, NamedTuple


class Entry(NamedTuple):
    """Presentation of a number in a report."""

    label: str
    unit: str
    factor: float
    formula: str


def _length(label: str, formula: str) -> Entry:
    return Entry(label, "mm", 1e3, formula)


def _film(label: str, formula: str) -> Entry:
    return Entry(label, "um", 1e6, formula)


def _pressure(label: str, formula: str) -> Entry:
    return Entry(label, "GPa", 1e-9, formula)


def _error(label: str, formula: str) -> Entry:
    return Entry(label, "%", 100, formula)


def _number(label: str, formula: str, unit: str = "") -> Entry:
    return Entry(label, unit, 1, formula)


_CAUSES = "; includes the errors of viscosity, alpha and estimated inner dimensions"
_HEATED = "law fitted to the energy equation (T6), theory 10.1"

FORMULAS = {
    "angle_deg": _number("angle", "places at which the element is computed", "degrees"),
    "pinion_angle_deg": _number("pinion angle", "distance along the path / r_b1", "degrees"),
    "distance_m": _length(
        "distance s along the line of action", "from the base tangent point of the pinion"
    ),
    "speed_m_per_s": _number("mean speed", "as given", "m/s"),
    "radius_m": _length(
        "reduced radius along rolling, Rx", "1/Rx = 1/R1 + 1/R2, radii of both bodies along rolling"
    ),
    "radius_y_m": _length(
        "reduced radius across, Ry",
        "1/Ry = 1/R1 + 1/R2 across; bearings: 1/Ry = 2/D_w - 1/(f D_w); lines: infinite",
    ),
    "speed_1_m_per_s": _number(
        "speed of surface 1, u1",
        "past the contact: bearings (w_i - w_o) d_m (1 - gamma^2)/4, gears omega_1 s, "
        "cams omega rho",
        "m/s",
    ),
    "speed_2_m_per_s": _number(
        "speed of surface 2, u2",
        "bearings as surface 1, gears omega_2 (N - s), cams omega l'', rollers as surface 1",
        "m/s",
    ),
    "mean_speed_m_per_s": _number("mean speed, u", "(u1 + u2)/2", "m/s"),
    "slide_to_roll_ratio": _number("slide-to-roll ratio", "(u1 - u2)/u"),
    "load_n": _number(
        "load, W",
        "bearings: equilibrium of ISO 16281; gears: T/(r_b1 cos(beta_b)) times the share of "
        "ISO/TR 15144-1; "
        "cams: spring force + rate x lift + mass x acceleration",
        "N",
    ),
    "load_n_per_m": Entry(
        "load per length, w", "N/mm", 1e-3, "W over the length of the line; gears: b/cos(beta_b)"
    ),
    "semi_axis_a_m": _length(
        "Hertz semi-axis along rolling, a",
        "lines: a^2 = 8 w Rx/(pi E'), 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; ellipses: Hertz",
    ),
    "hertz_pressure_pa": _pressure("Hertz pressure", "3 W/(2 pi a b) of ellipses, 2 w/(pi a)"),
    "central_film_m": _film(
        "central film, h_c",
        "equations (7) to (11), solved or by a law fitted to them, as 'source' in JSON and table",
    ),
    "central_film_error": _error(
        "error of the central film", "95 % of computed contacts are within it" + _CAUSES
    ),
    "minimum_film_m": _film("smallest film", "as the central film"),
    "minimum_film_error": _error("error of the smallest film", "as of the central film"),
    "isothermal_central_film_m": _film("central film without heat", "at the temperature given"),
    "isothermal_central_film_error": _error(
        "error of the central film without heat", "as of the central film"
    ),
    "friction": _number("friction coefficient, mu", "(T2): shear force of the film over W"),
    "friction_error": _error("error of the friction coefficient", "as of the central film"),
    "rise_mid_film_k": _number("temperature rise, mid-film", _HEATED, "K"),
    "rise_surfaces_k": _number("temperature rise, surfaces", _HEATED, "K"),
    "thermal_film_factor": _number(
        "film with heat over film without",
        _HEATED + "; of lines over the film in rolling, with thinning by slip in the error",
    ),
    "lambda_ratio": _number(
        "lambda ratio", "mean film (W13) over Rq of the roughness deformed in the contact (W12)"
    ),
    "lambda_error": _error("error of the lambda ratio", "errors of film and deformed roughness"),
    "lambda_ratio_before": _number(
        "lambda ratio, roughness as made", "mean film (W13) over Rq as made"
    ),
    "isothermal_lambda_ratio": _number("lambda ratio without heat", "as the lambda ratio"),
    "isothermal_lambda_error": _error("error of the lambda ratio without heat", "as with heat"),
    "isothermal_lambda_ratio_before": _number(
        "lambda ratio without heat, roughness as made", "mean film (W13) over Rq as made"
    ),
    "largest_shear_pa": _pressure(
        "largest shear stress", "elastic stress below both surfaces by p and shear, (B1) to (B4)"
    ),
    "dang_van": _number(
        "factor of Dang Van", "(B5), max of tau/(tau_f - 0.232 sigma_H); 1: fatigue limit"
    ),
    "dang_van_error": _number(
        "error of the factor of Dang Van, absolute", "of the deformed roughness and of its stresses"
    ),
    "life_ratio": _number("life over smooth life", "(B6), Ioannides and Harris (1985)"),
    "rolling_resistance_n": _number(
        "rolling resistance, F",
        "Biboulet and Houpert (2010), part 1 formula 42, part 2 formula 32, times the factor of "
        "the warm inlet with heat",
        "N",
    ),
    "rolling_power_w": _number(
        "rolling power", "2 F |u| of a contact; bearings: sum, gears and cams: mean", "W"
    ),
    "rolling_power_error": _error(
        "error of the rolling power", "scatter of the formula of rolling resistance"
    ),
    "sliding_power_w": _number(
        "sliding power", "mu W |u1 - u2| of a contact; gears and cams: mean", "W"
    ),
    "sliding_power_error": _error(
        "error of the sliding power", "errors of friction, mean by the power of each place"
    ),
    "iso_film_m": _film(
        "film of ISO/TR 15144-1",
        "1600 Rx G^0.6 U^0.7 W^-0.13 S^0.22 in um, G = alpha E', U = eta (u1 + u2)/(2000 E' Rx), "
        "W = 2 pi (p_h/E')^2 in MPa, mm, Pa s; S: alpha eta of warm over cold surfaces; as "
        "restated by Jbily and others (2024)",
    ),
    "iso_specific_film": _number("specific film of ISO/TR 15144-1", "film over (Ra1 + Ra2)/2"),
    "film_starved_low_m": _film(
        "central film with little oil", "h_c r (1 + r^g)^(-1/g) at r = 0.3, (C9)"
    ),
    "oil_over_flooded": _number(
        "oil offered, r", "oil layer/(rho h_c) at the Hertz pressure, (C2)"
    ),
    "film_starved_m": _film(
        "central film with the given oil layer", "h_c r (1 + r^g)^(-1/g), (C9)"
    ),
    "film_starved_error": _error(
        "error of the starved film", "errors of r, of the law and of the flooded film"
    ),
    "spin_to_roll_ratio": _number("spin-to-roll ratio", "spin over rolling speed of the ball"),
    "contact_angle_deg": _number("contact angle under load", "equilibrium of ISO 16281", "degrees"),
    "inside_error": _error(
        "error by estimated inner dimensions", "each at its error, formula of Moes, root of squares"
    ),
    "ring": _number("ring", "inner or outer"),
    "radial_load_n": _number("radial load", "as given", "N"),
    "axial_load_n": _number("axial load", "as given", "N"),
    "inner_speed_rpm": _number("speed of the inner ring", "as given", "rpm"),
    "outer_speed_rpm": _number("speed of the outer ring", "as given", "rpm"),
    "cam_speed_rpm": _number("speed of the cam", "as given", "rpm"),
    "pinion_speed_rpm": _number("speed of the pinion", "as given", "rpm"),
    "pinion_torque_n_m": _number("torque of the pinion, T", "as given", "N m"),
    "load_factor": _number("load factor", "as given; 1: nominal load"),
    "oil": _number("oil", "as given"),
    "assumed_eyring_stress_pa": Entry(
        "Eyring stress, assumed", "MPa", 1e-6, "the oil has no flow law: usual of mineral oils, PAO"
    ),
    "assumed_eyring_stress_pa_error": _error(
        "error of the assumed Eyring stress", "usual values are 3 to 6 MPa; friction includes it"
    ),
    "ring_displacement_m": _film("displacement of the ring", "equilibrium of ISO 16281"),
    "load_zone_half_width_deg": _number(
        "half width of the load zone", "angles with load, equilibrium of ISO 16281", "degrees"
    ),
    "power_note": _number("powers", "losses that both powers contain"),
    "time_between_overrollings_s": Entry(
        "time between overrollings", "ms", 1e3, "60/(Z |n_i - n_cage|)"
    ),
    "centrifugal_load_n": _number(
        "centrifugal force of an element",
        "m omega_c^2 d_m/2; loads contain it with has_centrifugal_load",
        "N",
    ),
    "centrifugal_over_load": _number(
        "centrifugal force over the largest load", "load of an element on the inner ring"
    ),
    "kappa_iso_281": _number(
        "kappa of ISO 281",
        "nu/nu1; nu1 = 45000 n^-0.83 dm^-0.5 below 1000 rpm, 4500 n^-0.5 dm^-0.5 above",
    ),
    "contact_ratio": _number("contact ratio", "length of the path of contact over base pitch"),
    "overlap_ratio": _number("overlap ratio", "b tan(beta_b)/p_bt"),
    "working_pressure_angle_deg": _number(
        "working pressure angle", "cos = (r_b1 + r_b2) over the centre distance", "degrees"
    ),
    "named_points_mm": _number(
        "points A to E of the path, s",
        "s_A = N - (r_a2^2 - r_b2^2)^0.5, s_E = (r_a1^2 - r_b1^2)^0.5, s_C = r_b1 tan(alpha_wt), "
        "s_B = s_E - p_bt, s_D = s_A + p_bt; undercut flanks: from the involute that is left",
        "mm",
    ),
    "peak_hertz_pressure_pa": _pressure(
        "largest Hertz pressure of the path", "at A, B, C, D or E; the load jumps at B and D"
    ),
    "peak_hertz_distance_m": _length("place of the largest Hertz pressure", "s of this point"),
    "backlash_m": _length(
        "backlash on the working circles",
        "2 a (inv(alpha_wt) - inv(alpha_wt without backlash)), transverse",
    ),
    "geometry_note": _number("teeth", "start of the involute and backlash"),
    "efficiency": _number("efficiency", "1 - (sliding + rolling power)/(torque x speed)"),
    "reversals_deg": _number("entrainment reverses at", "zeros of u", "degrees"),
    "opposite_speeds_deg": _number("surfaces in opposite directions at", "u1 u2 < 0", "degrees"),
    "unanswered_places": _number("places without film", "count of missing central films"),
}
"""Numbers of elements by their names in tables: columns, coordinates and attributes."""


def heading(name: str) -> str:
    """Return the plain name of a number with its unit.

    Parameters
    ----------
    name : str
        Name in the table of an element.
    """
    entry = FORMULAS[name]
    return f"{entry.label} [{entry.unit}]" if entry.unit else entry.label


def written(name: str, value: Any) -> str:  # noqa: ANN401
    """Return a value in the unit of its heading; "-" where it is not known.

    Parameters
    ----------
    name : str
        Name in the table of an element.
    value : float, int or str
        In SI units.
    """
    if not isinstance(value, (float, int)) or isinstance(value, bool):
        return str(value)
    if math.isfinite(value):
        return f"{value * FORMULAS[name].factor:.4g}"
    return "-" if math.isnan(value) else "infinite"
