"""Columns of the tables of elements: units and meanings."""

from typing import NamedTuple


class Column(NamedTuple):
    """Content of a column."""

    unit: str
    meaning: str


COLUMNS = {
    "radius_m": Column("m", "reduced radius of curvature along rolling"),
    "radius_y_m": Column("m", "reduced radius of curvature across; infinite of lines"),
    "speed_1_m_per_s": Column("m/s", "speed of the first surface past the contact"),
    "speed_2_m_per_s": Column("m/s", "speed of the second surface past the contact"),
    "mean_speed_m_per_s": Column("m/s", "mean speed, below 0 where entrainment is reversed"),
    "slide_to_roll_ratio": Column("", "(u1 - u2) over the mean speed"),
    "load_n": Column("N", "load of the contact"),
    "load_n_per_m": Column("N/m", "load per length"),
    "semi_axis_a_m": Column("m", "Hertz semi-axis along rolling"),
    "hertz_pressure_pa": Column("Pa", "largest Hertz pressure"),
    "central_film_m": Column("m", "film at the contact centre"),
    "central_film_error": Column("", "relative error of the central film"),
    "minimum_film_m": Column("m", "smallest film"),
    "minimum_film_error": Column("", "relative error of the smallest film"),
    "isothermal_central_film_m": Column("m", "film at the contact centre without heat"),
    "isothermal_central_film_error": Column("", "relative error of the former"),
    "friction": Column("", "friction coefficient; 0 in pure rolling"),
    "friction_error": Column("", "relative error of friction"),
    "rise_mid_film_k": Column("K", "temperature rise, mid-film"),
    "rise_surfaces_k": Column("K", "mean temperature rise of the surfaces"),
    "thermal_film_factor": Column("", "film with heat over film without"),
    "lambda_ratio": Column("", "mean film over Rq of the roughness deformed in the contact"),
    "lambda_error": Column("", "relative error of the lambda ratio"),
    "lambda_ratio_before": Column("", "mean film over Rq of the roughness as made"),
    "isothermal_lambda_ratio": Column("", "lambda ratio without heat, where heat is refused"),
    "isothermal_lambda_error": Column("", "relative error of the former"),
    "isothermal_lambda_ratio_before": Column("", "the same of the roughness as made"),
    "largest_shear_pa": Column("Pa", "largest shear stress below both surfaces"),
    "dang_van": Column("", "largest factor of Dang Van of both bodies; 1 is the fatigue limit"),
    "dang_van_error": Column("", "absolute error of the factor of Dang Van"),
    "life_ratio": Column("", "life over the life of smooth surfaces, the smaller of both bodies"),
    "rolling_resistance_n": Column("N", "force that rolling takes at each surface"),
    "rolling_power_w": Column("W", "power of rolling, of both surfaces"),
    "sliding_power_w": Column("W", "power of sliding"),
    "iso_film_m": Column("m", "film of ISO/TR 15144-1 (ISO/TS 6336-22)"),
    "iso_specific_film": Column("", "film of ISO/TR 15144-1 over the mean Ra of both surfaces"),
    "film_starved_low_m": Column("m", "central film at r = 0.3, the oil offered over flooded"),
    "oil_over_flooded": Column(
        "", "r, oil offered by the layer over the flow of the flooded contact"
    ),
    "film_starved_m": Column("m", "central film of the starved contact by the oil layer"),
    "film_starved_error": Column("", "relative error of the starved film"),
    "spin_to_roll_ratio": Column("", "spin over rolling speed of the ball"),
    "contact_angle_deg": Column("degree", "contact angle under load"),
    "inside_error": Column("", "relative error of the film by estimated inner dimensions"),
}
"""By name. Texts, ``source`` and ``refusal``, have no unit."""

TEXTS = {
    "source": "origin of the film",
    "refusal": "reason why a number is missing",
    "doubts": "why numbers are doubtful",
}
